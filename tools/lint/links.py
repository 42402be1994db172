#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Whether every relative link of a Markdown file leads to something: a file or folder of the
repository and, behind `#`, a heading of it. Links to other sites are not followed.
"""
import posixpath
import re
import urllib.parse

import common

FENCED = re.compile(r"^(```|~~~).*?^\1[^\n]*$", re.MULTILINE | re.DOTALL)
CODE = re.compile(r"`[^`\n]*`")
LINK = re.compile(r"!?\[(?:[^\[\]]|\[[^\[\]]*\])*\]\(\s*<?([^)\s>]+)>?(?:\s+\"[^\"]*\")?\s*\)")
HEADING = re.compile(r"^#{1,6}\s+(.*?)\s*#*\s*$", re.MULTILINE)
ELSEWHERE = re.compile(r"^[a-z][a-z0-9+.-]*:", re.IGNORECASE)


def blanked(pattern, text):
    return pattern.sub(lambda m: re.sub(r"[^\n]", " ", m.group(0)), text)


def anchors_of(text):
    """As the usual hosts make them: lower case, punctuation dropped, blanks to dashes, numbered."""
    found = set()
    for heading in HEADING.findall(blanked(FENCED, text)):
        plain = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).lower()
        anchor = re.sub(r"[^\w\- ]", "", plain).replace(" ", "-")
        number, name = 0, anchor
        while name in found:
            number += 1
            name = f"{anchor}-{number}"
        found.add(name)
    return found


def check_link(tree, page, target, there):
    path, _, anchor = urllib.parse.unquote(target).partition("#")
    name = page
    if path:
        if path.startswith("/"):
            return "is not relative"
        name = posixpath.normpath(posixpath.join(posixpath.dirname(page), path))
        if name not in there:
            return "leads to nothing in the repository"
    if anchor and name.endswith(".md") and anchor not in anchors_of(tree.read(name)):
        return f"leads to no heading of {name}"
    return None


def check(tree):
    there = set(tree.files) | {"."}
    for name in tree.files:
        while "/" in name:
            name = posixpath.dirname(name)
            there.add(name)
    findings = []
    for page in tree.files:
        # A template's links are those of the project that is made from it.
        if not page.endswith(".md") or common.is_template(page):
            continue
        text = blanked(CODE, blanked(FENCED, tree.read(page)))
        for match in LINK.finditer(text):
            if ELSEWHERE.match(match.group(1)):
                continue
            problem = check_link(tree, page, match.group(1), there)
            if problem:
                line = text.count("\n", 0, match.start()) + 1
                findings.append(f"{page}:{line}: the link {match.group(1)} {problem}")
    return findings


CLEAN = {
    "README.md": "# A `b` (c)\n[x](docs/a.md#two-words-1) ![p](docs/) [y](https://a.b/c) "
                 "[z](#a-b-c)\n```\n[no](nowhere)\n```\n`[no](nowhere)`\n",
    "docs/a.md": "# Two words\n## Two words\n[up](../README.md)\n",
}
BREACHES = [
    ("README.md:2: the link docs/b.md leads to nothing", {"README.md": "# A\n[x](docs/b.md)\n"}),
    ("no heading of README.md", {"README.md": "# A\n[x](#b)\n"}),
    ("no heading of a.md", {"README.md": "[x](a.md#c)\n", "a.md": "# B\n```\n# C\n```\n"}),
    ("leads to nothing", {"docs/a.md": "[x](../../b.md)\n", "b.md": ""}),
    ("not relative", {"docs/a.md": "[x](/b.md)\n", "b.md": ""}),
]

if __name__ == "__main__":
    common.main(check, CLEAN, BREACHES)
