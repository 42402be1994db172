#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Which folder of web/ may import which, by the table in web/README.md.

    tools/lint/page_layers.py [--self-test] [--root DIR]

Reads every import of the TypeScript of the page, those of types and at run time among them. Tests
(`*.test.ts`) may import what they like. The table may not go round in a circle; neither may the imports of
files, but for types, which are gone in the browser.
"""
import posixpath
import re

import common

TABLE = "web/README.md"
ROW = re.compile(r"^\|\s*`([\w/]+)`\s*\|([^|]*)\|")
IMPORT = re.compile(r"^[ \t]*(?:import|export)\s+(type\s)?(?:[^;'\"`]*?\sfrom\s+)?['\"]([^'\"\n]+)['\"]"
                    r"|\bimport\(\s*['\"]([^'\"\n]+)['\"]", re.MULTILINE)
# Files in web/ itself: settings of the tools.
SETTINGS = ("web/vite.config.ts",)


def table(tree):
    """Folder to (line, folders that it may import; None: any)."""
    rows = {}
    for number, line in common.numbered(tree.read(TABLE) if TABLE in tree.files else ""):
        row = ROW.match(line)
        if row:
            names = re.findall(r"`([\w/]+)`", row[2])
            rows[row[1]] = (number, None if row[2].strip() == "any" else names)
    return rows


def folder_of(name):
    parts = name.split("/")[1:-1]
    return "/".join(parts[:2] if parts[:1] == ["panels"] else parts[:1])


def imports(name, text):
    """(line, file as the import names it, whether of types only)."""
    for found in IMPORT.finditer(text):
        to = found[2] or found[3]
        if to.startswith("."):
            line = text.count("\n", 0, found.end()) + 1
            yield line, posixpath.normpath(posixpath.join(posixpath.dirname(name), to)), bool(found[1])


def resolved(files, path):
    return next((p for p in (path + ".ts", path + "/index.ts", path) if p in files), None)


def circle(graph):
    """The names of a circle in {name: names}, or None."""
    done = set()

    def visit(name, path):
        if name in path:
            return [*path[path.index(name):], name]
        if name in done:
            return None
        done.add(name)
        for other in graph.get(name, ()):
            found = visit(other, [*path, name])
            if found:
                return found
        return None

    return next(filter(None, (visit(name, []) for name in graph)), None)


def check(tree):
    files = set(tree.files)
    rows = table(tree)
    if not rows:
        yield f"{TABLE}: expected a table of the folders of web/"
    for name, (number, uses) in rows.items():
        for other in uses or ():
            if other not in rows:
                yield f"{TABLE}:{number}: there is no row for `{other}`"
        if not any(folder_of(f) == name for f in files if f.startswith("web/")):
            yield f"{TABLE}:{number}: there is no folder `{name}`"
    found = circle({name: uses or [] for name, (_, uses) in rows.items()})
    if found:
        yield f"{TABLE}: a circle: " + " -> ".join(f"`{name}`" for name in found)
    graph = {}
    for name in sorted(files):
        if not name.startswith("web/") or not name.endswith(".ts") or name in SETTINGS:
            continue
        if name.endswith(".test.ts"):
            continue
        folder = folder_of(name)
        if folder not in rows:
            yield f"{name}: no row for `{folder}` in {TABLE}"
            continue
        uses = rows[folder][1]
        for line, path, of_types in imports(name, tree.read(name)):
            to = resolved(files, path)
            other = folder_of(to or path + ".ts")
            if other != folder and uses is not None and other not in uses:
                yield f"{name}:{line}: `{folder}` may not import `{other}` ({TABLE})"
            if to and not of_types:
                graph.setdefault(name, []).append(to)
    found = circle(graph)
    if found:
        yield f"{found[0]}: a circle of imports: " + " -> ".join(found)


DOC = """| folder | may import | what |
|---|---|---|
| `protocol` | nothing | messages |
| `model` | `protocol` | the run |
| `panels` | `model`, `protocol` | shared by panels |
| `panels/log` | `panels`, `model` | a panel |
| `panels/map` | `panels`, `panels/log` | a panel |
| `app` | any | the page |
"""
CLEAN = {
    TABLE: DOC,
    "web/vite.config.ts": "import {defineConfig} from 'vitest/config';\n",
    "web/protocol/line.ts": "export const a = 1;\n",
    "web/model/run.ts": "import {\n  a,\n} from '../protocol/line';\nimport type {B} from './other';\n",
    # Of types only, a circle is none.
    "web/model/other.ts": "import './run';\nexport interface B {}\n",
    "web/model/run.test.ts": "import '../app/main';\n",
    "web/panels/look.ts": "import {html} from 'lit';\n",
    "web/panels/log/log_panel.ts": "import '../look';\nimport '../../model/run';\n",
    "web/panels/map/map_panel.ts": "import {x} from '../log/log_panel';\n",
    "web/app/main.ts": "import './base.css';\nconst m = await import('../panels/map/map_panel');\n",
}


def broken(expected, **texts):
    names = {"doc": TABLE, "model": "web/model/bad.ts", "log": "web/panels/log/bad.ts",
             "attic": "web/attic/old.ts", "shared": "web/panels/bad.ts",
             "protocol": "web/protocol/bad.ts"}
    return expected, CLEAN | {names[key]: text for key, text in texts.items()}


BREACHES = [
    broken("web/model/bad.ts:2: `model` may not import `app`", model="// one\nimport '../app/main';\n"),
    broken("bad.ts:3: `model` may not import `panels/log`",
           model="import {\n  x,\n} from '../panels/log/log_panel';\n"),
    # Of types, at run time, and by the way of an export.
    broken("`model` may not import `panels`", model="import type {X} from '../panels/look';\n"),
    broken("`model` may not import `app`", model="const a = () => import('../app/main');\n"),
    broken("`protocol` may not import `model`", protocol="export {B} from '../model/other';\n"),
    broken("`panels/log` may not import `panels/map`", log="import '../map/map_panel';\n"),
    broken("`panels` may not import `panels/log`", shared="import './log/log_panel';\n"),
    broken("web/attic/old.ts: no row for `attic`", attic="export const a = 1;\n"),
    broken("there is no folder `attic`", doc=DOC + "| `attic` | nothing | old |\n"),
    broken("there is no row for `attic`", doc=DOC.replace("| nothing |", "| `attic` |")),
    broken("a circle: `protocol` -> `model` -> `protocol`", doc=DOC.replace("| nothing |", "| `model` |")),
    broken("expected a table", doc="no table\n"),
    ("a circle of imports: web/model/run.ts -> web/model/other.ts -> web/model/run.ts", CLEAN | {"web/model/other.ts": "import {a} from './run';\n",
                                     "web/model/run.ts": "import {b} from './other';\n"}),
]

if __name__ == "__main__":
    common.main(lambda tree: list(check(tree)), CLEAN, BREACHES)
