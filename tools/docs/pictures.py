#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes the pictures in docs/images, and checks that pages and program agree.

    tools/docs/pictures.py --rave PROGRAM [--check]

A picture of a run is its `picture.png`. docs/images/pictures.json has the run hash of each. The run
of corridor.png (`scenarios/demo corridor`) is live and has none, so it is made by hand. Pictures of
the page are taken by web/e2e/pictures.mjs, with the page beside the program.
With --check nothing is written: the runs are made again without pictures, their hashes are compared
with those of the file, and the figures in the pages with those of the runs. The figures of hybrid-laser are compared by the tests that compute them
(tests/scenarios).
The test page_pictures takes the pictures of the page again and compares them.
"""
import argparse
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
IMAGES = ROOT / "docs/images"
BOOK = IMAGES / "pictures.json"
SCENARIOS = {
    "collaborative-mapping": "scenarios/collaborative-mapping",
    "convoy": "scenarios/convoy",
    "flock": "scenarios/flock",
    "hunt": "scenarios/predator-prey/hunt.yaml",
    "hybrid-laser": "scenarios/hybrid-laser",
    "lab-team": "scenarios/lab-team",
    "mixed-reality": "scenarios/mixed-reality",
    "predator-prey": "scenarios/predator-prey",
    "rear-sonar": "scenarios/rear-sonar",
    "warehouse": "scenarios/warehouse",
}
# Long runs of which the begin says enough.
LENGTH_S = {"warehouse": 30}
# A figure in a page, and the same in the summary of a run.
FIGURES = [
    ("README.md", r"each of the (\d+) real sightings", "mixed-reality", r"of (\d+) real sightings"),
    ("README.md", r"(\d+\.\d+) % agree", "mixed-reality", r"holds: (\d+\.\d+) % of"),
    ("scenarios/rear-sonar/README.md", r"\| without \| (\d+) \|", "rear-sonar",
     r"touches of without\W+holds: (\d+),"),
    ("scenarios/rear-sonar/README.md", r"\| with the rear sonar \| (\d+) \|", "rear-sonar",
     r"touches of with\W+holds: (\d+),"),
]


def run(rave, name, folder, with_picture):
    """The hash and the summary of a run; its files are left in the folder."""
    options = [] if with_picture else ["--no-picture"]
    if name in LENGTH_S:
        options += ["--duration", str(LENGTH_S[name])]
    done = subprocess.run([rave, "run", str(ROOT / SCENARIOS[name]), "--pace", "max", "--no-record",
                           "--output", str(folder), *options], cwd=ROOT, capture_output=True,
                          text=True, timeout=600, check=False)
    if done.returncode != 0:
        raise RuntimeError(f"{name}: exit code {done.returncode}\n{done.stdout}{done.stderr}")
    result = json.loads((folder / "result.json").read_text(encoding="utf-8"))
    return result["hash"], (folder / "summary.txt").read_text(encoding="utf-8")


def renew_page(rave, scratch):
    """Takes the pictures of the page again."""
    page = pathlib.Path(rave).parent.parent / "share/rave/web"
    subprocess.run(["node", str(ROOT / "web/e2e/pictures.mjs"), rave, str(page), str(IMAGES),
                    str(pathlib.Path(scratch, "page")), "--renew"], timeout=600, check=True)


def check_figures(summaries):
    for page, pattern, name, source in FIGURES:
        said = re.search(pattern, re.sub(r"\s+", " ", (ROOT / page).read_text(encoding="utf-8")))
        # The table of a summary breaks long cells.
        known = re.search(source, re.sub(r"[\s│]+", " ", summaries[name]))
        if said is None or known is None:
            yield f"{page}: no figure like `{pattern}`, or none like `{source}` in the summary"
        elif said.group(1) != known.group(1):
            yield f"{page}: says {said.group(1)}, the run of {name} {known.group(1)}"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--rave", required=True)
    parser.add_argument("--check", action="store_true")
    arguments = parser.parse_args()
    book = json.loads(BOOK.read_text(encoding="utf-8")) if BOOK.exists() else {}
    rave = str(pathlib.Path(arguments.rave).resolve())
    findings, made, summaries = [], {}, {}
    with tempfile.TemporaryDirectory(prefix="rave-pictures-") as scratch:
        for name in SCENARIOS:
            folder = pathlib.Path(scratch, name)
            made[name], summaries[name] = run(rave, name, folder, not arguments.check)
            if not arguments.check:
                shutil.copyfile(folder / "picture.png", IMAGES / f"{name}.png")
            elif made[name] != book.get(name):
                findings.append(f"docs/images/{name}.png: made by a run with the hash "
                                f"{book.get(name)}, which is {made[name]} now; run "
                                "tools/docs/pictures.py and look at the pictures")
        if not arguments.check:
            renew_page(rave, scratch)
    findings += check_figures(summaries)
    if not arguments.check:
        BOOK.write_text(json.dumps(made, indent=2) + "\n", encoding="utf-8")
    print(*findings, f"{len(made)} runs, {len(findings)} findings", sep="\n")
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main())
