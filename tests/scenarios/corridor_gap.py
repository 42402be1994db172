#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compares the figures of `rave report gap` in scenarios/corridor/README.md with those of runs.

usage: corridor_gap.py RAVE SLIPPED FOLDER

SLIPPED is the folder of a run of `scenarios/demo corridor`; the run without slip is made in FOLDER.
The runs are live, so a figure may differ from that of the page by as much as the page says.
"""
import json
import os
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = ROOT / "scenarios/corridor/README.md"
# A row of the table, and what makes its run.
ROWS = {"slip by 1 % and 1.5 %": "slipped", "do not slip": "plain"}
AT_S = 10


def page_figures(page):
    """({row: heading in degrees}, by how much a run may differ)."""
    figures = {row: re.search(rf"^\| {re.escape(row)} \| (\d+\.\d)° \|$", page, re.MULTILINE) for row in ROWS}
    spread = re.search(r"within (\d+\.\d)° of these", " ".join(page.split()))
    missing = [row for row, figure in figures.items() if figure is None] + ([] if spread else ["the spread"])
    if missing:
        sys.exit(f"{PAGE}: no figure for {', '.join(missing)}")
    return {row: float(figure.group(1)) for row, figure in figures.items()}, float(spread.group(1))


def run_without_slip(folder):
    # Too short to arrive, so the exit code says that a check failed; a run that broke off has no
    # pose after AT_S.
    subprocess.run([ROOT / "scenarios/demo", "corridor", "--peer", "", "--duration", str(AT_S + 2), "--quiet",
                    "--replace", "--no-picture", "--output", folder], stdout=subprocess.DEVNULL, check=False,
                   timeout=200)


def heading_deg(rave, run, output):
    """Difference of heading between robot and twin after AT_S."""
    done = subprocess.run([rave, "report", "gap", run, "--robot", "create", "--twin",
                           ROOT / "robots/create-simulated.yaml", "--output", output, "--json"],
                          capture_output=True, text=True, check=False, timeout=200)
    if done.returncode != 0:
        sys.exit(done.stderr)
    return next(place["deg"] for place in json.loads(done.stdout)["after"] if place["after_s"] == AT_S)


def main():
    rave, slipped, folder = sys.argv[1:]
    plain = pathlib.Path(folder, "plain")
    output = pathlib.Path(folder, "report")
    os.makedirs(output, exist_ok=True)
    run_without_slip(plain)
    runs = {"slipped": slipped, "plain": plain}
    figures, spread = page_figures(PAGE.read_text(encoding="utf-8"))
    wrong = 0
    for row, run in ROWS.items():
        found = heading_deg(rave, runs[run], output)
        agrees = abs(found - figures[row]) <= spread
        wrong += not agrees
        print(f"{row}: the page says {figures[row]}°, the run {found:.2f}°{'' if agrees else ', too far apart'}")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
