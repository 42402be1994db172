#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Measures what it costs to share a world among processes in lock-step.

    bench/lock_step.py [--rave build/release/bin/rave] [--processes 3] [--rounds 3]

Runs the same scenario in one process and in several, in turn, and prints one JSON line per
workload: medians of the steps per second of both, and their ratio. No record is written.
"""
import argparse
import json
import pathlib
import statistics
import subprocess
import tempfile

# Robots, steps: some seconds each.
WORKLOADS = [(30, 20_000), (1000, 3000), (10_000, 300)]


def steps_per_s(rave, scenario, processes, folder):
    subprocess.run([rave, "run", scenario, "--processes", str(processes), "--no-record",
                    "--no-picture", "--quiet", "--pace", "max", "--output", folder], check=True)
    result = json.loads(pathlib.Path(folder, "result.json").read_text())
    return result["steps"] / result["wall_s"], result["hash"]


def measure(rave, robots, steps, processes, rounds):
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        subprocess.run([rave, "bench", "swarm", "--robots", str(robots), "--steps", str(steps),
                        "--write", folder / "swarm"], check=True, stdout=subprocess.DEVNULL)
        speeds = {1: [], processes: []}
        hashes = set()
        for number in range(rounds):
            for count, measured in speeds.items():
                speed, run_hash = steps_per_s(rave, folder / "swarm", count,
                                              folder / f"{count}-{number}")
                measured.append(speed)
                hashes.add(run_hash)
        alone = statistics.median(speeds[1])
        shared = statistics.median(speeds[processes])
        return {"robots": robots, "processes": processes, "steps": steps,
                "alone_steps_per_s": round(alone, 1), "shared_steps_per_s": round(shared, 1),
                "ratio": round(shared / alone, 3), "same_hash": len(hashes) == 1}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rave", default="build/release/bin/rave")
    parser.add_argument("--processes", type=int, default=3)
    parser.add_argument("--rounds", type=int, default=3)
    options = parser.parse_args()
    for robots, steps in WORKLOADS:
        print(json.dumps(measure(options.rave, robots, steps, options.processes, options.rounds)),
              flush=True)


if __name__ == "__main__":
    main()
