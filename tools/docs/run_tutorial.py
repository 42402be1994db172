#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Does what a tutorial says, in a fresh folder, and looks whether it says what comes out.

    tools/docs/run_tutorial.py PAGE --rave PROGRAM --prefix FOLDER [--copy] [--keep]

Of the fenced blocks of the page, in their order:
  ```sh                       is run with `bash -e`, with rave in the PATH and RAVE_PREFIX set
  ```LANGUAGE title=FILE      is written to FILE, whose folder must exist by then
  ```text title=expect        must stand in the output of the commands before it; `…` stands for
                              anything, on a line of its own for any lines
Everything else (such as ```console) is only shown. With --copy the fresh folder is a copy of the
folder of the page, as of an example.
"""
import argparse
import dataclasses
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

BLOCK = re.compile(r"^```(\w+)?([^\n]*)\n(.*?)^```\s*$", re.MULTILINE | re.DOTALL)
TITLE = re.compile(r"\btitle=(\S+)")
TIMEOUT_S = 300


class Failure(Exception):
    """A sentence that says what is wrong."""


@dataclasses.dataclass
class Block:
    line: int
    language: str
    title: str
    text: str


def blocks_of(page):
    for match in BLOCK.finditer(page):
        title = TITLE.search(match.group(2))
        yield Block(page.count("\n", 0, match.start()) + 1, match.group(1) or "",
                    title.group(1) if title else "", match.group(3))


def is_expected(expected, output):
    """Whether the expected text stands in the output; blanks at the end of lines do not count."""
    expected, output = ("\n".join(line.rstrip() for line in text.strip().splitlines())
                        for text in (expected, output))
    parts = ("[^\\n]*?".join(map(re.escape, part.split("…"))) for part in expected.split("\n…\n"))
    return re.search(r"\n(?:[^\n]*\n)*?".join(parts), output) is not None


def run_commands(block, folder, environment):
    try:
        done = subprocess.run(["bash", "-e", "-c", block.text], cwd=folder, env=environment,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                              timeout=TIMEOUT_S, check=False)
    except subprocess.TimeoutExpired:
        raise Failure(f"line {block.line}: no end after {TIMEOUT_S} s") from None
    if done.returncode != 0:
        raise Failure(f"line {block.line}: exit code {done.returncode}\n{done.stdout}")
    return done.stdout


def write_file(block, folder):
    path = (folder / block.title).resolve()
    if folder.resolve() not in path.parents:
        raise Failure(f"line {block.line}: {block.title} lies outside the folder")
    if not path.parent.is_dir():
        raise Failure(f"line {block.line}: the folder of {block.title} does not exist yet")
    path.write_text(block.text, encoding="utf-8")


def run_page(page, folder, environment):
    """Runs all blocks; the numbers of command, file and expectation blocks."""
    counts = {"commands": 0, "files": 0, "expectations": 0}
    output = None
    for block in blocks_of(page):
        if block.language == "sh":
            output = run_commands(block, folder, environment)
            counts["commands"] += 1
        elif block.title == "expect":
            if output is None:
                raise Failure(f"line {block.line}: nothing was run before")
            if not is_expected(block.text, output):
                raise Failure(f"line {block.line}: expected\n{block.text}\nbut there was\n{output}")
            counts["expectations"] += 1
        elif block.title:
            write_file(block, folder)
            counts["files"] += 1
    return counts


def environment_for(rave, prefix, runtime):
    environment = dict(os.environ, RAVE_PREFIX=str(prefix.resolve()), LC_ALL="C.UTF-8")
    environment["PATH"] = f"{rave.resolve().parent}:{environment.get('PATH', '')}"
    for name in ("RAVE_PLUGIN_PATH", "RAVE_SHARE"):
        environment.pop(name, None)
    # Sockets of runs are there: commands of a page reach its own runs only.
    environment["XDG_RUNTIME_DIR"] = str(runtime)
    if shutil.which("ccache"):
        environment.setdefault("CMAKE_CXX_COMPILER_LAUNCHER", "ccache")
    return environment


SELF_TEST = [
    ("", "```sh\nmkdir d\n```\n```yaml title=d/a.yaml\na: 1\n```\n```sh\ncat d/a.yaml; echo b c d\n"
         "```\n```text title=expect\na: 1\n…\nb … d\n```\n```console\n$ false\n```\n"),
    ("line 1: exit code 1", "```sh\nfalse\ntrue\n```\n"),
    ("but there was", "```sh\necho a\n```\n```text title=expect\nb\n```\n"),
    ("but there was", "```sh\necho b a\n```\n```text title=expect\na … b\n```\n"),
    ("nothing was run", "```text title=expect\nb\n```\n"),
    ("does not exist yet", "```yaml title=d/a.yaml\na: 1\n```\n"),
    ("outside the folder", "```yaml title=../a.yaml\na: 1\n```\n"),
]


def self_test():
    wrong = 0
    for expected, page in SELF_TEST:
        with tempfile.TemporaryDirectory() as folder:
            try:
                run_page(page, pathlib.Path(folder), dict(os.environ))
                found = ""
            except Failure as failure:
                found = str(failure)
        if (expected == "") != (found == "") or expected not in found:
            wrong += 1
            print(f"self-test: expected `{expected}`, found `{found}`")
    print(f"self-test: {len(SELF_TEST)} pages, {wrong} judged wrongly")
    return 1 if wrong else 0


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("page", nargs="?", type=pathlib.Path)
    parser.add_argument("--rave", type=pathlib.Path)
    parser.add_argument("--prefix", type=pathlib.Path)
    parser.add_argument("--copy", action="store_true", help="begin with the files beside the page")
    parser.add_argument("--keep", action="store_true", help="leave the folder for a look")
    parser.add_argument("--self-test", action="store_true")
    arguments = parser.parse_args()
    if arguments.self_test:
        return self_test()
    if not (arguments.page and arguments.rave and arguments.prefix):
        parser.error("PAGE, --rave and --prefix are needed")
    folder = pathlib.Path(tempfile.mkdtemp(prefix="rave-tutorial-"))
    runtime = pathlib.Path(tempfile.mkdtemp(prefix="rave-runtime-"))
    if arguments.copy:
        shutil.copytree(arguments.page.parent, folder, dirs_exist_ok=True)
    try:
        counts = run_page(arguments.page.read_text(encoding="utf-8"), folder,
                          environment_for(arguments.rave, arguments.prefix, runtime))
    except Failure as failure:
        print(f"{arguments.page}: {failure}")
        return 1
    finally:
        shutil.rmtree(runtime, ignore_errors=True)
        if arguments.keep:
            print(f"left {folder}")
        else:
            shutil.rmtree(folder, ignore_errors=True)
    print(f"{arguments.page}: ok,", ", ".join(f"{n} {what}" for what, n in counts.items()))
    return 0 if counts["commands"] and counts["expectations"] else 1


if __name__ == "__main__":
    sys.exit(main())
