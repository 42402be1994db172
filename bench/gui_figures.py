#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""All figures of the page beside what they should be, by the benchmarks that measure each.

    bench/gui_figures.py [--build DIR] [--clients N] [--robots N] [--rounds N] [--seconds S] [--mb N] [PART ...]

| part | by | what |
|---|---|---|
| load | gui_load.py | clients that all read at once |
| tls | gui_load.py --tls | the same with TLS |
| stalled | gui_load.py --stalled 10 | ten that stop reading |
| slow | gui_load.py --slow 10 | ten that read 200 KB/s |
| watched | gui_watched.py | what a run loses to a page |
| seek | gui_seek.py | jumps in a recording of so many MB |
| pixel | web/e2e/latency.mjs | from a state to its picture |
| frames | web/e2e/frame_rate.mjs | pictures per second, first picture, first load |

Without a part all. Prints one JSON object: `rows` with each figure (median of the rounds), its target and whether it is
met, and `parts` with all that was printed. Exits with 1 if a figure misses its target."""

import argparse
import json
import os
import pathlib
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
STALLED = 10
# How much older frames of others may be beside stalled clients, milliseconds: what rounds differ by.
NOISE_MS = 5


def lines_of(command, **more):
    """What a benchmark prints: an object per line."""
    text = subprocess.run([str(word) for word in command], check=False, stdout=subprocess.PIPE, text=True,
                          env={**os.environ, **more}).stdout
    if not text:
        raise RuntimeError("no figures: " + " ".join(map(str, command)))
    return [json.loads(line) for line in text.splitlines()]


def row(figure, measured, most=None, least=None):
    """One figure with its target, of which one is given."""
    met = measured <= most if least is None else measured >= least
    return {"figure": figure, "measured": measured, **({"most": most} if least is None else {"least": least}), "met": met}


def load_words(options):
    return [HERE / "gui_load.py", "--build", options.build, "--clients", options.clients, "--robots", options.robots,
            "--rounds", options.rounds, "--seconds", options.seconds]


def load(options):
    [got] = lines_of(load_words(options))
    return got, [row("thread of the server, percent of a core", got["server_core_pct"], 10),
                 row("age of frames, 99 %, ms", got["prompt"]["age_ms_p99"], 20),
                 row("frames for a client and second, of 30", got["prompt"]["frames_per_client_s"], least=29.5),
                 row("steps of the run that are late, percent", got["run_missed_pct"], 0.5)]


def tls(options):
    [got] = lines_of(load_words(options) + ["--tls"])
    return got, [row("thread of the server with TLS, percent of a core", got["server_core_pct"], 25),
                 row("age of frames with TLS, 99 %, ms", got["prompt"]["age_ms_p99"], 20)]


def stalled(options, others):
    [got] = lines_of(load_words(options) + ["--stalled", STALLED])
    rows = [row("age of frames beside stalled clients, 99 %, ms", got["prompt"]["age_ms_p99"], 20),
            row("a stalled client, resident MB", got["stalled_mb_each"], 2)]
    if others:
        later_ms = round(got["prompt"]["age_ms_p99"] - others["prompt"]["age_ms_p99"], 1)
        rows.append(row("... which frames of others are older by, 99 %, ms", later_ms, NOISE_MS))
    return got, rows


def slow(options):
    # Not beside stalled clients: for half a minute slow ones still have the past before them, and the memory that
    # they give back then would hide what a stalled one keeps.
    [got] = lines_of(load_words(options) + ["--slow", STALLED])
    return got, [row("age of frames beside slow clients, 99 %, ms", got["prompt"]["age_ms_p99"], 20),
                 row("a client that reads 200 KB/s: oldest frame, ms", got["slow"]["age_ms_most"], 500)]


def watched(options):
    [got] = lines_of([HERE / "gui_watched.py", "--build", options.build, "--robots", options.robots, "--rounds",
                      max(3, options.rounds)])
    if not got["same_hash"]:
        raise RuntimeError("a watched run has another hash")
    return got, [row("speed that a watched run loses, percent", got["loss_pct"]["median"], 3)]


def seek(options):
    [got] = lines_of([HERE / "gui_seek.py", "--build", options.build, "--mb", options.mb])
    return got, [row(f"seek in a recording of {got['mb']} MB, median, ms", got["seek_ms_median"], 200),
                 row("... most, ms", got["seek_ms_most"], 200)]


def pixel(options):
    rave = pathlib.Path(options.build).resolve() / "bin" / "rave"
    got = lines_of(["node", HERE.parent / "web/e2e/latency.mjs", rave, 16, 1000], RAVE_ROUNDS=str(options.rounds))
    return got, [row(f"state to pixel, {one['robots']} robots, 99 %, ms", one["age_ms_p99"], 100) for one in got]


def frames(options):
    page = pathlib.Path(options.build).resolve() / "share/rave/web"
    got = lines_of(["node", HERE.parent / "web/e2e/frame_rate.mjs", page, 1000, 10000],
                   RAVE_ROUNDS=str(options.rounds))
    rows = []
    for one, least in zip(got, (50, 30)):
        rows.append(row(f"pictures per second, {one['robots']} robots", one["pictures_per_s"], least=least))
        rows.append(row(f"first picture, {one['robots']} robots, ms", one["first_picture_ms"], 1000))
    return got, rows + [row("first load, KB compressed", got[0]["first_load_kb"], 400)]


PARTS = {"load": load, "tls": tls, "stalled": stalled, "slow": slow, "watched": watched, "seek": seek, "pixel": pixel,
         "frames": frames}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("parts", nargs="*", metavar="PART", help=" ".join(PARTS))
    parser.add_argument("--build", default="build/release")
    parser.add_argument("--clients", type=int, default=200)
    parser.add_argument("--robots", type=int, default=1000)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--seconds", type=float, default=10, help="of each round with clients")
    parser.add_argument("--mb", type=float, default=1000, help="size of the recording")
    options = parser.parse_args()
    if unknown := set(options.parts) - set(PARTS):
        parser.error(f"unknown part: {', '.join(sorted(unknown))}")
    rows, parts = [], {}
    for name in [name for name in PARTS if name in options.parts or not options.parts]:
        print(f"{name} ...", file=sys.stderr, flush=True)
        more = (parts.get("load"),) if name == "stalled" else ()
        parts[name], measured = PARTS[name](options, *more)
        rows += [{"part": name, **one} for one in measured]
    print(json.dumps({"rows": rows, "parts": parts}, indent=1))
    return 0 if all(one["met"] for one in rows) else 1


if __name__ == "__main__":
    sys.exit(main())
