#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Capture time over the prey's speed, size and turning rate: one run of the scenario for each."""

import argparse
import csv
import json
import pathlib
import re
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
# One parameter at a time; the others stay as in robots/prey.yaml.
SWEEPS = {
    "program.max_speed_mps": [0.15, 0.25, 0.3, 0.35, 0.4, 0.5],
    "body.scale": [0.7, 1.0, 1.5, 2.0],
    "program.max_turn_rate_radps": [0.3, 0.6, 1.0, 2.0],
}


def scenario_text(key, value, speed_mps):
    """The scenario with one change at the start instead of its own."""
    text = (HERE / "scenario.yaml").read_text()
    settings = f"{key}: {value}"
    if key != "program.max_speed_mps":
        settings += f", program.max_speed_mps: {speed_mps}"
    changes = f"changes:\n  - {{at_s: 0, robot: prey, set: {{{settings}}}}}\n"
    text, count = re.subn(r"changes:\n(  - .*\n)+", changes, text)
    if count != 1:
        sys.exit("scenario.yaml has no `changes:` to replace")
    return text.replace("../../", str(HERE.parent.parent) + "/").replace("before_s: 120, ", "")


def capture_time(rave, text, seed, folder):
    """Seconds, or None if nobody was captured."""
    file = folder / "scenario.yaml"
    file.write_text(text)
    output = folder / "results"
    command = [rave, "run", file, "--output", output, "--seed", str(seed), "--pace", "max",
               "--quiet", "--no-picture", "--no-record", "--replace"]
    ended = subprocess.run(command, check=False)
    if ended.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))} ended with {ended.returncode}")
    return json.loads((output / "result.json").read_text())["capture"]["captured_at_s"]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rave", default="rave", help="the command to run")
    parser.add_argument("--seeds", type=int, default=3, help="runs of each value")
    parser.add_argument("--speed", type=float, default=0.3,
                        help="speed of the prey while size and turning rate are swept, m/s")
    parser.add_argument("--csv", type=pathlib.Path, help="also write the times here")
    options = parser.parse_args()
    rows = []
    print(f"{'parameter':<30} {'value':>6}   captured at [s], by seed (- : not within 120 s)")
    with tempfile.TemporaryDirectory() as name:
        for key, values in SWEEPS.items():
            for value in values:
                text = scenario_text(key, value, options.speed)
                times = [capture_time(options.rave, text, seed, pathlib.Path(name))
                         for seed in range(1, options.seeds + 1)]
                rows += [(key, value, seed, time) for seed, time in enumerate(times, 1)]
                shown = "  ".join("-" if time is None else f"{time:.2f}" for time in times)
                print(f"{key:<30} {value:>6}   {shown}", flush=True)
    if options.csv:
        with options.csv.open("w", newline="") as file:
            writer = csv.writer(file)
            writer.writerow(["parameter", "value", "seed", "captured_at_s"])
            writer.writerows(rows)


if __name__ == "__main__":
    main()
