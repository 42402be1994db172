# SPDX-License-Identifier: Apache-2.0
"""Reads what `ctest --show-only=json-v1` says and prints the programs of the build tree given as
argument that its tests start, one a line: each is the name of a target."""

import json
import pathlib
import sys


def main() -> None:
    build = pathlib.Path(sys.argv[1])
    tests = json.load(sys.stdin)["tests"]
    programs = {
        pathlib.Path(word).name
        for test in tests
        for word in test.get("command", [])
        if build in pathlib.Path(word).parents and not pathlib.Path(word).suffix
    }
    if not programs:
        sys.exit("no test starts a program of " + str(build))
    print("\n".join(sorted(programs)))


if __name__ == "__main__":
    main()
