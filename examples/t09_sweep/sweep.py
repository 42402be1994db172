#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Which field of view does a laser need? Several runs of each, and a table of contacts.

    python3 sweep.py [SEEDS]
"""
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
FIELDS_DEG = [20, 60, 120, 240]


def contacts(fov_deg, seed, folder):
    """Contacts of eight robots in two minutes."""
    text = (HERE / "scenario.yaml").read_text().replace("fov_deg: 120", f"fov_deg: {fov_deg}")
    # Relative names in a scenario start at its folder, so the copy names the robot file in full.
    scenario = folder / "scenario.yaml"
    scenario.write_text(text.replace("robot.yaml", str(HERE / "robot.yaml")))
    subprocess.run(["rave", "run", scenario, "--seed", str(seed), "--output", folder / "out", "--replace",
                    "--no-picture", "--no-record", "--quiet"], check=True)
    return json.loads((folder / "out/result.json").read_text())["events"]["contact"]


def main():
    seeds = int(sys.argv[1]) if len(sys.argv) > 1 else 3
    print("field of view  contacts by seed  mean")
    with tempfile.TemporaryDirectory() as name:
        for fov_deg in FIELDS_DEG:
            counts = [contacts(fov_deg, seed, pathlib.Path(name)) for seed in range(1, seeds + 1)]
            print(f"{fov_deg:>9} deg    {' '.join(f'{c:>4}' for c in counts)}  {statistics.mean(counts):6.1f}")


if __name__ == "__main__":
    main()
