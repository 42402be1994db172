#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Sentences that need no second reading: none is too long, and no word is misspelt.

    tools/lint/prose.py [--self-test] [--root DIR]

A sentence of a page or example has at most MOST_WORDS words; code and tables do not count. The
reading level of a page (Flesch-Kincaid grade: years of school that a reader needs) is at most
MOST_GRADE. codespell looks for misspellings in pages, C++ and TypeScript, and proselint for clumsy
phrases in pages. Where one of the two is not installed the check says what it has not checked; with
CI set that is a finding. The change log and pages that are generated are left out.
"""
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from unittest import mock

import common
import words

MOST_WORDS = 42
# Newspapers have 10 to 12. Shorter pages than LEAST_WORDS give no stable figure.
MOST_GRADE = 10
LEAST_WORDS = 150
# Checks of proselint that do not fit: ASCII in Markdown, words that are meant literally here (a robot
# turns on the spot, ??? in code), and dates in numbers.
UNFIT = ("typography", "cliches", "hyperbolic", "needless_variants.misc", "dates_times",
         "weasel_words", "after_the_deadline",
         "garner.phrasal_adjectives")
# Words of this project that codespell takes for others.
ALLOWED = "crate,kown,ans,te,uint,hist,nd,fo,ot,ba,unter,ser,vor"
HTML = re.compile(r"<!--.*?-->|<[^>\n]*>", re.DOTALL)
BLOCKS = re.compile(r"\n\s*\n|\n(?=\s*(?:[-*]|\d+\.)\s)|\n(?=#)")
SENTENCES = re.compile(r"(?<=[.!?:;])\s+")
LINKS = re.compile(r"\[([^\]]*)\]\([^)]*\)")


def sentences(text):
    """(line, sentence) of a page without its code."""
    text = HTML.sub(words.blank, words.CODE.sub(words.blank, text))
    offset = 0
    for block in BLOCKS.split(text):
        start = text.index(block, offset)
        offset = start + len(block)
        if "|" in block:
            continue
        at = 0
        for sentence in SENTENCES.split(block):
            at = block.index(sentence, at)
            yield text.count("\n", 0, start + at) + 1, LINKS.sub(r"\1", sentence)


def check_lengths(tree):
    for name in filter(words.is_page, tree.files):
        for line, sentence in sentences(tree.read(name)):
            count = len(re.findall(r"[^\W_]+(?:[-'’.][^\W_]+)*", sentence))
            if count > MOST_WORDS:
                yield f"{name}:{line}: a sentence of {count} words; at most {MOST_WORDS}: split it"


def unchecked(tool, package, what):
    """Says that a tool is missing; a finding where every tool must be there."""
    said = f"not checked: {what}; {tool} is missing (Debian: {package})"
    if os.environ.get("CI"):
        return [said]
    print(said, file=sys.stderr)
    return []


def is_spelt(tree, name):
    """Whether people read or write its words: pages, and sources with their comments."""
    if words.is_page(name):
        return True
    # Tests misspell names on purpose.
    if common.is_support(name) or name.startswith("tests/") or name.endswith(".test.ts"):
        return False
    return name in tree.sources or name.startswith("web/") and name.endswith((".ts", ".mjs", ".css"))


def check_spelling(tree):
    names = [name for name in tree.files if is_spelt(tree, name)]
    if not names:
        return []
    if not shutil.which("codespell"):
        return unchecked("codespell", "codespell", f"the spelling of {len(names)} files")
    done = subprocess.run(["codespell", "--ignore-words-list", ALLOWED, *names], cwd=tree.root,
                          capture_output=True, text=True, check=False)
    return done.stdout.splitlines()


def syllables(word):
    """An estimate: groups of vowels, without a silent e."""
    word = word.lower()
    if word.endswith("e") and not word.endswith("le"):
        word = word[:-1]
    return max(1, len(re.findall(r"[aeiouy]+", word)))


def grade(text):
    """The Flesch-Kincaid grade of a page (Kincaid et al. 1975); None for a page with little text."""
    counts = []
    for _, sentence in sentences(text):
        found = re.findall(r"[A-Za-z][A-Za-z'’-]*", sentence)
        if len(found) > 2:
            counts.append((len(found), sum(map(syllables, found))))
    words_, sounds = (sum(column) for column in zip(*counts)) if counts else (0, 0)
    if words_ < LEAST_WORDS:
        return None
    return 0.39 * words_ / len(counts) + 11.8 * sounds / words_ - 15.59


def check_level(tree):
    for name in filter(words.is_page, tree.files):
        level = grade(tree.read(name))
        if level is not None and level > MOST_GRADE:
            yield (f"{name}: reading level {level:.1f}; at most {MOST_GRADE}: shorter sentences, "
                   "shorter words")


def check_style(tree):
    names = list(filter(words.is_page, tree.files))
    if not names:
        return
    if not shutil.which("proselint"):
        yield from unchecked("proselint", "python3-proselint", f"the phrases of {len(names)} pages")
        return
    with tempfile.TemporaryDirectory() as scratch:
        for name in names:
            copy = Path(scratch, name)
            copy.parent.mkdir(parents=True, exist_ok=True)
            copy.write_text(words.page_of(tree, name), encoding="utf-8")
        done = subprocess.run(["proselint", *names], cwd=scratch, capture_output=True, text=True,
                              check=False)
    for line in done.stdout.splitlines():
        what = line.partition(" ")[2]
        if what and not what.startswith(UNFIT):
            yield line


def check(tree):
    return [*check_lengths(tree), *check_level(tree), *check_spelling(tree), *check_style(tree)]


LONG = "One " + "word " * MOST_WORDS + ".\n"
CLEAN = {"docs/a.md": "A sentence. Another one:\n`" + "code " * 60 + "`\n\n| " + "cell " * 60 + "|\n",
         "CHANGELOG.md": LONG}
BREACHES = [("docs/a.md:3: a sentence of 43 words", {"docs/a.md": "# A\n\n" + LONG}),
            ("docs/a.md:2: a sentence", {"docs/a.md": "- short\n- " + LONG})]
HARD = ("Intercontinental organisational responsibilities characteristically necessitate "
        "extraordinary administrative considerations. ")
BREACHES.append(("docs/a.md: reading level", {"docs/a.md": HARD * 20 + "\n"}))
if shutil.which("proselint"):
    BREACHES.append(("docs/a.md:1:", {"docs/a.md": "It was a robot which drove past the ATM machine.\n"}))
if shutil.which("codespell"):
    BREACHES.append(("teh ==> the", {"docs/a.md": "It is teh end.\n"}))



def misses_missing_tools():
    """Whether the check passes in continuous integration although its tools are not there."""
    with tempfile.TemporaryDirectory() as root, mock.patch.object(shutil, "which", lambda _: None), \
            mock.patch.dict(os.environ, {"CI": "1"}):
        Path(root, "a.md").write_text("A page.\n", encoding="utf-8")
        findings = check(common.Tree(root))
    return sum("not checked" in finding for finding in findings) != 2


if __name__ == "__main__":
    if "--self-test" in sys.argv and misses_missing_tools():
        sys.exit("self-test: a missing tool is no finding although CI is set")
    common.main(check, CLEAN, BREACHES)
