#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks messages between page and server against schemas/gui/messages.schema.json.

usage: check_messages.py MESSAGES.json
"""
import json
import pathlib
import sys

import jsonschema

SCHEMA = pathlib.Path(__file__).resolve().parents[2] / "schemas/gui/messages.schema.json"


def main():
    schema = json.loads(SCHEMA.read_text())
    by_type = {}
    for name, node in schema["definitions"].items():
        constant = node.get("properties", {}).get("type", {}).get("const")
        if constant:
            by_type[constant] = jsonschema.Draft7Validator(
                {"$ref": f"#/definitions/{name}", "definitions": schema["definitions"]})
    for message in json.loads(pathlib.Path(sys.argv[1]).read_text()):
        validator = by_type.get(message.get("type"))
        if validator is None:
            sys.exit(f"unknown type of message: {message.get('type')}")
        for error in validator.iter_errors(message):
            sys.exit(f"{message['type']}: {'/'.join(map(str, error.path))}: {error.message[:200]}")


if __name__ == "__main__":
    main()
