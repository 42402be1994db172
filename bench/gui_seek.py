#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""How long a page waits for another moment of a large recording.

    bench/gui_seek.py [--build DIR] [--mb N] [--robots N] [--recording DIR] [--seeks N]

Records a run of many robots until its file has so many MB, unless it is given one; then `rave gui` plays
it, and one page jumps to moments all over it, as somebody does who clicks at the timeline. It looks at
the readings of one robot. Prints one JSON object: size of the file, seconds that `rave gui` took to open it,
resident memory, and milliseconds from a request to the frame of its moment (median, most), and to the
last frame of the past behind it."""

import argparse
import json
import os
import pathlib
import random
import statistics
import struct
import subprocess
import sys
import tempfile
import time

from gui_load import write_scenario
from gui_page import Page, Server

PAST_S = 20


def record(rave, folder, robots, megabytes):
    """A run that is ended when its recording is large enough."""
    output = folder / "run"
    run = subprocess.Popen([rave, "run", write_scenario(folder, robots), "--pace", "max", "--quiet",
                            "--no-picture", "--output", output], stdout=subprocess.DEVNULL)
    file = output / "run.mcap"
    while run.poll() is None and not (file.exists() and file.stat().st_size > megabytes * 1e6):
        time.sleep(0.05)
    run.terminate()
    run.wait()
    return output


def seek(page, to_s, duration_s):
    """Milliseconds until the moment is there, and until its past is."""
    begin = time.monotonic()
    page.send({"type": "transport", "do": "seek", "value": to_s})
    moment_ms = past_ms = None
    due_s = min(max(to_s, 0), duration_s)
    last_due_s = due_s - 0.3
    while moment_ms is None or (past_ms is None and last_due_s > 0):
        got = page.next()
        if not isinstance(got, bytes) or got[0] != 1 or got[1] & 2:
            continue
        t = struct.unpack_from("<d", got, 8)[0]
        now_ms = 1000 * (time.monotonic() - begin)
        if not got[1] & 1 and abs(t - due_s) < 0.02:
            moment_ms = moment_ms or now_ms
        if got[1] & 1 and due_s - 0.45 < t < due_s:
            past_ms = now_ms
    return moment_ms, past_ms


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--build", default="build/release")
    parser.add_argument("--page", default="", help="folder of the built page")
    parser.add_argument("--mb", type=float, default=1000)
    parser.add_argument("--robots", type=int, default=1000)
    parser.add_argument("--recording", default="", help="folder of a run")
    parser.add_argument("--seeks", type=int, default=15)
    options = parser.parse_args()
    rave = pathlib.Path(options.build).resolve() / "bin" / "rave"
    with tempfile.TemporaryDirectory() as folder:
        run = pathlib.Path(options.recording) if options.recording else \
            record(rave, pathlib.Path(folder), options.robots, options.mb)
        load, begin = os.getloadavg()[0], time.monotonic()
        server = Server([rave, "gui", run, "--no-open", "--port", "0"] +
                        (["--page", options.page] if options.page else []))
        try:
            opened_s = time.monotonic() - begin
            page = Page(server)
            message = page.next()
            while not (isinstance(message, dict) and message["type"] == "time"):
                message = page.next()
            duration_s = message["end_s"]
            page.send({"type": "transport", "do": "pause"})
            page.send({"type": "look", "poses": True, "true_poses": False, "readings": [[0, 0]], "parts": False,
                       "max_hz": 30})
            page.moment()
            generator = random.Random(1)
            times = [seek(page, round(generator.uniform(0, duration_s), 2), duration_s)
                     for _ in range(options.seeks)]
            rss_mb = server.rss_mb()
        finally:
            server.end()
        moments = [one for one, _ in times]
        pasts = [past for _, past in times if past is not None]
        print(json.dumps({
            "mb": round((run / "run.mcap").stat().st_size / 1e6), "run_s": round(duration_s, 1),
            "opened_s": round(opened_s, 2), "rss_mb": round(rss_mb), "seeks": options.seeks,
            "seek_ms_median": round(statistics.median(moments), 1), "seek_ms_most": round(max(moments), 1),
            "past_ms_median": round(statistics.median(pasts), 1) if pasts else None, "load": round(load, 1)}))
    return 0


if __name__ == "__main__":
    sys.exit(main())
