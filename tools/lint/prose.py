#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Sentences that need no second reading: none is too long, and no word is misspelt.

    tools/lint/prose.py [--self-test] [--root DIR]

A sentence of a page or example has at most MOST_WORDS words; code and tables do not count. Known
misspellings are looked for by codespell, in pages and in the texts of cli/ and libs/config, where that
is installed. The change log and pages that are generated are left out.
"""
import re
import shutil
import subprocess

import common
import words

MOST_WORDS = 42
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


def check_spelling(tree):
    names = [name for name in tree.files if words.is_page(name) or
             name in tree.sources and name.startswith(words.MESSAGE_FOLDERS + ("examples/",)) and
             not common.is_support(name)]
    if not shutil.which("codespell") or not names:
        return
    done = subprocess.run(["codespell", "--ignore-words-list", ALLOWED, *names], cwd=tree.root,
                          capture_output=True, text=True, check=False)
    yield from done.stdout.splitlines()


def check(tree):
    return [*check_lengths(tree), *check_spelling(tree)]


LONG = "One " + "word " * MOST_WORDS + ".\n"
CLEAN = {"docs/a.md": "A sentence. Another one:\n`" + "code " * 60 + "`\n\n| " + "cell " * 60 + "|\n",
         "CHANGELOG.md": LONG}
BREACHES = [("docs/a.md:3: a sentence of 43 words", {"docs/a.md": "# A\n\n" + LONG}),
            ("docs/a.md:2: a sentence", {"docs/a.md": "- short\n- " + LONG})]
if shutil.which("codespell"):
    BREACHES.append(("teh ==> the", {"docs/a.md": "It is teh end.\n"}))

if __name__ == "__main__":
    common.main(check, CLEAN, BREACHES)
