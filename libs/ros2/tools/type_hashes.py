#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes libs/ros2/src/type_hashes.inc: the type hashes of ROS 2 for the messages of schemas/idl/ros2.

    libs/ros2/tools/type_hashes.py           # after a change of the messages
    libs/ros2/tools/type_hashes.py --check   # fails if the file is not what this would write

A hash is the SHA-256 of a description of the type as JSON (REP-2016, "RIHS01").
"""
import hashlib
import json
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[3]
IDL = ROOT / "schemas/idl/ros2"
OUT = ROOT / "libs/ros2/src/type_hashes.inc"
# What type_description_interfaces/msg/FieldType calls the types of IDL.
NUMBERS = {"int8": 2, "octet": 3, "short": 4, "unsigned short": 5, "long": 6, "unsigned long": 7,
           "float": 10, "double": 11, "boolean": 15, "string": 17}
NESTED, BOUNDED_STRING, ARRAY, SEQUENCE = 1, 21, 48, 144
# Computed by others from the interfaces of ROS 2 itself.
KNOWN = {
    "std_msgs/msg/String": "df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18",
    "geometry_msgs/msg/Twist": "9c45bf16fe0983d80e3cfe750d6835843d265a9a6c46bd2e609fcddde6fb8d2a",
    "rosgraph_msgs/msg/Clock": "692f7a66e93a3c83e71765d033b60349ba68023a8c689a79e48078bcb5c58564",
    "sensor_msgs/msg/Range": "b42b62562e93cbfe9d42b82fe5994dfa3d63d7d5c90a317981703f7388adff3a",
    "rmw_dds_common/msg/ParticipantEntitiesInfo":
        "91a0593bacdcc50ea9bdcf849a938b128412cc1ea821245c663bcd26f83c295e",
}


def fields_of(package, body):
    for line in body.split(";"):
        words = " ".join(line.split())
        if not words:
            continue
        kind, names = re.match(r"((?:unsigned )?[\w:<>]+) (.*)$", words).groups()
        for name in names.split(","):
            yield field(package, kind, name.strip())


def field(package, kind, name):
    offset, capacity, text, nested = 0, 0, 0, ""
    if array := re.match(r"(\w+)\[(\d+)\]$", name):
        name, capacity, offset = array[1], int(array[2]), ARRAY
    if sequence := re.match(r"sequence<(.*)>$", kind):
        kind, offset = sequence[1], SEQUENCE
    if bounded := re.match(r"string<(\d+)>$", kind):
        number, text = BOUNDED_STRING, int(bounded[1])
    elif kind in NUMBERS:
        number = NUMBERS[kind]
    else:
        number = NESTED
        nested = kind.replace("::dds_::", "/").replace("::", "/").removesuffix("_")
        nested = nested if "/" in nested else f"{package}/msg/{nested}"
    return {"name": name, "type": {"type_id": number + offset, "capacity": capacity,
                                   "string_capacity": text, "nested_type_name": nested}}


def read_types():
    types, topics = {}, set()
    for path in sorted(IDL.glob("*.idl")):
        text = re.sub(r"//.*", "", path.read_text())
        for mark, name, body in re.findall(r"(@topic|@nested) @final struct (\w+)_ \{(.*?)\};", text,
                                           re.S):
            full = f"{path.stem}/msg/{name}"
            types[full] = list(fields_of(path.stem, body))
            if mark == "@topic" and "Before" not in name:
                topics.add(full)
    return types, topics


def below(types, name, found):
    for each in types[name]:
        nested = each["type"]["nested_type_name"]
        if nested and nested not in found:
            found.add(nested)
            below(types, nested, found)
    return found


def hash_of(types, name):
    def described(each):
        return {"type_name": each, "fields": types[each]}
    whole = {"type_description": described(name),
             "referenced_type_descriptions": [described(each)
                                              for each in sorted(below(types, name, set()))]}
    return hashlib.sha256(json.dumps(whole, separators=(", ", ": ")).encode()).hexdigest()


def main():
    types, topics = read_types()
    hashes = {name: hash_of(types, name) for name in sorted(topics)}
    for name, known in KNOWN.items():
        if hashes.get(name) != known:
            sys.exit(f"{name}: {hashes.get(name)} instead of {known}")
    lines = ["// SPDX-License-Identifier: Apache-2.0", "// Written by libs/ros2/tools/type_hashes.py."]
    for name, value in hashes.items():
        package, _, kind = name.split("/")
        lines += [f'{{"{package}::msg::dds_::{kind}_",', f' "RIHS01_{value}"}},']
    text = "\n".join(lines) + "\n"
    if "--check" not in sys.argv:
        OUT.write_text(text)
    elif OUT.read_text() != text:
        sys.exit(f"{OUT.relative_to(ROOT)} is old: run libs/ros2/tools/type_hashes.py")


main()
