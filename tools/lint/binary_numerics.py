#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Whether a library or plug-in of the hashed path calls a function of libm that it must not.

    tools/lint/binary_numerics.py FILE...
    tools/lint/binary_numerics.py --self-test

Sees what numerics.py cannot see in the text: calls through headers, macros and names that are found
elsewhere than they seem. Functions whose result is exact (sqrt, floor, fmod, ...) are fine.
"""
import pathlib
import re
import subprocess
import sys
import tempfile

NAMES = ("sin|cos|tan|asin|acos|atan|atan2|sinh|cosh|tanh|asinh|acosh|atanh|exp|exp2|expm1|log|"
         "log2|log10|log1p|pow|hypot|fma|cbrt|erf|erfc|tgamma|lgamma|sincos")
BANNED = re.compile(rf"^\s*U\s+((?:{NAMES})[fl]?)(?:@\S*)?$", re.MULTILINE)
MEMBER = re.compile(r"^(\S+\.o):$")


def findings_of(path):
    listing = subprocess.run(["nm", "--undefined-only", path], capture_output=True, text=True,
                             check=True).stdout
    found, member = [], ""
    for line in listing.splitlines():
        part = MEMBER.match(line)
        if part:
            member = f"({part.group(1)})"
        match = BANNED.match(line)
        if match:
            found.append(f"{pathlib.Path(path).name}{member}: calls `{match.group(1)}` of libm; "
                         "rave/math/scalar.hpp has one with equal bits everywhere")
    return found


def self_test():
    with tempfile.TemporaryDirectory() as folder:
        for name, text, count in (("bad", "sin(x)", 1), ("good", "sqrt(x)", 0)):
            source, binary = pathlib.Path(folder, name + ".cpp"), pathlib.Path(folder, name + ".o")
            source.write_text(f"#include <cmath>\ndouble f(double x) {{ return std::{text}; }}\n")
            subprocess.run(["g++", "-O2", "-c", source, "-o", binary], check=True)
            if len(findings_of(binary)) != count:
                print(f"self-test: {name}: {findings_of(binary)}")
                return 1
    return 0


def main(arguments):
    if arguments == ["--self-test"]:
        return self_test()
    found = [finding for path in arguments for finding in findings_of(path)]
    print("\n".join(found + [f"{len(arguments)} files, {len(found)} findings"]))
    return 1 if found or not arguments else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
