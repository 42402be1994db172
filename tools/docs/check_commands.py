#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Whether each `rave` command line of the pages exists: its subcommand and its options.

    tools/docs/check_commands.py --rave PROGRAM

Reads all Markdown files but the change log. What is looked at are lines of code that begin with
`rave` (also `build/release/bin/rave`), and code within a line such as `rave edit add`. Nothing is run
but `rave SUBCOMMAND --help`.
"""
import argparse
import functools
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
FENCED = re.compile(r"^(```|~~~)[^\n]*\n(.*?)^\1\s*$", re.MULTILINE | re.DOTALL)
INDENTED = re.compile(r"(?<=\n\n)(?: {4}[^\n]*\n)+")
INLINE = re.compile(r"`(rave [^`\n]*)`")
COMMAND = re.compile(r"^\s*(?:\$ )?(?:sudo |nice )?(?:build/release/bin/)?rave\s+(.*)$")
NAME = re.compile(r"^[a-z][a-z-]*$")
# A heading of the help, and the lines below it; those of OTHERS list no subcommands.
BLOCK = re.compile(r"^([A-Z][^\n:]*):\n((?:  [^\n]*\n)+)", re.MULTILINE)
OTHERS = ("Positionals", "Options", "Examples", "Example")
OPTION = re.compile(r"^(--[a-z][a-z-]*)")


class Help:
    """What `rave ... --help` says, asked once of each subcommand."""

    def __init__(self, rave):
        self.rave = rave

    @functools.cache
    def text(self, words):
        done = subprocess.run([self.rave, *words, "--help"], capture_output=True, text=True,
                              timeout=60, check=False)
        return done.stdout if done.returncode == 0 else ""

    @functools.cache
    def subcommands(self, words):
        return {name for heading, block in BLOCK.findall(self.text(words)) if heading not in OTHERS
                for name in re.findall(r"^  ([a-z][a-z-]*)\b", block, re.MULTILINE)}

    @functools.cache
    def options(self, words):
        return set(re.findall(r"(?<![\w-])--[a-z][a-z-]*", self.text(words)))


def logical_lines(text):
    """(line number, line) with continuation lines joined and comments removed."""
    number, joined = 1, ""
    for offset, line in enumerate(text.splitlines(), start=1):
        number = number if joined else offset
        if line.rstrip().endswith("\\"):
            joined += line.rstrip()[:-1] + " "
            continue
        yield number, re.sub(r"\s#.*$", "", joined + line)
        joined = ""


def commands_of(page):
    """(line number, words behind `rave`)."""
    for pattern in (FENCED, INDENTED):
        for match in pattern.finditer(page):
            text = match.group(2) if pattern is FENCED else match.group(0)
            begin = page.count("\n", 0, match.start(2) if pattern is FENCED else match.start())
            for number, line in logical_lines(text):
                for part in re.split(r"&&|\|\||;|\|", line):
                    found = COMMAND.match(part)
                    if found:
                        yield begin + number, found.group(1).split()
    bare = FENCED.sub(lambda m: re.sub(r"[^\n]", " ", m.group(0)), page)
    for match in INLINE.finditer(bare):
        yield bare.count("\n", 0, match.start()) + 1, match.group(1).split()[1:]


def problem_of(words, told):
    """What is wrong with a command line, or None."""
    chain = ()
    for word in words:
        if word.startswith("-"):
            break
        known = told.subcommands(chain)
        if word in known:
            chain += (word,)
        elif not chain:
            # Such as `rave SUBCOMMAND` or `rave ...`.
            return f"there is no `rave {word}`" if NAME.match(word) else None
    known = told.options(chain) | told.options(())
    for word in words:
        option = OPTION.match(word.strip("[](),.:"))
        if option and option.group(1) not in known | {"--help", "--version"}:
            return f"`rave {' '.join(chain)}` has no option `{option.group(1)}`"
    return None


def check(pages, told):
    return [f"{name}:{number}: {problem}" for name, text in pages.items()
            for number, words in commands_of(text)
            if (problem := problem_of(words, told)) is not None]


class FakeHelp(Help):
    TEXTS = {(): "Options:\n  -h,--help\n\nRuns:\n  run   Run\n\nOther things:\n  edit  Edit\n\n"
                 "Examples:\n  walk\n\nMore\n",
             ("run",): "Options:\n  --seed N\n",
             ("edit",): "\nSubcommands:\n  add   Add\n", ("edit", "add"): "  --at PLACE\n"}

    def text(self, words):
        return self.TEXTS.get(words, "")


CLEAN = ("`rave SUBCOMMAND --help` and `rave run`.\n\n    build/release/bin/rave run a --seed 1  # --no\n\n"
         "```sh\nrave edit add box \\\n  --at 1,2 && rave run b\necho rave nothing\n```\n")
BREACHES = [("a:1: there is no `rave walk`", "See `rave walk`.\n"),
            ("a:3: `rave run` has no option `--sed`", "A\n\n    rave run a --sed 1\n"),
            ("a:3: `rave edit add` has no option", "```\nrave run\nrave edit add \\\n --to 1\n```\n"),
            ("a:2: there is no `rave nothing`", "```\ntrue; rave nothing\n```\n")]


def self_test():
    told = FakeHelp("")
    wrong = [f"unexpected: {finding}" for finding in check({"a": CLEAN}, told)]
    for expected, text in BREACHES:
        found = check({"a": text}, told)
        if not any(expected in finding for finding in found):
            wrong.append(f"expected {expected}, found {found}")
    print(*wrong, f"self-test: {len(BREACHES)} breaches, {len(wrong)} judged wrongly", sep="\n")
    return 1 if wrong else 0


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--rave")
    parser.add_argument("--self-test", action="store_true")
    arguments = parser.parse_args()
    if arguments.self_test:
        return self_test()
    if not arguments.rave:
        parser.error("--rave is needed")
    listed = subprocess.run(["git", "-c", "safe.directory=*", "ls-files", "*.md"], cwd=ROOT,
                            capture_output=True, text=True, check=False).stdout.split()
    names = listed or [p.relative_to(ROOT).as_posix() for folder in ("docs", "scenarios", "drivers")
                       for p in (ROOT / folder).rglob("*.md")]
    pages = {name: (ROOT / name).read_text(encoding="utf-8") for name in names
             if name != "CHANGELOG.md" and not name.startswith("share/templates/")}
    findings = check(pages, Help(arguments.rave))
    count = sum(1 for text in pages.values() for _ in commands_of(text))
    print(*findings, f"{count} command lines, {len(findings)} findings", sep="\n")
    return 1 if findings or not count else 0


if __name__ == "__main__":
    sys.exit(main())
