#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Fuzzes every parser for a while with libFuzzer and the sanitizers.

    tools/fuzz.py [--build build/fuzz] [--seconds N] [--notes FILE] [TARGET ...]

What the fuzzer finds on the way is kept in BUILD/fuzz/TARGET.found, for the next time; an input
that breaks a parser is left in BUILD/fuzz/TARGET.broken/, with the command that repeats it.
"""
import argparse
import concurrent.futures
import os
import pathlib
import subprocess
import sys
import time


def fuzz(target, seconds):
    """(name, ok, seconds, output)"""
    begin = time.monotonic()
    corpus = target.with_name(target.name + ".corpus").read_text().strip()
    found = target.with_name(target.name + ".found")
    broken = target.with_name(target.name + ".broken")
    found.mkdir(exist_ok=True)
    broken.mkdir(exist_ok=True)
    run = subprocess.run(
        [target, f"-max_total_time={seconds}", "-timeout=20", "-rss_limit_mb=2048",
         "-print_final_stats=1", f"-artifact_prefix={broken}/", found, corpus],
        capture_output=True, text=True, errors="replace", check=False)
    return target.name, run.returncode == 0, time.monotonic() - begin, run.stderr


def main():
    root = pathlib.Path(__file__).resolve().parent.parent
    parser = argparse.ArgumentParser()
    parser.add_argument("--build", default=str(root / "build/fuzz"))
    parser.add_argument("--seconds", type=int, default=60)
    parser.add_argument("--notes")
    parser.add_argument("targets", nargs="*")
    arguments = parser.parse_args()
    folder = pathlib.Path(arguments.build) / "fuzz"
    targets = sorted(path.with_suffix("") for path in folder.glob("*.corpus"))
    if arguments.targets:
        targets = [t for t in targets if t.name in arguments.targets]
    failed, notes = 0, []
    with concurrent.futures.ThreadPoolExecutor(len(os.sched_getaffinity(0))) as pool:
        for name, ok, seconds, output in pool.map(fuzz, targets,
                                                  [arguments.seconds] * len(targets)):
            notes.append(f"long-fuzz\t{name}\t{'passed' if ok else 'failed'}\t{seconds:.2f}\n")
            runs = [line.split()[-1] for line in output.splitlines()
                    if line.startswith("stat::number_of_executed_units")]
            print(f"{name}: {'ok' if ok else 'FAILED'}, {runs[0] if runs else '?'} inputs in "
                  f"{seconds:.0f} s", flush=True)
            if not ok:
                failed += 1
                print(output[-6000:], flush=True)
    if arguments.notes:
        with open(arguments.notes, "a", encoding="utf-8") as file:
            file.writelines(notes)
    return 1 if failed or not targets else 0


if __name__ == "__main__":
    sys.exit(main())
