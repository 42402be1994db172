#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Whether every public header compiles alone: it includes what it needs, in any order of includes.

    tools/lint/public_headers.py [--self-test] [--root DIR]

The compiler is that of the variable CXX, by default g++; behind ccache if it is there, so that
only what changed is compiled again. Headers of message types are made from schemas/idl, as in the
build tree.
"""
import concurrent.futures
import os
import pathlib
import shutil
import subprocess
import tempfile

import common

FLAGS = ["-std=c++20", "-O0", "-Wall", "-Wextra", "-Werror", "-c"]


def compile_alone(tree, folders, scratch, name):
    # As a source that includes it, or the compiler warns of `#pragma once` in a main file.
    include = name.split("/include/", 1)[1]
    source = pathlib.Path(scratch, include.replace("/", "-") + ".cpp")
    source.write_text(f'#include "{include}"\n', encoding="utf-8")
    cache = ["ccache"] if shutil.which("ccache") else []
    run = subprocess.run([*cache, os.environ.get("CXX", "g++"), *FLAGS, *folders, source.name,
                          "-o", source.name + ".o"],
                         cwd=scratch, capture_output=True, text=True, check=False)
    if run.returncode == 0:
        return []
    lines = [line for line in run.stderr.splitlines() if "error:" in line]
    return [f"{name}: does not compile alone: {lines[0] if lines else run.stderr[:500]}"]


def generate_types(tree, scratch):
    """Makes idl/FOLDER/NAME.h of schemas/idl/FOLDER/NAME.idl in the scratch folder."""
    for name in (f for f in tree.files if f.startswith("schemas/idl/") and f.endswith(".idl")):
        into = pathlib.Path(scratch, "idl", name.split("/")[2])
        into.mkdir(parents=True, exist_ok=True)
        subprocess.run(["idlc", "-x", "final", str(tree.root.resolve() / name)], cwd=into,
                       check=True, timeout=60)


def check(tree):
    # Helpers of tests are nobody's interface; they may need definitions of their target.
    headers = [f for f in tree.sources
               if f.endswith(".hpp") and "/include/" in f and "/testing/include/" not in f]
    folders = [f"-I{tree.root.resolve() / folder}"
               for folder in sorted({h.split("/include/")[0] + "/include" for h in headers})]
    with tempfile.TemporaryDirectory() as scratch, \
            concurrent.futures.ThreadPoolExecutor(len(os.sched_getaffinity(0))) as pool:
        generate_types(tree, scratch)
        # Types are made by others; their warnings are not ours.
        folders += ["-isystem", scratch]
        return [finding for found in
                pool.map(lambda name: compile_alone(tree, folders, scratch, name), headers)
                for finding in found]


GOOD = {"libs/a/include/rave/a/a.hpp": "#pragma once\nstruct A {};\n"}
CLEAN = GOOD | {"libs/b/include/rave/b/b.hpp":
                '#pragma once\n#include "rave/a/a.hpp"\nstruct B : A {};\n'}
BREACHES = [
    ("libs/b/include/rave/b/b.hpp: does not compile alone",
     GOOD | {"libs/b/include/rave/b/b.hpp": "#pragma once\nstruct B : A {};\n"}),
    ("does not compile alone",
     GOOD | {"libs/b/include/rave/b/b.hpp": "#pragma once\nstd::string name();\n"}),
]

if __name__ == "__main__":
    common.main(check, CLEAN, BREACHES)
