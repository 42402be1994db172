#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Installs the component doc, and nothing else: no link of its pages leads to something missing.

    tests/install/pages_alone.py --build BUILD
"""
import argparse
import pathlib
import re
import subprocess
import sys
import tempfile
import urllib.parse

SOURCE = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(SOURCE / "tools/lint"))
sys.dont_write_bytecode = True
import links  # pylint: disable=wrong-import-position

# What help, man pages and templates name.
NAMED = re.compile(r"docs/[a-z-]+/[a-z-]+\.md")
NAMERS = ["cli/record_arguments.cpp", "share/templates/panel/README.md"]


def broken_links(root):
    for page in sorted(root.rglob("*.md")):
        text = links.blanked(links.CODE, links.blanked(links.FENCED, page.read_text(encoding="utf-8")))
        for target in links.LINK.findall(text):
            path = urllib.parse.unquote(target).partition("#")[0]
            if path and not links.ELSEWHERE.match(target) and not (page.parent / path).exists():
                yield f"{page.relative_to(root)}: {target}"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--build", required=True)
    build = pathlib.Path(parser.parse_args().build)
    with tempfile.TemporaryDirectory(prefix="rave-doc-") as prefix:
        subprocess.run(["cmake", "--install", build, "--prefix", prefix, "--component", "doc"], check=True,
                       stdout=subprocess.DEVNULL)
        root = pathlib.Path(prefix, "share/doc/rave")
        problems = [f"broken link: {link}" for link in broken_links(root)]
        for namer in NAMERS:
            named = NAMED.findall((SOURCE / namer).read_text(encoding="utf-8"))
            problems += [f"{namer} names {page}" for page in named if not (root / page).exists()]
            if not named:
                problems.append(f"{namer} names no page")
        pages = len(list(root.rglob("*.md")))
        if pages < 60:
            problems.append(f"only {pages} pages are installed")
    print("\n".join(problems) if problems else f"{pages} pages, and each link leads to something")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
