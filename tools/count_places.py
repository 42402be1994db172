#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Counts the files that know one order, one kind of reading or one event.

    tools/count_places.py reading|order|event [--most N] [--quoted PAGE]
    tools/count_places.py --marker REGEX [--but GLOB ...] [--most N]

A file knows it if it has the marker: the name of its struct or of its enumerator, or its word in
quotes. The example is one that needs nothing of its own, so a new one touches the same files. Not
counted are tests, the change log, and files that only use it, such as the driver that gives the
readings. Exit code 1: more than `--most`, or PAGE does not quote the output.
"""
import argparse
import fnmatch
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
# What to look for, and who only uses it.
EXAMPLES = {
    "reading": (r"\b(NeighbourReading|kNeighbours)\b|['\"`]neighbours['\"`]",
                ["drivers/neighbour_velocity/*", "programs/*"]),
    "order": (r"\b(kPlace|request::Place)\b|['\"]place['\"]", []),
    "event": (r"\bkHandOverRefused\b|['\"`]hand_over_refused['\"`]", []),
}
TESTS = ("*/tests/*", "tests/*", "*/testing/*", "*.test.ts", "*_test.*", "web/e2e/*", "*/fuzz/*")
NOT_PLACES = ("CHANGELOG.md", "tools/count_places.py", "tools/mutations.toml", "docs/how-to/first-change.md")


def tracked():
    listing = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, check=True, capture_output=True)
    return listing.stdout.decode().split("\0")[:-1]


def is_one_of(name, globs):
    return any(fnmatch.fnmatch(name, glob) for glob in globs)


def places(marker, users):
    """The files with the marker, in the order of their names."""
    pattern = re.compile(marker)
    for name in sorted(tracked()):
        if is_one_of(name, (*TESTS, *NOT_PLACES, *users)):
            continue
        path = ROOT / name
        if not path.is_file() or path.is_symlink():
            continue
        try:
            text = path.read_text(encoding="utf-8")
        except UnicodeDecodeError:
            continue
        if pattern.search(text):
            yield name


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("example", nargs="?", choices=EXAMPLES)
    parser.add_argument("--marker", help="regular expression, instead of an example")
    parser.add_argument("--but", action="append", default=[], metavar="GLOB", help="files that only use it")
    parser.add_argument("--most", type=int, help="exit code 1 if there are more")
    parser.add_argument("--quoted", metavar="PAGE", help="exit code 1 unless the page has the output")
    options = parser.parse_args()
    if (options.example is None) == (options.marker is None):
        parser.error("expected an example or --marker")
    marker, users = EXAMPLES[options.example] if options.example else (options.marker, [])
    found = list(places(marker, [*users, *options.but]))
    text = "\n".join([*found, f"{len(found)} files"])
    print(text)
    if options.most is not None and len(found) > options.most:
        sys.exit(f"expected at most {options.most} files: give what they say of it one place")
    if options.quoted and text not in (ROOT / options.quoted).read_text(encoding="utf-8"):
        sys.exit(f"{options.quoted} quotes another list; copy this one")


if __name__ == "__main__":
    main()
