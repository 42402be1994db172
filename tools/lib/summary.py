#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Sums up a run of ./test: each suite's tests and seconds, then `N passed, N failed`.

    tools/lib/summary.py FOLDER SECONDS

FOLDER holds, per preset, what ctest wrote (PRESET.json names the labels, PRESET.xml the results)
and notes.tsv (step, suite, passed or failed, seconds) for what is no ctest test. The exit code is
1 if anything failed or nothing ran.
"""
import collections
import json
import pathlib
import sys
import xml.etree.ElementTree as xml


def labels_of(listing):
    """The first label of every test of ctest's listing."""
    labels = {}
    for test in json.loads(listing.read_text()).get("tests", []):
        found = [p["value"] for p in test.get("properties", []) if p["name"] == "LABELS"]
        labels[test["name"]] = found[0][0] if found and found[0] else "other"
    return labels


def rows_of_preset(listing):
    """(preset, suite, outcome, seconds, name) of every test; one without a result has failed."""
    preset, labels, results = listing.stem, labels_of(listing), {}
    report = listing.with_suffix(".xml")
    if report.exists():
        for case in xml.parse(report).getroot().iter("testcase"):
            skipped = case.get("status") in ("disabled",) or (
                case.find("skipped") is not None and case.get("status") != "notrun")
            outcome = "passed" if case.get("status") == "run" else "failed"
            results[case.get("name")] = ("skipped" if skipped else outcome,
                                         float(case.get("time") or 0))
    return [(preset, label, *results.get(name, ("failed", 0.0)), name)
            for name, label in labels.items()]


def rows_of_notes(notes):
    rows = []
    for line in notes.read_text().splitlines() if notes.exists() else []:
        step, suite, outcome, seconds = line.split("\t")
        rows.append((step, suite, outcome, float(seconds), suite))
    return rows


def table(rows):
    """The lines of the table: one per step and suite."""
    groups = collections.OrderedDict()
    for step, suite, outcome, seconds, _ in rows:
        count = groups.setdefault((step, suite), collections.Counter())
        count[outcome] += 1
        count["seconds"] += seconds
    total = sum(count["seconds"] for count in groups.values()) or 1.0
    wide, wider = (max([len(title), *(len(group[i]) for group in groups)]) + 2
                   for i, title in enumerate(("step", "suite")))
    lines = [f"{'step':<{wide}}{'suite':<{wider}}{'passed':>8}{'failed':>8}{'skipped':>9}"
             f"{'seconds':>10}{'share':>8}"]
    for (step, suite), count in groups.items():
        lines.append(f"{step:<{wide}}{suite:<{wider}}{count['passed']:>8}{count['failed']:>8}"
                     f"{count['skipped']:>9}{count['seconds']:>10.1f}"
                     f"{100 * count['seconds'] / total:>7.1f}%")
    return lines


def main(arguments):
    folder, wall_s = pathlib.Path(arguments[0]), int(arguments[1])
    rows = rows_of_notes(folder / "notes.tsv")
    for listing in sorted(folder.glob("*.json")):
        rows += rows_of_preset(listing)
    rows.sort(key=lambda row: (row[0] != "release", row[0], row[1] != "build", row[1]))
    failed = [row for row in rows if row[2] == "failed"]
    passed = [row for row in rows if row[2] == "passed"]
    print()
    print("\n".join(table(rows)))
    print(f"In all {wall_s} s. Seconds are those of the tests; several run at once.")
    for row in failed:
        print(f"failed: {row[0]}: {row[4]}")
    if not rows:
        print("No test ran: is there a suite of that name?")
    print(f"{len(passed)} passed, {len(failed)} failed")
    return 1 if failed or not passed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
