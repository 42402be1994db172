# SPDX-License-Identifier: Apache-2.0
"""What the checks of the source share: the list of files, source without comments, and a self-test.

A check is a function from a Tree to a list of findings (`file:line: what is wrong`). With
--self-test it is run on small trees that each break one rule, and must find the breach in each.
"""
import argparse
import functools
import pathlib
import re
import subprocess
import sys
import tempfile

REPOSITORY = pathlib.Path(__file__).resolve().parent.parent.parent
SKIPPED_FOLDERS = {".git", "build", "runs", "install", "__pycache__", ".cache"}
SOURCE_ENDS = (".cpp", ".hpp", ".cpp.in", ".hpp.in")
# Folders inside a library, driver or program that are no part of what it ships.
SUPPORT_FOLDERS = {"tests", "testing", "bench", "fuzz", "tools"}
TOKENS = re.compile(r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|'
                    r"(?<![0-9A-Fa-f])'(?:\\.|[^'\\\n])+'", re.DOTALL)


class Tree:
    """The files of a clone, as paths relative to its root."""

    def __init__(self, root):
        self.root = pathlib.Path(root)

    @functools.cached_property
    def files(self):
        if (self.root / ".git").exists():
            listed = subprocess.run(
                ["git", "-c", "safe.directory=*", "ls-files", "-co", "--exclude-standard", "-z"],
                cwd=self.root, capture_output=True, text=True, check=False)
            if listed.returncode == 0:
                return sorted(f for f in listed.stdout.split("\0")
                              if f and (self.root / f).is_file())
        found = (p.relative_to(self.root) for p in self.root.rglob("*") if p.is_file())
        return sorted(p.as_posix() for p in found if not SKIPPED_FOLDERS & set(p.parts))

    def read(self, name):
        return (self.root / name).read_text(encoding="utf-8", errors="replace")

    @functools.cached_property
    def sources(self):
        """C++ files that are compiled as they are: templates of projects are not."""
        return [f for f in self.files if f.endswith(SOURCE_ENDS) and not is_template(f)]

    @functools.cached_property
    def cmake_files(self):
        return [f for f in self.files if f.endswith(("CMakeLists.txt", ".cmake"))]


def is_template(name):
    return name.startswith("share/templates/")


def is_support(name):
    """Whether a file is a test, benchmark or fuzz target rather than a part of what is shipped."""
    folders = name.split("/")[:-1]
    # A folder in bench/ is a library, which `rave bench` links.
    return bool(SUPPORT_FOLDERS & set(folders[1:] if folders[0:1] == ["bench"] and folders[1:]
                                      else folders))


def code_of(text):
    """C++ text without comments and literals; every line keeps its number."""
    def blank(match):
        token = match.group(0)
        kept = '""' if token[0] in '"R' else "0" if token[0] == "'" else " "
        return kept + "\n" * token.count("\n")
    return TOKENS.sub(blank, text)


def numbered(text):
    return enumerate(text.splitlines(), start=1)


def self_test(check, clean, breaches):
    """The number of examples that the check judges wrongly. An example is {file: text}."""
    wrong = 0
    for expected, files in [(None, clean), *breaches]:
        with tempfile.TemporaryDirectory() as folder:
            for name, text in files.items():
                path = pathlib.Path(folder, name)
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text, encoding="utf-8")
            findings = check(Tree(folder))
        right = not findings if expected is None else any(expected in f for f in findings)
        if not right:
            wrong += 1
            print(f"self-test: expected {expected or 'no finding'} in {list(files)}, "
                  f"found {findings}")
    print(f"self-test: {len(breaches)} breaches, {wrong} judged wrongly")
    return wrong


def main(check, clean, breaches):
    parser = argparse.ArgumentParser()
    parser.add_argument("--self-test", action="store_true")
    parser.add_argument("--root", default=str(REPOSITORY))
    arguments = parser.parse_args()
    if arguments.self_test:
        sys.exit(1 if self_test(check, clean, breaches) else 0)
    tree = Tree(arguments.root)
    findings = check(tree)
    for finding in findings:
        print(finding)
    print(f"{len(findings)} findings")
    sys.exit(1 if findings or not tree.files else 0)
