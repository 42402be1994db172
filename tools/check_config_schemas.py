#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks that the committed JSON Schemas are those of the code and tell good files from bad ones.

Usage: check_config_schemas.py RAVE_SCHEMAS SOURCE_DIR
Needs python3-jsonschema and python3-yaml.
"""
import json
import pathlib
import subprocess
import sys
import tempfile

import jsonschema
import yaml

KINDS = ("robot", "world", "scenario", "experiment")


def compare(tool, committed):
    """The schemas that differ from what the tool writes."""
    with tempfile.TemporaryDirectory() as fresh:
        subprocess.run([tool, fresh], check=True)
        for kind in KINDS:
            name = f"{kind}.schema.json"
            path = committed / name
            if not path.exists() or path.read_text() != (pathlib.Path(fresh) / name).read_text():
                yield f"{path}: out of date; run `rave-schemas schemas/config`"


def first_error(schema, path):
    """The message of what the schema holds against the file, or nothing."""
    value = yaml.safe_load(path.read_text())
    found = sorted(jsonschema.Draft7Validator(schema).iter_errors(value), key=str)
    return found[0].message if found else None


def is_map(path):
    """Whether it describes a map image of ROS map_server, which has a format of its own."""
    return path.with_suffix(".pgm").exists() or path.with_suffix(".png").exists()


def good_files(source):
    """(kind, path) of every shipped robot, world, scenario and experiment file."""
    for base in (source, source / "libs/config/tests/data"):
        for kind in KINDS:
            for path in sorted((base / f"{kind}s").glob("**/*.yaml" if kind == "experiment" else "*.yaml")):
                if not is_map(path):
                    yield kind, path
            if base == source:
                for path in sorted((base / "scenarios").glob(f"{kind}s/*.yaml")):
                    yield kind, path


def main():
    tool, source = sys.argv[1], pathlib.Path(sys.argv[2])
    committed = source / "schemas/config"
    problems = list(compare(tool, committed))
    schemas = {k: json.loads((committed / f"{k}.schema.json").read_text()) for k in KINDS}
    for schema in schemas.values():
        jsonschema.Draft7Validator.check_schema(schema)
    good = list(good_files(source))
    for kind, path in good:
        if error := first_error(schemas[kind], path):
            problems.append(f"{path}: refused by the {kind} schema: {error}")
    bad = sorted((source / "libs/config/tests/data/bad").glob("*.yaml"))
    for path in bad:
        if not first_error(schemas[path.name.split("-")[0]], path):
            problems.append(f"{path}: the schema accepts it")
    if len(good) < 5 or len(bad) < 5:
        problems.append(f"found only {len(good)} good and {len(bad)} bad files")
    print("\n".join(problems) or f"{len(good)} good and {len(bad)} bad files, as expected")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
