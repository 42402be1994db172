#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Who may include and link whom, by the table in docs/explanation/layers.md.

Reads every #include and the link lines of every CMake file. A test or benchmark may use what it
likes, but nobody includes a file through `..`, and nobody outside drivers/ and tests links what is
defined there. The table itself may not go round in a circle.

A library whose src/ has folders has a table of these rooms in its README.md, and is held to it in
the same way.
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
                    "hwy/": "hwy", "openssl/": "openssl", "lua.hpp": "lua"}
PACKAGE_LINKS = {"fmt::": "fmt", "tl::": "expected", "yaml-cpp": "yaml-cpp", "PNG::": "png",
                 "${CAIRO_": "cairo", "spdlog::": "spdlog", "CLI11::": "cli11", "ZLIB::": "zlib",
                 "PkgConfig::sodium": "sodium", "nlohmann_json": "json",
                 "${backtrace": "backtrace", "GTest::": "gtest", "benchmark::": "benchmark",
                 "Eigen3::": "eigen", "${ZSTD_": "zstd", "Boost::": "boost", "${CMAKE_DL_LIBS}": "dl",
                 "hwy::": "hwy", "CycloneDDS::": "dds", "rave::wire": "wire",
                 "OpenSSL::": "openssl", "rave::ros2_wire": "wire", "PkgConfig::LUA": "lua"}
# The head of the table of the rooms inside a library, in its README.md.
ROOM_TABLE = "room of `src/`"


def tables(tree, page):
    """(first cell of the head, [cells of a row]) of each table of a page."""
    head, rows = None, []
    for line in [*(tree.read(page).splitlines() if page in tree.files else []), ""]:
        cells = [cell.strip() for cell in line.strip().strip("|").split("|")]
        if not line.startswith("|"):
            if head is not None:
                yield head, rows
            head, rows = None, []
        elif head is None:
            head = cells[0]
        elif len(cells) > 2 and not set(cells[0]) <= set("-: "):
            rows.append(cells)


def read_table(tree):
    """{owner: (libraries or None for any, packages or None for any)} of the table of layers."""
    rules = {}
    for cells in [row for head, rows in tables(tree, TABLE) if head == "who" for row in rows]:
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


def circles(rules, page=TABLE):
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
    return [f"{page}: a circle: {ring}" for ring in sorted(findings)]


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


def room_table(tree, folder):
    """({room: (rooms, None)}, {public header: room}) of a library. The row with the name of the
    library itself is about the files that are directly in src/."""
    uses, headers = {}, {}
    rows = [row for head, rows in tables(tree, f"{folder}/README.md") if head == ROOM_TABLE
            for row in rows]
    names = [cells[0].strip("`") for cells in rows]
    for name, cells in zip(names, rows):
        listed = set(re.findall(r"[a-z][a-z0-9_]*", cells[1])) - {"nothing"}
        uses[name] = (set(names) - {name} if listed == {"any"} else listed, None)
        headers |= {header: name for header in re.findall(r"`(\w+\.hpp)`", cells[2])}
    return uses, headers


class InnerRooms:
    """The rooms inside one library."""

    def __init__(self, tree, folder):
        self.tree, self.page, self.name = tree, f"{folder}/README.md", folder.split("/")[-1]
        self.rules, self.headers = room_table(tree, folder)
        self.source = f"{folder}/src/"
        self.public = f"{folder}/include/rave/{self.name}/"
        self.files = set(tree.files)

    def room_of(self, file):
        """The room of a file of the library; None: it has none."""
        if file.startswith(self.public):
            return self.headers.get(file[len(self.public):])
        inner = file[len(self.source):].split("/")
        return inner[0] if len(inner) > 1 else self.name

    def file_of(self, name, target):
        """(file of the library that an include means or None, whether by its name in src/)."""
        if target.startswith(f"rave/{self.name}/"):
            return self.public + target.split("/", 2)[2], True
        if self.source + target in self.files and ".." not in target:
            return self.source + target, True
        beside = posixpath.normpath(posixpath.join(posixpath.dirname(name), target))
        inside = beside.startswith(self.source) and beside in self.files
        return beside if inside else None, False

    def check_file(self, file):
        room = self.room_of(file)
        if room not in self.rules:
            yield f"{file}: no room for it in the table ({self.page})"
            return
        for number, line in common.numbered(self.tree.read(file)):
            match = INCLUDE.match(line)
            used, named = self.file_of(file, match.group(1)) if match else (None, True)
            if not named and used:
                yield (f"{file}:{number}: `{match.group(1)}`: include it as "
                       f"`{used[len(self.source):]}`")
            elif used:
                fault = judge(self.rules[room], room, self.room_of(used), None)
                if fault:
                    yield f"{file}:{number}: {fault} ({self.page})"

    def check(self):
        if not self.rules:
            return [f"{self.page}: no table of the rooms of src/"]
        files = [f for f in self.tree.sources if f.startswith((self.source, self.public))]
        empty = sorted(set(self.rules) - {self.room_of(f) for f in files})
        return (circles(self.rules, self.page) +
                [f"{self.page}: there is no room `{room}`" for room in empty] +
                [finding for file in files for finding in self.check_file(file)])


def check_rooms(tree):
    divided = {f.split("/src/")[0] for f in tree.sources
               if not common.is_support(f) and "/" in f.partition("/src/")[2]}
    return [finding for folder in sorted(divided) for finding in InnerRooms(tree, folder).check()]


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
    return (check_includes(tree, rules, known) + check_links(tree, rules, known) +
            check_rooms(tree))


DOC = """| who | may use | packages | why |
|---|---|---|---|
| `base` | nothing | fmt, expected | |
| `math` | base | none | |
| `sim`, `robot` | base, math, robot | none | |
| `servers` | any | any | |
| `drivers` | base, robot | any | |
| `virtual drivers` | base, robot, sim | any | |
| `programs` | base, robot | none | |
| `host`, `ops` | libs, pace | any | |
| `pace` | base | any | |
| `swarm` | base, sim | any | |
| `cli` | any | any | |
"""
ROOM_DOC = """| room of `src/` | may use | public headers |
|---|---|---|
| `run` | nothing | `source.hpp` |
| `live` | run | none |
| `people` | nothing | none |
| `page` | any | `page.hpp` |
"""
CLEAN = {
    TABLE: DOC,
    "libs/base/a.hpp": '#include <fmt/format.h>\n',
    "libs/math/a.hpp": '#include "rave/base/a.hpp"\n',
    "libs/math/CMakeLists.txt": "rave_library(math DEPS rave::base)\n",
    "libs/robot/a.hpp": '#include "rave/math/a.hpp"\n',
    "libs/robot/tests/t.cpp": '#include "rave/sim/a.hpp"\n#include "../src/b.hpp"\n',
    "libs/sim/a.hpp": '#include "rave/robot/a.hpp"\n',
    "servers/page/README.md": ROOM_DOC,
    "servers/page/include/rave/page/source.hpp": "int x;\n",
    "servers/page/include/rave/page/page.hpp": "int x;\n",
    "servers/page/src/run/log.hpp": '#include "rave/page/source.hpp"\n',
    "servers/page/src/live/feed.cpp": '#include "run/log.hpp"\n#include "rave/page/source.hpp"\n',
    "servers/page/src/people/door.hpp": '#include <vector>\n',
    "servers/page/src/page.cpp": '#include "live/feed.hpp"\n#include "people/door.hpp"\n',
    "servers/page/tests/t.cpp": '#include "people/door.hpp"\n',
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
             "rooms": "servers/page/README.md",
             "run": "servers/page/src/run/log.cpp", "people": "servers/page/src/people/key.cpp",
             "attic": "servers/page/src/attic/old.cpp",
             "face": "servers/page/include/rave/page/face.hpp", "walls": "libs/math/src/fast/a.cpp",
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
    broken("log.cpp:1: `run` may not use `people` (servers/page/README.md)",
           run='#include "people/door.hpp"\n'),
    broken("`people` may not use `run`", people='#include "rave/page/source.hpp"\n'),
    broken("`run` may not use `page`", run='#include "rave/page/page.hpp"\n'),
    broken("key.cpp:1: `door.hpp`: include it as `people/door.hpp`",
           people='#include "door.hpp"\n'),
    broken("include it as `run/log.hpp`", people='#include "../run/log.hpp"\n'),
    broken("old.cpp: no room for it", attic="int x;\n"),
    broken("face.hpp: no room for it", face="int x;\n"),
    broken("libs/math/README.md: no table of the rooms", walls="int x;\n"),
    broken("there is no room `attic`", rooms=ROOM_DOC + "| `attic` | nothing | none |\n"),
    broken("a circle: `live` -> `run` -> `live`",
           rooms=ROOM_DOC.replace("| `run` | nothing |", "| `run` | live |")),
    broken("a circle: `page` -> `run` -> `page`",
           rooms=ROOM_DOC.replace("| `run` | nothing |", "| `run` | page |")),
]

if __name__ == "__main__":
    common.main(check, CLEAN, BREACHES)
