#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes docs/reference/files.md: the keys of robot, world, scenario and experiment files.

    tools/docs/files_reference.py [--check]

The source are the JSON Schemas in schemas/config, which `rave schema` prints and a test compares
with the code. With --check nothing is written; the exit code says whether the page is up to date.
"""
import difflib
import json
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
PAGE = ROOT / "docs/reference/files.md"
KINDS = ("robot", "world", "scenario", "experiment")
INTRODUCTION = """\
# Keys of robot, world, scenario and experiment files

Made by `tools/docs/files_reference.py` from the [schemas](../../schemas/config); edit the
descriptions in the code instead. The keys under `params` of a driver are in
[drivers.md](drivers.md).

All files are YAML, read strictly: an unknown key, a wrong type or a value out of range is an error
with file, line, column and the nearest right name. A key ends in its unit: `_m`, `_s`,
`_mps`, `_radps`, `_kg`, `_deg`. Degrees exist in files only
([frames and units](../frames-and-units.md)). A file name is relative to the file that contains it.
`$(name)` in a robot file is the value of a variable. `rave check --expand FILE` writes a file with all
defaults.
"""
WHAT = {
    "robot": "The parts of a robot, their drivers, and its program.",
    "world": "The static bodies.",
    "scenario": "Which robots run where, for how long, and which checks must hold.",
    "experiment": "What `rave sweep` varies, how often it runs, and what it measures.",
}
UNITS = re.compile(r"^\[([^\]]+)\]\s*")


def without_null(schema):
    """The schema of a key that may be unset, and whether it may be."""
    choices = schema.get("anyOf", [])
    real = [choice for choice in choices if choice.get("type") != "null"]
    # A word beside a number, such as `none`, is told of in the text.
    real = [choice for choice in real if "const" not in choice]
    if len(real) == len(choices):
        return schema, False
    can_be_unset = any(choice.get("type") == "null" for choice in choices)
    return {key: value for key, value in schema.items() if key != "anyOf"} | real[0], can_be_unset


def kind_of(schema):
    if "enum" in schema:
        return "choice"
    kind = schema.get("type")
    if isinstance(kind, list):
        kind = kind[0]
    return {"object": "mapping", "string": "text", "boolean": "true or false", None: "any",
            "array": "list"}.get(kind, kind)


def type_text(schema):
    """Such as `list of 2 numbers`."""
    kind = kind_of(schema)
    if kind != "list":
        return kind
    item = schema["items"]
    item = item["anyOf"][0] if "anyOf" in item else item
    low, high = schema.get("minItems", 0), schema.get("maxItems")
    if kind_of(item) == "list":
        return f"list of [{', '.join([kind_of(item['items'])] * item['minItems'])}]"
    count = f"{low} " if low == high else ""
    plural = {"choice": "choices", "any": "values", "text": "texts", "mapping": "mappings"}
    return f"list of {count}{plural.get(kind_of(item), kind_of(item) + 's')}"


def number_text(value):
    return f"{value:g}" if isinstance(value, float) else str(value)


def range_text(schema):
    while kind_of(schema) == "list":
        schema = schema["items"]
        schema = schema["anyOf"][0] if "anyOf" in schema else schema
    if "enum" in schema:
        return ", ".join(f"`{value}`" for value in schema["enum"])
    if "exclusiveMinimum" in schema:
        low = f"above {number_text(schema['exclusiveMinimum'])}"
    elif "minimum" in schema:
        low = f"from {number_text(schema['minimum'])}"
    else:
        low = ""
    high = f"to {number_text(schema['maximum'])}" if "maximum" in schema else ""
    return f"{low} {high}".strip()


def default_text(name, schema, optional, required):
    if name in required:
        return "required"
    if optional or schema.get("default") is None:
        return "unset"
    if kind_of(schema) == "mapping":
        return ""
    return f"`{json.dumps(schema['default'])}`"


def meaning_of(schema):
    text = schema.get("description", "")
    unit = UNITS.match(text)
    if unit:
        text = text[unit.end():] or "In " + {"m": "metres", "deg": "degrees"}[unit.group(1)] + "."
    return text.replace("|", "\\|")


class Page:
    def __init__(self):
        self.lines = [INTRODUCTION]
        self.sections = {}  # the keys of a mapping, as text -> the heading that shows them

    def mapping(self, heading, level, schema, path):
        """A table of the keys, then those of the mappings inside."""
        self.lines += [f"{'#' * level} {heading}", ""]
        if schema.get("description") and level > 2:
            self.lines += [meaning_of(schema), ""]
        self.lines += ["| key | type | range | default | meaning |", "|---|---|---|---|---|"]
        inner = []
        for name, key in schema["properties"].items():
            key, optional = without_null(key)
            meaning = meaning_of(key)
            child = key["items"] if kind_of(key) == "list" else key
            if "properties" in child:
                child_path = f"{path}{name}" + ("[]" if kind_of(key) == "list" else "")
                identity = json.dumps(child["properties"], sort_keys=True)
                if identity not in self.sections:
                    self.sections[identity] = child_path
                    inner.append((child_path, child))
                meaning += f" Keys: [{self.sections[identity]}]({self.anchor(identity)})."
            default = default_text(name, key, optional, schema.get("required", []))
            self.lines.append(f"| `{name}` | {type_text(key)} | {range_text(key)} | {default} "
                              f"| {meaning.strip()} |")
        self.lines.append("")
        for child_path, child in inner:
            self.mapping(child_path, 3, {"properties": child["properties"],
                                         "required": child.get("required", [])}, child_path + ".")

    def anchor(self, identity):
        heading = self.sections[identity].lower().replace(" ", "-")
        return "#" + re.sub(r"[^\w-]", "", heading)


def page():
    result = Page()
    for kind in KINDS:
        schema = json.loads((ROOT / f"schemas/config/{kind}.schema.json").read_text())
        heading = f"{kind.capitalize()} file"
        result.sections[json.dumps(schema["properties"], sort_keys=True)] = heading
        result.lines += [f"## {heading}", "", WHAT[kind], ""]
        length = len(result.lines)
        result.mapping(heading, 2, schema, f"{kind}.")
        del result.lines[length:length + 2]  # the heading stands already
    return "\n".join(result.lines).rstrip() + "\n"


def main():
    text = page()
    if "--check" not in sys.argv:
        PAGE.write_text(text, encoding="utf-8")
        return 0
    there = PAGE.read_text(encoding="utf-8") if PAGE.exists() else ""
    if there == text:
        return 0
    print("".join(difflib.unified_diff(there.splitlines(True), text.splitlines(True),
                                       str(PAGE.relative_to(ROOT)), "what the schemas say")))
    print("docs/reference/files.md is not up to date; run tools/docs/files_reference.py")
    return 1


if __name__ == "__main__":
    sys.exit(main())
