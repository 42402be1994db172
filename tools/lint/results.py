#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Whether a call that can fail can be dropped without a word.

    tools/lint/results.py [--self-test] [--root DIR]

`Result` and `Status` are [[nodiscard]] types, so that no declaration needs the attribute. Compiled
here: short calls that drop them, which must be refused, and calls that use them, which must not.
And what goes round them: a `tl::expected` outside of result.hpp, which may be dropped like any
other value. The compiler is that of the variable CXX, by default g++.
"""
import os
import pathlib
import re
import subprocess
import tempfile

import common

HEADER = "libs/base/include/rave/base/result.hpp"
FLAGS = ["-std=c++20", "-Wall", "-Wextra", "-Werror", "-fsyntax-only"]
PLAIN = re.compile(r"\btl\s*::\s*expected\b")
ATTRIBUTE = re.compile(r"\[\[nodiscard\]\]\s*(?:(?:static|virtual|inline|constexpr)\s+)*$")
# Functions without the attribute of their own.
BEGIN = """#include "rave/base/result.hpp"
rave::Status act();
rave::Result<int> count();
struct Device {
  virtual ~Device() = default;
  virtual rave::Status open() = 0;
};
void call([[maybe_unused]] Device& device);
void call([[maybe_unused]] Device& device) {
"""
USED = ("static_cast<void>(act());", "if (!count()) return;", "const auto status = device.open();"
        " static_cast<void>(status);")
DROPPED = ("act();", "count();", "device.open();", "const auto lambda = [] { return act(); };"
           " lambda();")


def lines_refused(tree, statements):
    """Compiles the statements, one on a line: which of them the compiler refuses, and its words."""
    with tempfile.TemporaryDirectory() as scratch:
        source = pathlib.Path(scratch, "call.cpp")
        body = "".join(f"  {{ {statement} }}\n" for statement in statements)
        source.write_text(BEGIN + body + "}\n", encoding="utf-8")
        include = tree.root.resolve() / HEADER.split("/rave/")[0]
        run = subprocess.run([os.environ.get("CXX", "g++"), *FLAGS, f"-I{include}", source],
                             capture_output=True, text=True, check=False)
    first = BEGIN.count("\n") + 1
    found = re.findall(r"call\.cpp:(\d+):\d+: error: (.*)", run.stderr)
    return {int(line) - first: words for line, words in found}, run.stderr


def check_types(tree):
    refused, said = lines_refused(tree, USED)
    if said:
        yield f"{HEADER}: `{USED[min(refused, default=0)]}` does not compile: {said[:400]}"
    refused, _ = lines_refused(tree, DROPPED)
    for number, statement in enumerate(DROPPED):
        words = refused.get(number, "")
        if "nodiscard" not in words and "unused-result" not in words:
            yield f"{HEADER}: `{statement}` drops an error, and the compiler says nothing"


def check_round(tree):
    for name in tree.sources:
        if name == HEADER:
            continue
        code = common.code_of(tree.read(name))
        for match in PLAIN.finditer(code):
            if ATTRIBUTE.search(code[:match.start()]):
                continue
            line = code.count("\n", 0, match.start()) + 1
            yield (f"{name}:{line}: `tl::expected` can be dropped without a word; expected "
                   f"rave::Result, or a function with [[nodiscard]]")


def check(tree):
    return [*check_types(tree), *check_round(tree)]


def header(attribute):
    return ("#pragma once\nnamespace rave {\ntemplate <class T>\n"
            f"class {attribute} Result {{\n public:\n"
            "  explicit operator bool() const { return true; }\n};\n"
            "using Status = Result<void>;\n}\n")


GOOD = {HEADER: header("[[nodiscard]]")}
CLEAN = GOOD | {"libs/a/a.cpp": "[[nodiscard]] static tl::expected<int, Fault> read();\n"
                                "// as tl::expected does\n"}
BREACHES = [
    (f"{HEADER}: `act();` drops an error", {HEADER: header("")}),
    (f"{HEADER}: `device.open();` drops an error", {HEADER: header("")}),
    ("does not compile", {HEADER: header("[[nodiscard]]").replace("explicit", "private: explicit")}),
    ("libs/a/a.cpp:2: `tl::expected` can be dropped",
     GOOD | {"libs/a/a.cpp": "\ntl::expected<int, Fault> read();\n"}),
]

if __name__ == "__main__":
    common.main(check, CLEAN, BREACHES)
