#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Does what a tutorial says, in a fresh folder, and looks whether it says what comes out.

    tools/docs/run_tutorial.py PAGE --rave PROGRAM --prefix FOLDER [--path FOLDER] [--copy] [--alone] [--keep]

Of the fenced blocks of the page, in their order:
  ```sh                       is run with `bash -e`, with rave in the PATH and RAVE_PREFIX set
  ```LANGUAGE title=FILE      is written to FILE, whose folder must exist by then
  ```text title=expect        must stand in the output of the commands before it; `…` stands for
                              anything, on a line of its own for any lines
Everything else (such as ```console) is only shown. With --copy the fresh folder is a copy of the
folder of the page, as of an example. Processes that the page leaves running are ended.
"""
import argparse
import dataclasses
import fcntl
import os
import pathlib
import re
import select
import shutil
import signal
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


def run_commands(block, folder, environment, groups):
    # A session of its own: what the block starts in the background stays in its process group.
    shell = subprocess.Popen(["bash", "-e", "-c", block.text], cwd=folder, env=environment,
                             stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                             start_new_session=True)
    groups.append(shell.pid)
    try:
        output, _ = shell.communicate(timeout=TIMEOUT_S)
    except subprocess.TimeoutExpired:
        raise Failure(f"line {block.line}: no end after {TIMEOUT_S} s") from None
    if shell.returncode != 0:
        raise Failure(f"line {block.line}: exit code {shell.returncode}\n{output}")
    return output


def end_processes(groups):
    """A page that fails half-way leaves its runs and test programs behind."""
    for group in groups:
        try:
            os.killpg(group, signal.SIGTERM)
        except ProcessLookupError:
            pass


def write_file(block, folder):
    path = (folder / block.title).resolve()
    if folder.resolve() not in path.parents:
        raise Failure(f"line {block.line}: {block.title} lies outside the folder")
    if not path.parent.is_dir():
        raise Failure(f"line {block.line}: the folder of {block.title} does not exist yet")
    path.write_text(block.text, encoding="utf-8")


def run_page(page, folder, environment):
    """Runs all blocks; the numbers of command, file and expectation blocks."""
    groups = []
    try:
        return run_blocks(page, folder, environment, groups)
    finally:
        end_processes(groups)


def run_blocks(page, folder, environment, groups):
    counts = {"commands": 0, "files": 0, "expectations": 0}
    output = None
    for block in blocks_of(page):
        if block.language == "sh":
            output = run_commands(block, folder, environment, groups)
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


def environment_for(rave, prefix, runtime, more):
    environment = dict(os.environ, RAVE_PREFIX=str(prefix.resolve()), LC_ALL="C.UTF-8")
    first = [str(folder.resolve()) for folder in (rave.parent, *more)]
    environment["PATH"] = os.pathsep.join([*first, environment.get("PATH", "")])
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


def leaves_processes():
    """1 if a process in the background outlives its page: then it holds the FIFO, which stays open."""
    with tempfile.TemporaryDirectory() as folder:
        fifo = pathlib.Path(folder, "fifo")
        os.mkfifo(fifo)
        reader = os.open(fifo, os.O_RDONLY | os.O_NONBLOCK)
        run_page("```sh\nexec > fifo 2>&1\nsleep 60 &\n```\n", pathlib.Path(folder), dict(os.environ))
        readable, _, _ = select.select([reader], [], [], 10)
        os.close(reader)
    if not readable:
        print("self-test: a process outlived its page")
    return 0 if readable else 1


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
    wrong += leaves_processes()
    print(f"self-test: {len(SELF_TEST) + 1} pages, {wrong} judged wrongly")
    return 1 if wrong else 0


def wait_for_turn():
    """Holds the only turn on this machine until the process ends: other builds may run the page, too."""
    turn = open(pathlib.Path(tempfile.gettempdir(), f"rave-tutorial-{os.getuid()}.lock"), "w", encoding="utf-8")
    fcntl.flock(turn, fcntl.LOCK_EX)
    return turn


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("page", nargs="?", type=pathlib.Path)
    parser.add_argument("--rave", type=pathlib.Path)
    parser.add_argument("--prefix", type=pathlib.Path)
    parser.add_argument("--path", type=pathlib.Path, action="append", default=[],
                        help="folder with more programs that the page calls")
    parser.add_argument("--alone", action="store_true",
                        help="one such page at a time on this machine: it has a fixed port or name on the bus")
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
    turn = wait_for_turn() if arguments.alone else None
    if arguments.copy:
        shutil.copytree(arguments.page.parent, folder, dirs_exist_ok=True)
    try:
        counts = run_page(arguments.page.read_text(encoding="utf-8"), folder,
                          environment_for(arguments.rave, arguments.prefix, runtime, arguments.path))
    except Failure as failure:
        print(f"{arguments.page}: {failure}")
        return 1
    finally:
        if turn:
            turn.close()
        shutil.rmtree(runtime, ignore_errors=True)
        if arguments.keep:
            print(f"left {folder}")
        else:
            shutil.rmtree(folder, ignore_errors=True)
    print(f"{arguments.page}: ok,", ", ".join(f"{n} {what}" for what, n in counts.items()))
    return 0 if counts["commands"] and counts["expectations"] else 1


if __name__ == "__main__":
    sys.exit(main())
