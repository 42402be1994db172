#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs clang-tidy over every source of the repository, as the tidy preset compiles it.

    tools/tidy.py [--build build/tidy] [--notes FILE] [--clang-tidy NAME] [FOLDER ...]

With FOLDERs only the sources below them. A source is passed over if its text, the text of all
files of the repository that it includes, the configuration and its compiler command are those of
an earlier clean run; those runs are remembered in build/tidy-cache. --notes appends one line per
source for ./test.
"""
import argparse
import concurrent.futures
import functools
import hashlib
import json
import os
import pathlib
import re
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
INCLUDE = re.compile(rb'^\s*#\s*include\s*["<]([^">]+)[">]', re.MULTILINE)


@functools.lru_cache(maxsize=None)
def text_of(path):
    return path.read_bytes()


@functools.lru_cache(maxsize=None)
def is_file(path):
    return path.is_file()


@functools.lru_cache(maxsize=None)
def direct_includes(path, folders):
    """Files of the repository that `path` includes."""
    found = []
    for name in INCLUDE.findall(text_of(path)):
        for folder in (path.parent, *folders):
            candidate = folder / os.fsdecode(name)
            if is_file(candidate):
                found.append(candidate.resolve())
                break
    return found


def all_includes(source, folders):
    seen, queue = {source}, [source]
    while queue:
        for path in direct_includes(queue.pop(), folders):
            if path not in seen:
                seen.add(path)
                queue.append(path)
    return sorted(seen)


def key_of(entry, configuration):
    """The name under which a clean run of one source is remembered."""
    source, command = pathlib.Path(entry["file"]).resolve(), entry["command"]
    folders = tuple(pathlib.Path(f).resolve() for f in re.findall(r"-(?:I|isystem) ?(\S+)", command)
                    if pathlib.Path(f).resolve().is_relative_to(ROOT))
    digest = hashlib.sha256(configuration + command.encode())
    for path in all_includes(source, folders):
        digest.update(str(path).encode() + b"\0" + hashlib.sha256(text_of(path)).digest())
    return digest.hexdigest()


def check(entry, arguments, cache, configuration):
    """(source, ok, seconds, output)"""
    begin = time.monotonic()
    mark = cache / key_of(entry, configuration)
    name = os.path.relpath(entry["file"], ROOT)
    if mark.exists():
        return name, True, 0.0, ""
    run = subprocess.run([arguments.clang_tidy, "-p", arguments.build, "--quiet",
                          "--warnings-as-errors=*", entry["file"]],
                         capture_output=True, text=True, check=False)
    if run.returncode == 0:
        mark.touch()
    return name, run.returncode == 0, time.monotonic() - begin, run.stdout + run.stderr


def entries_of(arguments):
    """One compiler command per source of the repository below the asked folders."""
    database = pathlib.Path(arguments.build) / "compile_commands.json"
    below = [pathlib.Path(folder).resolve() for folder in arguments.folders] or [ROOT]
    build = (ROOT / "build").resolve()
    entries = {}
    for entry in json.loads(database.read_text()):
        source = pathlib.Path(entry["file"]).resolve()
        if not source.is_relative_to(build) and any(source.is_relative_to(b) for b in below):
            entries.setdefault(source, entry)
    return [entries[source] for source in sorted(entries)]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--build", default=str(ROOT / "build/tidy"))
    parser.add_argument("--notes")
    parser.add_argument("--clang-tidy", default="clang-tidy-16")
    parser.add_argument("folders", nargs="*")
    arguments = parser.parse_args()
    cache = ROOT / "build/tidy-cache"
    cache.mkdir(parents=True, exist_ok=True)
    version = subprocess.run([arguments.clang_tidy, "--version"], capture_output=True, check=True)
    configuration = version.stdout + (ROOT / ".clang-tidy").read_bytes()
    entries, failed, notes = entries_of(arguments), 0, []
    with concurrent.futures.ThreadPoolExecutor(len(os.sched_getaffinity(0))) as pool:
        jobs = [pool.submit(check, e, arguments, cache, configuration) for e in entries]
        for job in concurrent.futures.as_completed(jobs):
            name, ok, seconds, output = job.result()
            notes.append(f"tidy\ttidy\t{'passed' if ok else 'failed'}\t{seconds:.2f}\n")
            if not ok:
                failed += 1
                print(f"clang-tidy: {name}\n{output}", flush=True)
    if arguments.notes:
        with open(arguments.notes, "a", encoding="utf-8") as file:
            file.writelines(notes)
    print(f"clang-tidy: {len(entries)} sources, {failed} with findings")
    return 1 if failed or not entries else 0


if __name__ == "__main__":
    sys.exit(main())
