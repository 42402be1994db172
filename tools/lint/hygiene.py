#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What every file of the repository must keep to, whatever is in it.

A licence line on top of sources and scripts; no path of one machine; nothing left to do; file names
in lower case; libraries that neither print nor exit; no large files. Each library has a README, and
each linked target is made by rave_library() or rave_part(). Headers beyond 250 lines are named,
without being an error.
"""
import posixpath
import re
import sys

import common

LICENCE = "SPDX-License-Identifier: Apache-2.0"
SCRIPT_ENDS = (".py", ".sh", ".cmake", ".cmake.in", "CMakeLists.txt", ".js", ".ts")
SCRIPTS = ("run", "test", ".ci/run")
TEXT_ENDS = (*common.SOURCE_ENDS, *SCRIPT_ENDS, ".md", ".yaml", ".yml", ".json", ".txt", ".in",
             ".idl", ".html", ".css", ".svg")
# Put together here, so that this file does not find itself.
LEFT_TO_DO = re.compile(r"\b(?:" + "|".join(("TO" "DO", "FIX" "ME", "X" "XX", "HA" "CK")) + r")\b")
MACHINE_PATH = re.compile(r"(?<![\w.}>/])/(?:home|work|root|Users|mnt)/")
TEMPORARY_PATH = re.compile(r"(?<![\w.}>/])/tmp/")
FILE_NAME = re.compile(r"^[a-z0-9_@][a-z0-9_.@-]*$", re.IGNORECASE)
SNAKE_CASE = re.compile(r"^(?:[a-z0-9]+|@NAME@)(?:_(?:[a-z0-9]+|@NAME@))*$")
OUTPUT = re.compile(r"(?<![\w.>])(?:std\s*::\s*)?(?:exit|_exit|quick_exit|printf|fprintf|puts|"
                    r"putchar|vprintf)\s*\(|\bstd\s*::\s*(?:cout|cerr|clog)\b|"
                    r"\bfmt\s*::\s*print\s*\(")
# The one place of a library that speaks: it says which check failed before the process aborts.
MAY_PRINT = ("libs/base/src/check.cpp",)
LARGEST_BYTES = 1_000_000
# A folder in one of these is a library.
LIBRARY_FOLDERS = ("libs", "runtime", "ops", "servers", "bench")
BY_HAND = re.compile(r"\badd_library\(\s*\w+\s+(?:STATIC|SHARED|OBJECT)\b")
# A path into the tests of another folder; data files may lie there.
OTHERS_TESTS = re.compile(r"(?:CMAKE_SOURCE_DIR\}|\.\.)/[\w./]*\btests(?:/[\w./]*\.[ch]pp|[/\w]*\"?\)|/\w+\"?\s)")
# The same in a source; data files may lie there, and a folder may name its own tests.
INCLUDED_TESTS = re.compile(r'^\s*#\s*include\s*["<]([^">]*\btests/[^">]*)[">]')
LONG_HEADER_LINES = 250


def is_script(tree, name):
    return name.endswith(SCRIPT_ENDS) or name in SCRIPTS


def check_names(tree):
    for name in tree.files:
        last = name.split("/")[-1]
        if name.endswith((*common.SOURCE_ENDS, ".py", ".sh")):
            if not SNAKE_CASE.match(last.split(".")[0]):
                yield f"{name}: file names are snake_case"
        elif not FILE_NAME.match(last.lstrip(".")):
            yield f"{name}: unusual characters in a file name"


def check_sizes(tree):
    for name in tree.files:
        size = (tree.root / name).stat().st_size
        if size > LARGEST_BYTES and not name.startswith(("data/", "docs/images/")):
            yield f"{name}: {size} bytes; more than {LARGEST_BYTES} only in data/ and docs/images/"


def check_licence(tree):
    for name in tree.files:
        if name.endswith(common.SOURCE_ENDS) or is_script(tree, name):
            if LICENCE not in "\n".join(tree.read(name).splitlines()[:3]):
                yield f"{name}:1: the line `{LICENCE}` is missing"


def is_test(name):
    parts = name.split("/")
    return common.is_support(name) or parts[0] == "tests" or parts[-1].endswith("_test.cpp")


def check_text(tree):
    for name in tree.files:
        if not (name.endswith(TEXT_ENDS) or is_script(tree, name)):
            continue
        if name == "tools/lint/hygiene.py":
            continue
        for number, line in common.numbered(tree.read(name)):
            if LEFT_TO_DO.search(line):
                yield f"{name}:{number}: something is left to do: {line.strip()[:60]}"
            if MACHINE_PATH.search(line) or (
                    TEMPORARY_PATH.search(line) and not is_test(name) and not name.endswith(".md")):
                yield f"{name}:{number}: the path of one machine: {line.strip()[:60]}"


def check_output(tree):
    for name in tree.sources:
        if not name.startswith("libs/") or common.is_support(name) or name in MAY_PRINT:
            continue
        for number, line in common.numbered(common.code_of(tree.read(name))):
            match = OUTPUT.search(line)
            if match:
                yield f"{name}:{number}: `{match.group(0)}`: libraries do not print and do not exit"


def check_libraries(tree):
    for name in tree.cmake_files:
        parts = name.split("/")
        if parts[0] not in LIBRARY_FOLDERS or len(parts) != 3:
            continue
        folder = "/".join(parts[:2])
        if f"{folder}/README.md" not in tree.files:
            yield f"{folder}: a library has a README.md of some ten lines"
    for name in tree.cmake_files:
        if name.startswith("cmake/"):
            continue
        for number, line in common.numbered(tree.read(name)):
            if BY_HAND.search(line):
                yield f"{name}:{number}: a library is made by rave_library() or rave_part()"
            if OTHERS_TESTS.search(line):
                yield f"{name}:{number}: what several folders test with is in a folder `testing`"


def check_included_tests(tree):
    for name in tree.sources:
        folder = "/".join(name.split("/")[:2]) + "/"
        for number, line in common.numbered(tree.read(name)):
            match = INCLUDED_TESTS.match(line)
            if not match:
                continue
            target = match.group(1)
            place = posixpath.normpath(posixpath.join(posixpath.dirname(name), target))
            if not target.startswith("../") or not place.startswith(folder):
                yield f"{name}:{number}: what several folders test with is in a folder `testing`"


def long_headers(tree):
    for name in tree.sources:
        lines = tree.read(name).count("\n")
        if name.endswith(".hpp") and lines > LONG_HEADER_LINES:
            yield f"long header: {name}: {lines} lines"


def check(tree):
    rules = (check_names, check_sizes, check_licence, check_text, check_output, check_libraries,
             check_included_tests)
    return [finding for rule in rules for finding in rule(tree)]


TOP = f"// {LICENCE}\n"
CLEAN = {
    "libs/a/src/good_name.cpp": TOP + '#include "a/home/b.hpp"\nint exits = log.printf_like(1);\n',
    "libs/a/bench/b.cpp": TOP + '#include "../tests/c.hpp"\n',
    "libs/a/tests/good_test.cpp": TOP + 'auto p = "/tmp/x"; std::printf("x");\n',
    "cli/main.cpp": TOP + 'int main() { std::exit(1); }\n',
    "tools/a.py": f"#!/usr/bin/env python3\n# {LICENCE}\n",
    "docs/Guide-1.md": "Look at /tmp/x.\n",
    "libs/a/CMakeLists.txt": f"# {LICENCE}\nrave_library(a)\nadd_library(a_testing INTERFACE)\n",
    "libs/a/README.md": "# a\n",
}
BREACHES = [
    ("is missing", {"libs/a/a.cpp": "int x;\n"}),
    ("is missing", {"tools/a.sh": "#!/bin/sh\n"}),
    ("is missing", {"libs/CMakeLists.txt": "add_subdirectory(a)\n"}),
    ("snake_case", {"libs/a/BadName.cpp": TOP}),
    ("left to do", {"libs/a/a.cpp": TOP + "// TO" "DO: more\n"}),
    ("left to do", {"docs/a.md": "FIX" "ME\n"}),
    ("path of one machine", {"libs/a/a.cpp": TOP + 'auto p = "/ho' 'me/me/x";\n'}),
    ("path of one machine", {"docs/a.md": "see /wo" "rk/x\n"}),
    ("path of one machine", {"libs/a/a.cpp": TOP + 'auto p = "/tmp/x";\n'}),
    ("do not print", {"libs/a/a.cpp": TOP + 'void f() { std::printf("x"); }\n'}),
    ("do not print", {"libs/a/a.cpp": TOP + "void f() { std::cout << 1; }\n"}),
    ("do not print", {"libs/a/a.cpp": TOP + "void f() { exit(1); }\n"}),
    ("runtime/a: a library has a README", {"runtime/a/CMakeLists.txt": f"# {LICENCE}\n"}),
    ("bench/a: a library has a README", {"bench/a/CMakeLists.txt": f"# {LICENCE}\n"}),
    ("made by rave_library", {"ops/a/CMakeLists.txt": f"# {LICENCE}\nadd_library(a STATIC a.cpp)\n",
                              "ops/a/README.md": "# a\n"}),
    ("rave_part", {"drivers/a/CMakeLists.txt": f"# {LICENCE}\nadd_library(a STATIC a.cpp)\n"}),
    ("folder `testing`", {"bench/CMakeLists.txt": f"# {LICENCE}\ntarget_include_directories(a PRIVATE "
                                                 '"${CMAKE_SOURCE_DIR}/libs/a/tests")\n'}),
    ("folder `testing`", {"bench/CMakeLists.txt": f"# {LICENCE}\n"
                                                 "rave_test(a SOURCES ../libs/a/tests/b.cpp)\n"}),
    ("folder `testing`", {"libs/a/tests/a_test.cpp": TOP + '#include "b/tests/c.hpp"\n'}),
    ("folder `testing`", {"libs/a/tests/a_test.cpp": TOP + '#include "../../b/tests/c.hpp"\n'}),
    ("bytes; more", {"docs/a.bin": "x" * (LARGEST_BYTES + 1)}),
]

if __name__ == "__main__":
    if "--self-test" not in sys.argv:
        print("\n".join(long_headers(common.Tree(common.REPOSITORY))))
    common.main(check, CLEAN, BREACHES)
