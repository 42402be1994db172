#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Whether every C++ file is laid out as clang-format-16 lays it out (rules in .clang-format)."""
import concurrent.futures
import os
import re
import subprocess

import common

FORMATTER = "clang-format-16"
STYLE = common.REPOSITORY / ".clang-format"
PLACE = re.compile(r"^(\S+?:\d+):\d+: error:", re.MULTILINE)
FILES_AT_ONCE = 12


def check_some(tree, names):
    run = subprocess.run([FORMATTER, "--dry-run", "-Werror", f"--style=file:{STYLE}", *names],
                         cwd=tree.root, capture_output=True, text=True, check=False)
    places = PLACE.findall(run.stderr)
    first_of_file = {place.split(":")[0]: place for place in reversed(places)}
    if run.returncode != 0 and not places:
        return [run.stderr.strip() or f"{FORMATTER} failed"]
    return [f"{place}: not laid out by {FORMATTER}; run `{FORMATTER} -i {file}`"
            for file, place in sorted(first_of_file.items())]


def check(tree):
    names = [name for name in tree.sources if not name.endswith(".in")]
    parts = [names[i:i + FILES_AT_ONCE] for i in range(0, len(names), FILES_AT_ONCE)]
    with concurrent.futures.ThreadPoolExecutor(len(os.sched_getaffinity(0))) as pool:
        return [finding for found in pool.map(lambda part: check_some(tree, part), parts)
                for finding in found]


CLEAN = {"libs/a/a.cpp": "int f(int* x) { return *x; }\n"}
BREACHES = [
    ("libs/a/b.cpp:2", CLEAN | {"libs/a/b.cpp": "int x;\nint f( int *x ){return *x;}\n"}),
    ("not laid out", {"libs/a/b.hpp": "int f() {\n    return 1;\n}\n"}),
]

if __name__ == "__main__":
    common.main(check, CLEAN, BREACHES)
