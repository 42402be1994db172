#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Installs RAVE to a temporary folder and builds against it what users build.

    tests/install/examples_build.py --build BUILD --make-project PROGRAM [--keep]

Each project sees a prefix with the components that its CMakeLists.txt asks for and no more. Built
and tested: both templates of `rave new` and every folder of examples/. The plug-ins of projects that
ask for robot alone are then searched for the simulator: their symbols, their libraries, their headers.
"""
import argparse
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

SOURCE = pathlib.Path(__file__).resolve().parent.parent.parent
ALLOWED_LIBRARIES = re.compile(
    r"^(?:libc\.so|libm\.so|libstdc\+\+\.so|libgcc_s\.so|libfmt\.so|ld-linux)")
SIMULATOR = re.compile(r"rave::(?:sim|world)\b|rave::(?:WorldView|VirtualSensor|Engine|Snapshot)\b")
SIMULATOR_HEADERS = re.compile(r"rave/(?:sim|world)/")


# What a project that asks for a component finds installed.
PREFIXES = {"robot": ["robot"], "driver": ["robot", "driver"],
            "run": ["robot", "driver", "config", "run"]}


class Failure(Exception):
    """A sentence that says what is wrong."""


def run(*command):
    done = subprocess.run([str(c) for c in command], stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, check=False)
    if done.returncode != 0:
        raise Failure(f"{' '.join(map(str, command))}\n{done.stdout}")
    return done.stdout


def install(build, prefix, components):
    for component in components:
        run("cmake", "--install", build, "--prefix", prefix, "--component", component)


def build_project(folder, prefix, out, has_test):
    """Configures, builds and tests a project; those of `rave new` must bring a test."""
    launcher = ["-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"] if shutil.which("ccache") else []
    run("cmake", "-S", folder, "-B", out, "-G", "Ninja", f"-DCMAKE_PREFIX_PATH={prefix}",
        "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_CXX_FLAGS=-Wall -Wextra -Werror", *launcher)
    run("cmake", "--build", out, "-j", len(os.sched_getaffinity(0)))
    if has_test:
        run("ctest", "--test-dir", out, "--output-on-failure", "--no-tests=error")


def check_program(library, out):
    """Nothing of the simulator in, under or beside a program."""
    needed = re.findall(r"\(NEEDED\)\s+.*\[(.+?)\]", run("readelf", "-d", library))
    strange = [name for name in needed if not ALLOWED_LIBRARIES.match(name)]
    if strange:
        raise Failure(f"{library.name} needs {', '.join(strange)}")
    if not needed:
        raise Failure(f"readelf lists no library that {library.name} needs")
    symbols = run("nm", "--demangle", library) + run("nm", "--demangle", "--dynamic", library)
    if "rave_register_plugin" not in symbols:
        raise Failure(f"{library.name} does not export its entry point")
    found = SIMULATOR.search(symbols)
    if found:
        raise Failure(f"{library.name} holds a symbol of the simulator: {found.group(0)}")
    deps = run("ninja", "-C", out, "-t", "deps")
    if "rave/robot/program.hpp" not in deps:
        raise Failure(f"the list of headers of {library.name} is incomplete")
    if SIMULATOR_HEADERS.search(deps):
        raise Failure(f"{library.name} was compiled with headers of the simulator")


def component_of(folder):
    """The last one that a project asks for, which stands on those before it."""
    text = (folder / "CMakeLists.txt").read_text()
    asked = re.search(r"find_package\(rave REQUIRED COMPONENTS [\w ]*?(\w+)\)", text)
    if not asked or asked.group(1) not in PREFIXES:
        raise Failure(f"{folder.name} asks for none of {', '.join(PREFIXES)}")
    return asked.group(1)


def built_in(out, component):
    """The plug-ins of a project; of one that makes runs, its programs."""
    if component != "run":
        return sorted(out.glob("*.so"))
    return sorted(f for f in out.iterdir() if f.is_file() and os.access(f, os.X_OK))


def check_all(arguments, scratch):
    build, templates = pathlib.Path(arguments.build), SOURCE / "share/templates"
    for prefix, parts in PREFIXES.items():
        install(build, scratch / prefix, [f"{part}-dev" for part in parts])
    for unwanted in ("sim", "world", "line", "config", "assemble"):
        if (scratch / "robot/include/rave" / unwanted).exists():
            raise Failure(f"the component robot-dev installs headers of {unwanted}")
    projects = [scratch / "first_program", scratch / "first_driver"]
    for kind, folder in zip(("program", "driver"), projects):
        run(arguments.make_project, kind, folder.name, templates, folder)
    # What the examples do is tested by the pages that explain them (tests/docs).
    examples = sorted(f.parent for f in (SOURCE / "examples").glob("*/CMakeLists.txt"))
    for folder in projects + examples:
        out, component = scratch / "build" / folder.name, component_of(folder)
        build_project(folder, scratch / component, out, folder in projects)
        built = built_in(out, component)
        if not built:
            raise Failure(f"{folder.name} builds nothing")
        for library in built if component == "robot" else []:
            check_program(library, out)
        print(f"{folder.name}: ok, {', '.join(library.name for library in built)}")
    check_that_the_check_can_fail(scratch)


def check_that_the_check_can_fail(scratch):
    """The driver's binary is full of the simulator: searching it must find that."""
    out = scratch / "build/first_driver"
    try:
        check_program(out / "first_driver.so", out)
    except Failure as failure:
        print(f"self-test: {failure}")
        return
    raise Failure("a driver passed for a program that knows nothing of the simulator")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--build", required=True)
    parser.add_argument("--make-project", required=True)
    parser.add_argument("--keep", action="store_true")
    arguments = parser.parse_args()
    scratch = pathlib.Path(tempfile.mkdtemp(prefix="rave-examples-"))
    try:
        check_all(arguments, scratch)
    except Failure as failure:
        print(failure)
        return 1
    finally:
        if not arguments.keep:
            shutil.rmtree(scratch, ignore_errors=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
