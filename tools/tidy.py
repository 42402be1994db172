#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs clang-tidy over every source of the repository, as the tidy preset compiles it.

    tools/tidy.py [--build build/tidy] [--notes FILE] [--clang-tidy NAME] [FOLDER ...]

With FOLDERs only the sources below them, and those that the build compiles together with them. A
piece is passed over if its text, the text of all files of the repository that it includes, the
configuration and its compiler command are those of an earlier clean run; those runs are remembered
in build/tidy-cache. --notes appends one line per source for ./test.
"""
import argparse
import concurrent.futures
import functools
import hashlib
import json
import os
import pathlib
import re
import shlex
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


def check(entry, sources, arguments, cache, configuration):
    """(sources, ok, seconds, output)"""
    begin = time.monotonic()
    mark = cache / key_of(entry, configuration)
    names = [os.path.relpath(source, ROOT) for source in sources]
    if mark.exists():
        return names, True, 0.0, ""
    command = [arguments.clang_tidy, "--quiet", "--warnings-as-errors=*", entry["file"]]
    if pathlib.Path(entry["file"]).resolve() not in sources:
        # A file of the build that includes sources is no mistake.
        command.append("--checks=-bugprone-suspicious-include")
    # Not with -p: it would look at a source once for every target that it is part of.
    run = subprocess.run([*command, "--", *shlex.split(entry["command"])[1:]],
                         cwd=entry["directory"], capture_output=True, text=True, check=False)
    if run.returncode == 0:
        mark.touch()
    return names, run.returncode == 0, time.monotonic() - begin, run.stdout + run.stderr


def sources_of(entry):
    """The sources of the repository that one compiler command reads: itself, or for a file that the
    build made to compile several at a time, those that it includes."""
    file = pathlib.Path(entry["file"]).resolve()
    if not file.is_relative_to(ROOT / "build"):
        return [file]
    if "generated" in file.parts:  # from interface definitions, as they come
        return []
    included = [pathlib.Path(os.fsdecode(name)) for name in INCLUDE.findall(text_of(file))]
    return [path.resolve() for path in included if path.suffix == ".cpp"]


def entries_of(arguments):
    """(compiler command, sources) that have something below the asked folders; no source twice."""
    database = pathlib.Path(arguments.build) / "compile_commands.json"
    below = [pathlib.Path(folder).resolve() for folder in arguments.folders] or [ROOT]
    entries, known = [], set()
    for entry in json.loads(database.read_text()):
        sources = sources_of(entry)
        asked = any(source.is_relative_to(b) for source in sources for b in below)
        if asked and not known.issuperset(sources):
            known.update(sources)
            entries.append((entry, sources))
    return entries


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
    entries, done, failed, notes = entries_of(arguments), 0, 0, []
    total = sum(len(sources) for _, sources in entries)
    with concurrent.futures.ThreadPoolExecutor(len(os.sched_getaffinity(0))) as pool:
        jobs = [pool.submit(check, *e, arguments, cache, configuration) for e in entries]
        for job in concurrent.futures.as_completed(jobs):
            names, ok, seconds, output = job.result()
            result = "passed" if ok else "failed"
            notes += [f"tidy\ttidy\t{result}\t{seconds / len(names):.2f}\n"] * len(names)
            done += len(names)
            if not ok:
                failed += len(names)
                print(f"clang-tidy: {', '.join(names)}\n{output}", flush=True)
            elif done * 10 // total != (done - len(names)) * 10 // total:
                print(f"clang-tidy: {done} of {total}", flush=True)
    if arguments.notes:
        with open(arguments.notes, "a", encoding="utf-8") as file:
            file.writelines(notes)
    print(f"clang-tidy: {total} sources, {failed} in pieces with findings")
    return 1 if failed or not entries else 0


if __name__ == "__main__":
    sys.exit(main())
