#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Changes one line at a time and looks whether a test notices.

    tools/mutate.py [--build DIR] [--ninja COMMAND] [--list] [NAME ...]

The changes stand in tools/mutations.toml: a file, a text that is there exactly once, what is put in
its place, and the tests that ought to fail. Each change is built and tested by itself, and taken
back. NAME: those alone whose names contain it. Needs a build folder in which all is built and all
tests pass. Ends with 1 if a change survives, and with 2 if a text is not there any more or a change
does not compile: the list has to follow the code.
"""
import argparse
import pathlib
import re
import shlex
import subprocess
import sys
import tomllib

ROOT = pathlib.Path(__file__).resolve().parent.parent
LIST = ROOT / "tools/mutations.toml"
SECONDS = 300  # a test that takes longer hangs, which is noticed, too


def changed(text, change):
    """The text with the change in it; an error if the place is not there exactly once."""
    # Layout is no matter: any white space matches any other.
    pattern = r"\s+".join(re.escape(word) for word in change["find"].split())
    found = len(re.findall(pattern, text))
    if found != 1:
        raise ValueError(f"the text stands {found} times in {change['file']}, expected once")
    return re.sub(pattern, lambda _: change["replace"], text)


def judge(change, ninja, build):
    """Of a change that is in its file: what noticed it, or nothing; ValueError: not compiled."""
    tests = change["tests"]
    targets = [f"test_{words.split()[0]}" for words in tests]
    made = subprocess.run([*ninja, *targets], cwd=ROOT, capture_output=True, text=True, check=False)
    if made.returncode != 0:
        raise ValueError("does not compile:\n" + (made.stdout + made.stderr)[-2000:])
    for words in tests:
        name, *suites = words.split()
        command = [build / "tests" / f"test_{name}", "--gtest_brief=1", "--gtest_fail_fast",
                   f"--gtest_filter={suites[0] if suites else '*'}"]
        try:
            run = subprocess.run(command, cwd=build, capture_output=True, text=True,
                                 errors="replace", timeout=SECONDS, check=False)
        except subprocess.TimeoutExpired:
            return f"{name}, which hangs"
        if run.returncode == 0:
            continue
        failed = re.search(r"\[  FAILED  \] ([\w/.]+)", run.stdout)
        return f"{name}, {failed.group(1) if failed else f'exit code {run.returncode}'}"
    return None


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build/release")
    parser.add_argument("--ninja", help="command to which the targets are added")
    parser.add_argument("--list", action="store_true", help="check that all texts are there")
    parser.add_argument("names", nargs="*")
    arguments = parser.parse_args()
    build = arguments.build.resolve()
    ninja = shlex.split(arguments.ninja) if arguments.ninja else ["ninja", "-C", str(build)]
    changes = tomllib.loads(LIST.read_text(encoding="utf-8"))["change"]
    if arguments.names:
        changes = [c for c in changes if any(name in c["name"] for name in arguments.names)]
    survived, stale, equivalent = 0, 0, 0
    for change in changes:
        file = ROOT / change["file"]
        before = file.read_text(encoding="utf-8")
        try:
            after = changed(before, change)
            equivalent += "equivalent" in change
            if arguments.list or "equivalent" in change:
                continue
            try:
                file.write_text(after, encoding="utf-8")
                noticed = judge(change, ninja, build)
            finally:
                file.write_text(before, encoding="utf-8")
        except ValueError as error:
            stale += 1
            print(f"error     {change['name']}: {error}", flush=True)
            continue
        survived += noticed is None
        print(f"{'survived ' if noticed is None else 'caught   '} {change['name']}"
              f"{'' if noticed is None else ': ' + noticed}", flush=True)
    print(f"{len(changes)} changes: {survived} survived, {equivalent} change nothing that could be "
          f"noticed, {stale} could not be made")
    sys.exit(2 if stale else 1 if survived else 0)


if __name__ == "__main__":
    main()
