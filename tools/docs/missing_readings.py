#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Whether docs/reference/missing-readings.md says of each driver that reads something what it makes
of what it could not read.

    tools/docs/missing_readings.py [--self-test]

The drivers are those of docs/reference/drivers.md, which is generated from their descriptions.
"""
import fnmatch
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
DRIVERS = "docs/reference/drivers.md"
PAGE = "docs/reference/missing-readings.md"
KINDS = {"sensor", "virtual sensor", "hybrid sensor", "transmitter"}


def drivers_of(text):
    """The names of those that read something."""
    kind, names = None, []
    for line in text.splitlines():
        if heading := re.match(r"# Kind: (.+)", line):
            kind = heading.group(1)
        elif (name := re.match(r"### `([a-z0-9_]+)`", line)) and kind in KINDS:
            names.append(name.group(1))
    return names


def missing(drivers, page):
    rows = [line for line in page.splitlines() if line.startswith("|")]
    known = {name for row in rows for name in re.findall(r"`([a-z0-9_*]+)`", row.split("|")[1])}
    return [f"{PAGE} has no row of the driver `{name}`" for name in drivers
            if not any(fnmatch.fnmatchcase(name, one) for one in known)]


def self_test():
    drivers = drivers_of("# Kind: sensor\n### `a_b`\n### `a_c`\n### `d`\n# Kind: program\n### `e`\n")
    page = "`d` is no row\n| `a_*` | `d` | no sample |\n"
    right = drivers == ["a_b", "a_c", "d"] and missing(drivers, page) == [
        f"{PAGE} has no row of the driver `d`"]
    print(f"self-test: {'right' if right else 'wrong'}")
    return 0 if right else 1


def main():
    if "--self-test" in sys.argv:
        return self_test()
    drivers = drivers_of((ROOT / DRIVERS).read_text(encoding="utf-8"))
    findings = missing(drivers, (ROOT / PAGE).read_text(encoding="utf-8"))
    if not drivers:
        findings.append(f"{DRIVERS} names no drivers; its layout has changed")
    print(*findings, f"{len(drivers)} drivers, {len(findings)} findings", sep="\n")
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main())
