#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Keeps the hashed path of a run free of what differs between machines or runs.

On that path (libraries base, math, robot, world, sim; drivers; programs; no tests) nobody calls
functions of the C library whose bits differ with the processor, random numbers other than
rave/base/random.hpp, or a clock on the wall. Exceptions stand in numerics_allow.txt with a reason.
No CMake file may switch on flags that let the compiler change bits.
"""
import re

import common

ALLOW = "tools/lint/numerics_allow.txt"
FOLDERS = ("libs/base/", "libs/math/", "libs/robot/", "libs/world/", "libs/sim/", "drivers/",
           "programs/", "examples/")
NAMES = ("sin|cos|tan|asin|acos|atan|atan2|sinh|cosh|tanh|asinh|acosh|atanh|exp|exp2|expm1|log|"
         "log2|log10|log1p|pow|hypot|fma|cbrt|erf|erfc|tgamma|lgamma|sincos")
LIBM = re.compile(rf"\bstd\s*::\s*({NAMES})[fl]?\s*\(|(?<![\w:])::\s*({NAMES})[fl]?\s*\(|"
                  rf"\b__builtin_({NAMES})[fl]?\s*\(")
BARE_LIBM = re.compile(rf"(?<![\w:.>])({NAMES})[fl]?\s*\(")
BARE_CHANCE = re.compile(r"(?<![\w:.>])(?:s?rand|random|[dlm]rand48)\s*\(")
# What stands before the name where it is declared rather than called: a type.
TYPE_BEFORE = re.compile(r"(\w+|>)[\s&*]+$")
CHANCE = re.compile(r"(?<![\w:.>])(?:s?rand|random|[dlm]rand48)\s*\(")
# What stands before the name where it is declared rather than called.
DECLARED = re.compile(r"(?:(?<!\breturn)(?<!\belse)(?<!\bcase)\b\w+|>)[\s&*]+$")
CHANCE = re.compile(r"#\s*include\s*<random>|\bstd\s*::\s*(?:mt19937(?:_64)?|random_device|"
                    r"default_random_engine|(?:uniform|normal|bernoulli|exponential)\w*_distribution|"
                    r"shuffle)\b|\bstd\s*::\s*s?rand\s*\(")
CLOCK = re.compile(r"\b(?:wall|steady)_ns\s*\(|"
                   r"\b(?:system_clock|steady_clock|high_resolution_clock|file_clock)\b|"
                   r"\b(?:clock_gettime|gettimeofday)\s*\(|\btime\s*\(\s*(?:nullptr|NULL|0)\s*\)")
FLAGS = re.compile(r"-ffast-math|-funsafe-math|-ffp-contract=(?:fast|on)|-Ofast|-fassociative-math|"
                   r"-freciprocal-math|-march=native")


def own_functions(tree):
    """Names that rave/math offers: without a prefix they mean these inside `namespace rave`."""
    text = "".join(common.code_of(tree.read(f)) for f in tree.sources
                   if f.startswith("libs/math/include/"))
    return set(re.findall(rf"\b({NAMES})\s*\(", text))


def allowed(tree):
    """{(file, rule)} of the list of exceptions; a line is `file rule reason`."""
    pairs = set()
    for line in tree.read(ALLOW).splitlines() if ALLOW in tree.files else []:
        words = line.split()
        if words and not line.startswith("#") and len(words) > 2:
            pairs.add((words[0], words[1]))
    return pairs


def bare_calls(line, own):
    """Calls without a prefix, which fall to the C library unless rave/math has the name."""
    for rule, pattern in (("libm", BARE_LIBM), ("chance", BARE_CHANCE)):
        for match in pattern.finditer(line):
            known = match.groups() and match.group(1) in own
            before = TYPE_BEFORE.search(line[:match.start()])
            declared = before and before.group(1) not in ("return", "co_return", "else", "case")
            if not known and not declared:
                yield rule, match.group(0)


def check_source(text, own):
    """(rule, line, what was found)"""
    for number, line in common.numbered(common.code_of(text)):
        for rule, pattern in (("libm", LIBM), ("chance", CHANCE), ("clock", CLOCK)):
            match = pattern.search(line)
            if match:
                yield rule, number, match.group(0).strip()
        for rule, found in bare_calls(line, own):
            yield rule, number, found


ADVICE = {"libm": "its bits differ between processors; rave/math/scalar.hpp has one that does not",
          "chance": "a run could not be repeated; draw from rave/base/random.hpp",
          "clock": "nothing on this path may depend on the time of day; use SimTime"}


def check(tree):
    findings, exceptions, used, own = [], allowed(tree), set(), own_functions(tree)
    for name in tree.sources:
        if not name.startswith(FOLDERS) or common.is_support(name):
            continue
        for rule, number, found in check_source(tree.read(name), own):
            if (name, rule) in exceptions:
                used.add((name, rule))
            else:
                findings.append(f"{name}:{number}: `{found}`: {ADVICE[rule]}")
    for name in tree.cmake_files + [f for f in tree.files if f == "CMakePresets.json"]:
        for number, line in common.numbered(tree.read(name)):
            match = FLAGS.search(line)
            if match:
                findings.append(f"{name}:{number}: `{match.group(0)}` changes the bits of a run")
    findings += [f"{ALLOW}: {name} needs no exception of `{rule}`"
                 for name, rule in sorted(exceptions - used) if name in tree.files]
    return findings


CLEAN = {
    "libs/math/include/rave/math/a.hpp": "double sin(double x);\ndouble cos(double x);\n",
    "libs/math/a.cpp": "double f(double x) { return rave::sin(x); }\n",
    "libs/sim/a.cpp": "// std::sin(x)\nauto y = cos(1.0);\nvoid log(Text text);\n"
                      "RandomStream random() const;\nauto r = item.random();\n"
                      'auto t = "std::exp(1)"; auto z = std::sqrt(2.0) + p.log(1); logic(2);\n',
    "libs/sim/tests/a.cpp": "auto y = std::sin(1.0);\n",
    "libs/report/a.cpp": "auto y = std::sin(1.0);\n",
    "drivers/x/x.cpp": "auto now = std::chrono::steady_clock::now();\n",
    ALLOW: "drivers/x/x.cpp clock a real device\n",
}
BREACHES = [(expected, {"libs/sim/b.cpp": text}) for expected, text in [
    ("std::sin(", "\nauto y = std::sin(1.0);\n"),
    ("libs/sim/b.cpp:2", "\nauto y = std::atan2(1.0, 2.0);\n"),
    ("std::hypot(", "auto y = std::hypot(1.0, 2.0);\n"),
    ("std::fma(", "auto y = std::fma(1.0, 2.0, 3.0);\n"),
    ("cbrt(", "auto y = cbrt(1.0);\n"),
    ("exp(", "double f() { return exp(1.0); }\n"),
    ("::powf(", "auto y = ::powf(1.0f, 2.0f);\n"),
    ("<random>", "#include <random>\n"),
    ("rand(", "int y = rand();\n"),
    ("mt19937", "std::mt19937 engine;\n"),
    ("steady_clock", "auto t = std::chrono::steady_clock::now();\n"),
    ("time(nullptr)", "auto t = time(nullptr);\n"),
    ("wall_ns(", "auto t = wall_ns();\n"),
]] + [
    ("-ffast-math", {"cmake/a.cmake": "add_compile_options(-ffast-math)\n"}),
    ("needs no exception", {"drivers/x/x.cpp": "int x;\n", ALLOW: "drivers/x/x.cpp clock why\n"}),
]

if __name__ == "__main__":
    common.main(check, CLEAN, BREACHES)
