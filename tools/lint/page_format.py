#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Whether web/ is formatted, and no line of its TypeScript is over 100 columns.

    tools/lint/page_format.py [--self-test] [--root DIR]

The formatter is Prettier, which is fetched with the npm packages of the page (web/package-lock.json);
`npm run format` in web/ formats with it. Where it is not installed, lines are measured
all the same, and the check then counts as skipped (exit code 77). Prettier leaves texts and comments as
they are, so lines are measured, too.
"""
import argparse
import pathlib
import shutil
import subprocess
import sys

import common

MOST_COLUMNS = 100
SKIPPED = 77
PAGE = common.REPOSITORY / "web"
PRETTIER = PAGE / "node_modules/prettier/bin/prettier.cjs"
# Generated, in a format of its own.
GENERATED = ("web/protocol/messages.ts",)


def formatter():
    node = shutil.which("node") or shutil.which("nodejs")
    return [node, str(PRETTIER)] if node and PRETTIER.exists() else None


def long_lines(tree):
    for name in tree.files:
        if not name.startswith("web/") or not name.endswith(".ts") or name in GENERATED:
            continue
        for number, line in common.numbered(tree.read(name)):
            if len(line) > MOST_COLUMNS:
                yield f"{name}:{number}: {len(line)} columns; expected at most {MOST_COLUMNS}"


def unformatted(tree):
    run = subprocess.run(
        [*formatter(), "--list-different", "--config", str(PAGE / ".prettierrc.json"),
         "--ignore-path", str(PAGE / ".prettierignore"), "."],
        cwd=pathlib.Path(tree.root, "web"), capture_output=True, text=True, check=False)
    for line in run.stderr.splitlines():
        yield f"web: {line}"
    for name in run.stdout.splitlines():
        yield f"web/{name}: not formatted; run `npm run format` in web/"


def check(tree):
    return [*long_lines(tree), *(unformatted(tree) if formatter() else [])]


CLEAN = {"web/app/a.ts": "// SPDX\nexport const a = {b: 'c'};\n",
         "web/app/a.css": "a {\n  color: red;\n}\n"}
BREACHES = [
    ("web/app/b.ts:1: 101 columns", CLEAN | {"web/app/b.ts": "// " + "x" * 98 + "\n"}),
]
# Seen by the formatter only.
FORMAT_BREACHES = [
    ("web/app/b.ts: not formatted", CLEAN | {"web/app/b.ts": "export const a = {b : \"c\"}\n"}),
    ("web/app/b.css: not formatted", CLEAN | {"web/app/b.css": "a { color: red }\n"}),
    ("SyntaxError", CLEAN | {"web/app/b.ts": "export const = 3;\n"}),
]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--self-test", action="store_true")
    parser.add_argument("--root", default=str(common.REPOSITORY))
    arguments = parser.parse_args()
    breaches = BREACHES + (FORMAT_BREACHES if formatter() else [])
    if arguments.self_test:
        failed = common.self_test(check, CLEAN, breaches) > 0
    else:
        findings = check(common.Tree(arguments.root))
        print("\n".join([*findings, f"{len(findings)} findings"]))
        failed = bool(findings)
    if not failed and not formatter():
        print("SKIPPED: the npm packages of the page are missing; build the target rave_page")
        sys.exit(SKIPPED)
    sys.exit(failed)


if __name__ == "__main__":
    main()
