#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What pages cost the GUI Server: `rave run --gui` of many robots, and clients that draw nothing.

    bench/gui_load.py [--build DIR] [--robots N] [--clients N] [--tls] [--stalled N] [--slow N]
                      [--slow-kb KB] [--rate HZ] [--seconds S] [--rounds N]

Each client acknowledges every frame at once; a slow one reads so many KB a second, and a stalled one
reads nothing once measuring begins. The clients are one process, `bench_gui_clients`.

Prints one JSON object, of medians of the rounds. `server_core_pct` is the share of a core of the thread
of the server, `run_core_pct` that of all other threads of the run; `_alone`: without clients. `prompt`
and `slow` have, for clients of that kind, frames per client and second, and how old frames are: from
the moment the server takes the state from the run to the end of reading it. `stalled_mb_each` is what
one stalled client costs in resident memory. `run_missed_pct` is the share of the steps of the run that ended after
their deadline, and `run_worst_ms` how late the worst one was, from the start of the run to its end. `load` is the load
of the machine before each round."""

import argparse
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time

from gui_page import Server, medians

HERE = pathlib.Path(__file__).resolve().parent

SCENARIO = """name: crowd
duration_s: 100000
step_s: 0.01
robots:
  - name: walker
    file: {robot}
    team: crowd
    scatter: {{count: {robots}, x_m: [-{half}, {half}], y_m: [-{half}, {half}], clearance_m: 0.4}}
"""
# After so long a run has all of the past that new pages are sent.
PAST_S = 22


def write_scenario(folder, robots):
    file = folder / "scenario.yaml"
    half = max(5, round(robots ** 0.5))
    file.write_text(SCENARIO.format(robot=HERE.parent / "robots" / "wanderer.yaml", robots=robots, half=half))
    return file


def start(options, folder):
    rave = pathlib.Path(options.build).resolve() / "bin" / "rave"
    command = [rave, "run", write_scenario(folder, options.robots), "--gui", "--no-open", "--port", "0",
               "--quiet", "--no-record", "--no-picture", "--output", folder / "run"]
    if options.page:
        command += ["--page", options.page]
    if not options.tls:
        return Server(command)
    keys = folder / "keys"
    subprocess.run([rave, "keys", "web", keys, "127.0.0.1"], check=True, stdout=subprocess.DEVNULL)
    command += ["--certificate", keys / "server.pem", "--key", keys / "server_key.pem"]
    return Server(command, str(keys / "authority.pem"))


def load(server, options):
    time.sleep(PAST_S if options.stalled else 3)
    alone = server.shares(lambda: time.sleep(3))
    rss_before = server.rss_mb()
    program = pathlib.Path(options.build).resolve() / "bench" / "bench_gui_clients"
    clients = subprocess.Popen(
        [program] + [str(word) for word in (
            server.url.port, server.cookie, server.authority or "-", options.clients, options.stalled,
            options.slow, 1000 * options.slow_kb, options.rate, 20 if options.slow else 6, options.seconds)],
        stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
    if clients.stdout.readline() != "begin\n":
        raise RuntimeError("the clients have ended")
    rss_begin = server.rss_mb()
    told = []
    watched = server.shares(lambda: told.append(clients.stdout.readline()))
    rss_end = server.rss_mb()
    clients.communicate("\n")
    # The thread that serves is the one that the clients make busy.
    thread = max(watched, key=lambda name: watched[name] - alone.get(name, 0))
    each = (rss_begin - rss_before) / options.clients
    return {"server_core_pct": round(100 * watched[thread], 1),
            "server_core_pct_alone": round(100 * alone.get(thread, 0), 1),
            "run_core_pct": round(100 * (sum(watched.values()) - watched[thread]), 1),
            "run_core_pct_alone": round(100 * (sum(alone.values()) - alone.get(thread, 0)), 1),
            "mb_each": round(each, 3),
            "stalled_mb_each": round(each + (rss_end - rss_begin) / options.stalled, 3) if options.stalled else None,
            **json.loads(told[0])}


def lateness(folder):
    """How late the steps of a run were that has ended."""
    late = json.loads((folder / "run" / "result.json").read_text())["lateness"]
    return {"run_missed_pct": late["missed_pct"], "run_worst_ms": round(1e3 * late["worst_s"], 1)}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--build", default="build/release")
    parser.add_argument("--page", default="", help="folder of the built page")
    parser.add_argument("--robots", type=int, default=1000)
    parser.add_argument("--clients", type=int, default=200)
    parser.add_argument("--tls", action="store_true")
    parser.add_argument("--stalled", type=int, default=0, help="of the clients")
    parser.add_argument("--slow", type=int, default=0, help="of the clients")
    parser.add_argument("--slow-kb", type=float, default=200, help="KB/s that a slow client reads")
    parser.add_argument("--seconds", type=float, default=10)
    parser.add_argument("--rate", type=float, default=30, help="frames per second that are asked for")
    parser.add_argument("--rounds", type=int, default=3)
    options = parser.parse_args()
    rounds, loads = [], []
    for _ in range(options.rounds):
        loads.append(round(os.getloadavg()[0], 1))
        with tempfile.TemporaryDirectory() as folder:
            server = start(options, pathlib.Path(folder))
            try:
                figures = load(server, options)
            finally:
                server.end()
            rounds.append({**figures, **lateness(pathlib.Path(folder))})
    about = {key: getattr(options, key) for key in ("robots", "clients", "tls", "stalled", "rate", "rounds")}
    print(json.dumps({**about, **medians(rounds), "load": loads}))
    return 0


if __name__ == "__main__":
    sys.exit(main())
