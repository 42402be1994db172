#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""How much of its speed a run loses to a page that watches it.

    bench/gui_watched.py [--build DIR] [--robots N] [--seconds S] [--rounds N] [--rate HZ] [--seed N] [--limit PCT]

Each round runs one scenario twice at full speed, in the opposite order to the round before: headless
(`rave run`), and watched (`rave run --gui`) by a client that looks at all poses and the readings of one
robot, asks for so many frames a second, and acknowledges each. A run takes about so many seconds.

Prints one JSON object. `alone` and `watched` have medians of steps per second; `loss_pct` is what the watched
run of a round does less, median, least and most. `watched_share` is the least share of a watched run during
which frames came, and `frames_per_s` the median of how many. `load` is the load of the machine before each
round. Exits with 1 if a run has another hash, a watched run was not watched, or the median is beyond
`--limit`."""

import argparse
import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

from gui_load import write_scenario
from gui_page import Page, Server

# Less than this of a run watched says too little about it.
LEAST_SHARE = 0.9


def command_of(options, folder, duration_s):
    rave = pathlib.Path(options.build).resolve() / "bin" / "rave"
    return [rave, "run", folder / "scenario.yaml", "--pace", "max", "--seed", options.seed, "--duration", duration_s,
            "--quiet", "--no-record", "--no-picture", "--replace", "--output", folder / "run"]


def result_of(folder):
    result = json.loads((folder / "run" / "result.json").read_text())
    return {"hash": result["hash"], "wall_s": result["wall_s"], "steps_per_s": result["steps"] / result["wall_s"]}


def run_alone(options, folder, duration_s):
    subprocess.run([str(word) for word in command_of(options, folder, duration_s)], check=True,
                   stdout=subprocess.DEVNULL)
    return result_of(folder)


def run_watched(options, folder, duration_s):
    page_words = ["--page", options.page] if options.page else []
    server = Server(command_of(options, folder, duration_s) + ["--gui", "--no-open", "--port", "0"] + page_words)
    try:
        page = Page(server)
        page.send({"type": "look", "poses": True, "true_poses": False, "readings": [[0, 0]], "parts": False,
                   "max_hz": options.rate})
        frames = []
        got = page.next()
        while not (isinstance(got, dict) and got["type"] == "time" and got["state"] == "ended"):
            # Frames of reported poses of the moment.
            if isinstance(got, bytes) and got[0] == 1 and not got[1] & 3:
                frames.append(time.monotonic())
            got = page.next()
    finally:
        server.end()
    result = result_of(folder)
    span_s = frames[-1] - frames[0] if frames else 0
    return {**result, "share": span_s / result["wall_s"], "frames_per_s": len(frames) / max(span_s, 1e-9)}


def measure(options, folder):
    write_scenario(folder, options.robots)
    tried_s = 10.0
    steps_per_s = run_alone(options, folder, tried_s)["steps_per_s"]
    duration_s = round(steps_per_s * options.seconds / 100)  # a step is 0.01 s
    rounds, loads = [], []
    for number in range(options.rounds):
        loads.append(round(os.getloadavg()[0], 1))
        kinds = [run_alone, run_watched] if number % 2 == 0 else [run_watched, run_alone]
        results = {run: run(options, folder, duration_s) for run in kinds}
        rounds.append((results[run_alone], results[run_watched]))
    return duration_s, rounds, loads


def report(options, duration_s, rounds, loads):
    losses = [100 * (1 - watched["steps_per_s"] / alone["steps_per_s"]) for alone, watched in rounds]
    hashes = sorted({one["hash"] for pair in rounds for one in pair})
    return {"robots": options.robots, "rate": options.rate, "seed": options.seed, "rounds": options.rounds,
            "duration_s": duration_s, "hash": hashes[0], "same_hash": len(hashes) == 1,
            "alone": round(statistics.median(alone["steps_per_s"] for alone, _ in rounds), 1),
            "watched": round(statistics.median(watched["steps_per_s"] for _, watched in rounds), 1),
            "loss_pct": {"median": round(statistics.median(losses), 2), "least": round(min(losses), 2),
                         "most": round(max(losses), 2)},
            "frames_per_s": round(statistics.median(watched["frames_per_s"] for _, watched in rounds), 1),
            "watched_share": round(min(watched["share"] for _, watched in rounds), 3), "load": loads}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--build", default="build/release")
    parser.add_argument("--page", default="", help="folder of the built page")
    parser.add_argument("--robots", type=int, default=1000)
    parser.add_argument("--seconds", type=float, default=15, help="of wall time that a run takes")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--rate", type=float, default=30, help="frames per second that are asked for")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--limit", type=float, default=3, help="percent of its speed that a run may lose")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        figures = report(options, *measure(options, pathlib.Path(folder)))
    print(json.dumps(figures))
    good = figures["same_hash"] and figures["watched_share"] >= LEAST_SHARE
    return 0 if good and figures["loss_pct"]["median"] <= options.limit else 1


if __name__ == "__main__":
    sys.exit(main())
