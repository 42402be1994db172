#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Who may include and link whom, by the table in docs/explanation/layers.md.

Reads every #include and the link lines of every CMake file. A test or benchmark may use what it
likes, but nobody includes a file through `..`, and nobody outside drivers/ and tests links what is
defined there. The table itself may not go round in a circle.
"""
import posixpath
import re

import common

TABLE = "docs/explanation/layers.md"
INCLUDE = re.compile(r'^\s*#\s*include\s*["<]([^">]+)[">]')
CALL = re.compile(r"\b(\w+)\s*\(([^()]*(?:\([^()]*\)[^()]*)*)\)")
RAVE_NAME = re.compile(r"^rave(?:::|_)([a-z0-9_]+)$")
# Folders whose folders are libraries with a row each, as those of libs/ are.
ROOMS = ("runtime", "ops", "bench")
# Third-party packages by the start of an include and by the name in a link line.
PACKAGE_INCLUDES = {"fmt/": "fmt", "tl/": "expected", "yaml-cpp/": "yaml-cpp", "png.h": "png",
                    "cairo": "cairo", "spdlog/": "spdlog", "CLI/": "cli11", "zlib.h": "zlib",
                    "sodium": "sodium", "nlohmann/": "json", "backtrace": "backtrace",
                    "gtest/": "gtest", "benchmark/": "benchmark", "dds/": "dds", "idl/": "wire",
                    "Eigen/": "eigen", "zstd.h": "zstd", "boost/": "boost", "dlfcn.h": "dl",
                    "hwy/": "hwy", "openssl/": "openssl"}
PACKAGE_LINKS = {"fmt::": "fmt", "tl::": "expected", "yaml-cpp": "yaml-cpp", "PNG::": "png",
                 "${CAIRO_": "cairo", "spdlog::": "spdlog", "CLI11::": "cli11", "ZLIB::": "zlib",
                 "PkgConfig::sodium": "sodium", "nlohmann_json": "json",
                 "${backtrace": "backtrace", "GTest::": "gtest", "benchmark::": "benchmark",
                 "Eigen3::": "eigen", "${ZSTD_": "zstd", "Boost::": "boost", "${CMAKE_DL_LIBS}": "dl",
                 "hwy::": "hwy", "CycloneDDS::": "dds", "rave::wire": "wire",
                 "OpenSSL::": "openssl", "rave::ros2_wire": "wire"}


def read_table(tree):
    """{owner: (libraries or None for any, packages or None for any)} of the Markdown table."""
    rules = {}
    for line in tree.read(TABLE).splitlines() if TABLE in tree.files else []:
        cells = [cell.strip() for cell in line.strip().strip("|").split("|")]
        if not line.startswith("|") or len(cells) < 3 or set(cells[0]) <= set("-: "):
            continue
        uses = [None if "any" in cell.split() else set(re.findall(r"[a-z][a-z0-9_-]*", cell))
                for cell in cells[1:3]]
        for owner in re.findall(r"`([a-z0-9_ ]+)`", cells[0]):
            rules[owner] = tuple(uses)
    return rules


def owner_of(tree, name):
    """The row of the table that a file falls under, or None if it is bound by none."""
    parts = name.split("/")
    if parts[0] in ("libs", *ROOMS) and len(parts) > 2:
        return parts[1]
    if parts[0] == "drivers" and len(parts) > 2:
        folder = "/".join(parts[:2]) + "/"
        virtual = any("RAVE_VIRTUAL_PLUGIN" in tree.read(f) for f in tree.sources
                      if f.startswith(folder))
        return "virtual drivers" if virtual else "drivers"
    if parts[0] in ("programs", "examples", "servers", "cli"):
        return parts[0]
    return None


def package_of(text, prefixes):
    return next((package for start, package in prefixes.items() if text.startswith(start)), None)


def libraries(tree):
    found = {f.split("/")[1] for f in tree.files if f.startswith("libs/") and f.count("/") > 1}
    served = {f.split("/include/rave/")[1].split("/")[0] for f in tree.files
              if f.startswith(("servers/", "drivers/support/")) and "/include/rave/" in f
              and "/testing/" not in f}
    rooms = {f.split("/")[1] for f in tree.files
             if f.startswith(tuple(room + "/" for room in ROOMS)) and f.count("/") > 1}
    return found, served | rooms


def with_libraries(rules, found):
    """The same table; `libs` in it stands for all libraries of libs/."""
    return {owner: (uses and uses | (found if "libs" in uses else set()), packages)
            for owner, (uses, packages) in rules.items()}


def circles(rules):
    """Rows that use each other in a circle, a line for each."""
    findings, done = set(), set()

    def visit(owner, path):
        if owner in path:
            ring = path[path.index(owner):]
            first = ring.index(min(ring))
            findings.add(" -> ".join(f"`{o}`" for o in ring[first:] + ring[:first + 1]))
        elif owner not in done:
            for used in sorted((rules.get(owner, (None,))[0] or set()) - {owner}):
                visit(used, [*path, owner])
            done.add(owner)

    for owner in sorted(rules):
        visit(owner, [])
    return [f"{TABLE}: a circle: {ring}" for ring in sorted(findings)]


def leaves_folder(name, target):
    """Whether a path through `..` ends outside the library, driver or program of the file."""
    home = "/".join(name.split("/")[:2]) + "/"
    return not posixpath.normpath(posixpath.join(posixpath.dirname(name), target)).startswith(home)


def judge(rule, owner, library, package):
    """What a use breaks, or None."""
    allowed, packages = rule
    if library and allowed is not None and library != owner and library not in allowed:
        return f"`{owner}` may not use `{library}`"
    if package and packages is not None and package not in packages:
        return f"`{owner}` may not use the package `{package}`"
    return None


def check_includes(tree, rules, known):
    findings = []
    for name in tree.sources:
        owner = owner_of(tree, name)
        for number, line in common.numbered(tree.read(name)):
            match = INCLUDE.match(line)
            if not match:
                continue
            target, where = match.group(1), f"{name}:{number}"
            if ".." in target.split("/") and leaves_folder(name, target):
                findings.append(f"{where}: `{target}`: include by the name in the include path")
            if owner is None or common.is_support(name):
                continue
            library = target.split("/")[1] if target.startswith("rave/") else None
            if library and library not in known:
                findings.append(f"{where}: there is no library `{library}`")
                continue
            fault = judge(rules[owner], owner, library, package_of(target, PACKAGE_INCLUDES))
            if fault:
                findings.append(f"{where}: {fault} ({TABLE})")
    return findings


def links_of(text):
    """(line number, linked name) of every call that links a shipped target."""
    text = re.sub(r"#[^\n]*", "", text)
    for call in CALL.finditer(text):
        function, words = call.group(1), call.group(2).split()
        first = words[0] if words else ""
        if function == "target_link_libraries" and not first.startswith(("test_", "bench_")):
            linked = words[1:]
        elif function == "rave_part" and first.endswith("_testing"):
            continue
        elif function in ("rave_library", "rave_part", "rave_plugin", "rave_driver", "rave_program",
                          "rave_executable"):
            starts = [i for i, w in enumerate(words) if w in ("DEPS", "PRIVATE_DEPS")]
            linked = words[starts[0]:] if starts else []
        else:
            continue
        for word in linked:
            yield text.count("\n", 0, call.start()) + 1, word


def check_links(tree, rules, known):
    findings, driver_targets = [], set()
    for name in tree.cmake_files:
        if name.startswith("drivers/"):
            driver_targets |= {f"{start}{part}"
                               for part in re.findall(r"\brave_part\(\s*(\w+)", tree.read(name))
                               for start in ("rave_", "rave::")}
    for name in tree.cmake_files:
        owner = owner_of(tree, name)
        if owner is None or common.is_support(name):
            continue
        for number, word in links_of(tree.read(name)):
            where = f"{name}:{number}"
            outside = not name.startswith("drivers/")
            if word.startswith("rave_plugin_") or (outside and word in driver_targets):
                findings.append(f"{where}: `{word}`: drivers are loaded, never linked")
                continue
            match = RAVE_NAME.match(word)
            library = match.group(1) if match and match.group(1) in known else None
            fault = judge(rules[owner], owner, library, package_of(word, PACKAGE_LINKS))
            if fault:
                findings.append(f"{where}: {fault} ({TABLE})")
    return findings


def check(tree):
    rules = read_table(tree)
    found, served = libraries(tree)
    rules = with_libraries(rules, found)
    findings = circles(rules) + [f"{TABLE}: no row for `{owner}`" for owner in
                sorted({owner_of(tree, f) for f in tree.sources + tree.cmake_files} - {None})
                if owner not in rules]
    if findings:
        return findings
    known = found | served
    return check_includes(tree, rules, known) + check_links(tree, rules, known)


DOC = """| who | may use | packages | why |
|---|---|---|---|
| `base` | nothing | fmt, expected | |
| `math` | base | none | |
| `sim`, `robot` | base, math, robot | none | |
| `drivers` | base, robot | any | |
| `virtual drivers` | base, robot, sim | any | |
| `programs` | base, robot | none | |
| `host`, `ops` | libs, pace | any | |
| `pace` | base | any | |
| `swarm` | base, sim | any | |
| `cli` | any | any | |
"""
CLEAN = {
    TABLE: DOC,
    "libs/base/a.hpp": '#include <fmt/format.h>\n',
    "libs/math/a.hpp": '#include "rave/base/a.hpp"\n',
    "libs/math/CMakeLists.txt": "rave_library(math DEPS rave::base)\n",
    "libs/robot/a.hpp": '#include "rave/math/a.hpp"\n',
    "libs/robot/tests/t.cpp": '#include "rave/sim/a.hpp"\n#include "../src/b.hpp"\n',
    "libs/sim/a.hpp": '#include "rave/robot/a.hpp"\n',
    "drivers/x/x.cpp": '#include "rave/sim/a.hpp"\nRAVE_VIRTUAL_PLUGIN("x")\n',
    "runtime/host/src/h.cpp": '#include "rave/sim/a.hpp"\n#include "rave/pace/a.hpp"\n',
    "runtime/pace/include/rave/pace/a.hpp": '#include "rave/base/a.hpp"\n',
    "bench/bench_a.cpp": '#include "rave/pace/a.hpp"\n',
    "bench/swarm/src/a.cpp": '#include "rave/sim/a.hpp"\n',
    "bench/swarm/tests/t.cpp": '#include "rave/pace/a.hpp"\n',
    "cli/main.cpp": '#include "rave/sim/a.hpp"\n#include "rave/pace/a.hpp"\n',
}


def broken(expected, **files):
    names = {"math": "libs/math/b.cpp", "math_cmake": "libs/math/CMakeLists.txt",
             "driver": "drivers/y/y.cpp", "driver_cmake": "drivers/y/CMakeLists.txt",
             "program": "programs/p/p.cpp", "program_cmake": "programs/p/CMakeLists.txt",
             "cli_cmake": "cli/CMakeLists.txt", "new": "libs/extra/a.cpp",
             "pace": "runtime/pace/src/p.cpp", "swarm": "bench/swarm/src/b.cpp", "room": "runtime/extra/src/a.cpp", "table": TABLE}
    return expected, CLEAN | {names[key]: text for key, text in files.items()}


BREACHES = [
    broken("libs/math/b.cpp:2: `math` may not use `sim`",
           math='// one\n#include "rave/sim/a.hpp"\n'),
    broken("may not use the package `fmt`", math="#include <fmt/core.h>\n"),
    broken("`math` may not use `robot`",
           math_cmake="rave_library(math\n  SOURCES a.cpp\n  PRIVATE_DEPS rave::robot)\n"),
    broken("`drivers` may not use `sim`", driver='#include "rave/sim/a.hpp"\n'),
    broken("`programs` may not use `sim`", program='#include "rave/sim/a.hpp"\n'),
    broken("`programs` may not use `sim`",
           program_cmake="rave_program(p SOURCES p.cpp)\n"
                         "target_link_libraries(rave_plugin_p PRIVATE rave_sim)\n"),
    broken("never linked", cli_cmake="rave_executable(rave DEPS rave_plugin_x)\n"),
    broken("never linked", driver_cmake="rave_part(y_data SOURCES y.cpp)\n",
           cli_cmake="rave_executable(rave DEPS rave_y_data)\n"),
    broken("include by the name", math='#include "../../sim/a.hpp"\n'),
    broken("there is no library", math='#include "rave/smi/a.hpp"\n'),
    broken("no row for `extra`", new="int x;\n"),
    broken("no row for `extra`", room="int x;\n"),
    broken("`swarm` may not use `pace`", swarm='#include "rave/pace/a.hpp"\n'),
    broken("`pace` may not use `host`", pace='#include "rave/host/a.hpp"\n'),
    broken("a circle: `host` -> `pace` -> `host`",
           table=DOC.replace("| `pace` | base |", "| `pace` | base, host |")),
]

if __name__ == "__main__":
    common.main(check, CLEAN, BREACHES)
