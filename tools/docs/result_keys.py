#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Whether docs/reference/result.md names each key that the code writes to result.json.

    tools/docs/result_keys.py [--self-test]

The keys are the literals of JSON objects in the sources that are named below, wherever they lie.
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
PAGE = "docs/reference/result.md"
SOURCES = ("result_json.cpp", "result_parts.cpp", "shadows.cpp",
           "host_run.cpp", "live_host_run.cpp")
KEY = re.compile(r'\bjson(?:\["[a-z_]+"\])*\["([a-z_0-9]+)"\]|\bentry\["([a-z_0-9]+)"\]|'
                 r'\{\s*"([a-z_0-9]+)",\s')
CODE = re.compile(r"`([a-z_0-9]+)`")


def keys_of(source):
    return {key for match in KEY.finditer(source) for key in match.groups() if key}


def missing(sources, page):
    known = set(CODE.findall(page))
    return [f"{name}: the key `{key}` is not in {PAGE}"
            for name, text in sources.items() for key in sorted(keys_of(text) - known)]


def self_test():
    source = 'json["a"] = {{"b_c", 1}, {"d", {{"e", 2}}}};\nentry["f"] = f("text", {x, "no"});\n'
    right = keys_of(source) == {"a", "b_c", "d", "e", "f"}
    right = right and missing({"x": source}, "`a` `b_c` `d` `e`") == \
        [f"x: the key `f` is not in {PAGE}"]
    print(f"self-test: {'right' if right else 'wrong'}")
    return 0 if right else 1


def main():
    if "--self-test" in sys.argv:
        return self_test()
    found = {path.relative_to(ROOT).as_posix(): path.read_text(encoding="utf-8")
             for name in SOURCES for path in ROOT.glob(f"*/**/{name}")
             if not {"build", "node_modules", "tests"} & set(path.relative_to(ROOT).parts)}
    findings = [f"there is no source {name} any more; name the one that writes its keys"
                for name in SOURCES if not any(path.endswith("/" + name) for path in found)]
    findings += missing(found, (ROOT / PAGE).read_text(encoding="utf-8"))
    print(*findings, f"{len(found)} sources, {len(findings)} findings", sep="\n")
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main())
