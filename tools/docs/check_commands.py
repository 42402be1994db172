#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Whether each command line of the pages exists: of `rave` its subcommand, options, arguments and
their ranges; of `ninja` its targets; of `ctest -R` that there is such a test.

    tools/docs/check_commands.py --rave PROGRAM [--build FOLDER]

Reads all Markdown files but the change log. What is looked at are lines of code that begin with
`rave` (also `build/release/bin/rave`), and code within a line such as `rave edit add`. Nothing is run
but `rave SUBCOMMAND --help` and `rave --parse-only ...`, which parses and exits. Placeholders such as
N stand for a value (VALUES); code within a sentence may leave out what is required. With --build,
targets and tests of that build are checked, too.
"""
import argparse
import functools
import pathlib
import re
import shlex
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
# What a placeholder stands for where the program wants a number. Others are words, which are values.
VALUES = {"N": "2", "S": "2", "SECONDS": "2", "X": "1", "Y": "1", "V": "0.1", "W": "0.1", "PORT": "9000",
          "X,Y": "1,2", "HZ": "10", "KB": "10", "T": "1", "DOMAIN": "1"}
# What is left out, in an error message.
MISSING = re.compile(r": missing |: found nothing, expected |: found \d+ words?, expected ")
NINJA = re.compile(r"\bninja\s+-C\s+build/\S+((?:[ \t]+[\w-]+)+)")
CTEST = re.compile(r"\bctest\b[^`\n]*?\s-R\s+(?:'([^']+)'|\"([^\"]+)\"|([^\s`]+))")


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

    def parse(self, words):
        """The error of a command line, which is not run; empty if it can be parsed."""
        done = subprocess.run([self.rave, "--parse-only", *words], capture_output=True, text=True,
                              timeout=60, check=False)
        return "" if done.returncode == 0 else done.stderr.strip().splitlines()[0]

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
    """(line number, what stands behind `rave`, whether it is a whole line)."""
    for pattern in (FENCED, INDENTED):
        for match in pattern.finditer(page):
            text = match.group(2) if pattern is FENCED else match.group(0)
            begin = page.count("\n", 0, match.start(2) if pattern is FENCED else match.start())
            for number, line in logical_lines(text):
                for part in re.split(r"&&|\|\||;|\|", line):
                    found = COMMAND.match(part)
                    if found:
                        yield begin + number, found.group(1), True
    bare = FENCED.sub(lambda m: re.sub(r"[^\n]", " ", m.group(0)), page)
    for match in INLINE.finditer(bare):
        yield bare.count("\n", 0, match.start()) + 1, match.group(1).partition(" ")[2], False


def arguments_of(line):
    """The words as the shell would give them to `rave`; None if they cannot be known."""
    line = re.sub(r"\s*(?:\d?>&?|<)\s*\S+.*$|\s*&\s*$", "", line)
    # The last is the usage of a command.
    if "..." in line or "…" in line or "[OPTIONS]" in line:
        return None
    try:
        words = shlex.split(line)
    except ValueError:
        return None
    # Such as `[--bare]`: what may be left out is left in.
    words = [word.strip("[]") for word in words if word.strip("[]")]
    return [VALUES.get(word, word) for word in words]


def problem_of(line, is_whole, told):
    """What is wrong with a command line, or None."""
    words, chain = line.split(), ()
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
    arguments = arguments_of(line)
    if arguments is None or {"-h", "--help"} & set(arguments):
        return None
    error = told.parse(tuple(arguments))
    if error == "" or not is_whole and MISSING.search(error):
        return None
    return f"`rave {line.strip()}`: {error}"


def check(pages, told):
    return [f"{name}:{number}: {problem}" for name, text in pages.items()
            for number, line, is_whole in commands_of(text)
            if (problem := problem_of(line, is_whole, told)) is not None]


def check_build(pages, targets, tests):
    """Targets of ninja and tests of ctest that pages name and the build does not have."""
    for name, text in pages.items():
        for match in NINJA.finditer(text):
            for word in match.group(1).split():
                # `-j 2` and placeholders.
                if not word.startswith("-") and not word.isdigit() and not word.isupper() and word not in targets:
                    yield f"{name}:{text.count(chr(10), 0, match.start()) + 1}: there is no target `{word}`"
        for match in CTEST.finditer(text):
            pattern = next(filter(None, match.groups()))
            if not pattern.isupper() and not any(re.search(pattern, test) for test in tests):
                yield f"{name}:{text.count(chr(10), 0, match.start()) + 1}: no test has the name `{pattern}`"


def built(build):
    """The targets and the tests of a build."""
    listed = subprocess.run(["ninja", "-C", build, "-t", "targets", "all"], capture_output=True, text=True,
                            check=True).stdout
    tests = subprocess.run(["ctest", "--test-dir", build, "-N"], capture_output=True, text=True, check=True).stdout
    return ({line.split(":")[0] for line in listed.splitlines() if ":" in line},
            re.findall(r"Test\s+#\d+: (\S+)", tests))


class FakeHelp(Help):
    TEXTS = {(): "Options:\n  -h,--help\n\nRuns:\n  run   Run\n\nOther things:\n  edit  Edit\n\n"
                 "Examples:\n  walk\n\nMore\n",
             ("run",): "Options:\n  --seed N\n",
             ("edit",): "\nSubcommands:\n  add   Add\n", ("edit", "add"): "  --at PLACE\n"}

    def text(self, words):
        return self.TEXTS.get(words, "")

    def parse(self, words):
        if words == ("edit",):
            return "error: missing subcommand of `rave edit`"
        if "--seed" in words and not words[words.index("--seed") + 1].isdigit():
            return "error: --seed: expected a number"
        return ""


CLEAN = ("`rave SUBCOMMAND --help`, `rave edit` and `rave run a --seed N`.\n\n    build/release/bin/rave run a --seed 1  # --no\n\n"
         "```sh\nrave edit add box \\\n  --at 1,2 && rave run b\necho rave nothing\n```\n")
BREACHES = [("a:1: there is no `rave walk`", "See `rave walk`.\n"),
            ("a:3: `rave run` has no option `--sed`", "A\n\n    rave run a --sed 1\n"),
            ("a:3: `rave edit add` has no option", "```\nrave run\nrave edit add \\\n --to 1\n```\n"),
            ("a:2: there is no `rave nothing`", "```\ntrue; rave nothing\n```\n"),
            ("a:1: `rave run a --seed x`: error: --seed: expected", "See `rave run a --seed x`.\n"),
            ("a:3: `rave edit`: error: missing subcommand", "A\n\n    rave edit\n")]
BUILD_CLEAN = "`ninja -C build/release rave_math -j 2`, `ninja -C build/x NAME` and ctest -R 'ma|x'\n"
BUILD_BREACHES = [("a:2: there is no target `rave_mat`", "\nninja -C build/release rave_math rave_mat\n"),
                  ("a:1: no test has the name `^mat$`", "ctest --test-dir b -R '^mat$'\n")]


def self_test():
    told = FakeHelp("")
    wrong = [f"unexpected: {finding}" for finding in check({"a": CLEAN}, told)]
    for expected, text in BREACHES:
        found = check({"a": text}, told)
        if not any(expected in finding for finding in found):
            wrong.append(f"expected {expected}, found {found}")
    wrong += [f"unexpected: {finding}" for finding in check_build({"a": BUILD_CLEAN}, {"rave_math"}, ["math"])]
    for expected, text in BUILD_BREACHES:
        if not any(expected in finding for finding in check_build({"a": text}, {"rave_math"}, ["math"])):
            wrong.append(f"expected {expected}")
    print(*wrong, f"self-test: {len(BREACHES + BUILD_BREACHES)} breaches, {len(wrong)} judged wrongly", sep="\n")
    return 1 if wrong else 0


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--rave")
    parser.add_argument("--build")
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
    if arguments.build:
        findings += check_build(pages, *built(arguments.build))
    count = sum(1 for text in pages.values() for _ in commands_of(text))
    print(*findings, f"{count} command lines, {len(findings)} findings", sep="\n")
    return 1 if findings or not count else 0


if __name__ == "__main__":
    sys.exit(main())
