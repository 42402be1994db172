#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Controls a run from outside: starts it, pauses, steps, changes the world, reads poses, ends it.

    python3 remote.py SCENARIO FOLDER

A run listens on a Unix socket. Requests and answers are lines of JSON; docs/reference/control-socket.md
lists them. This file uses the Python library only.
"""
import json
import os
import pathlib
import socket
import subprocess
import sys
import tempfile
import time


class Run:
    """A run in progress. Any request that it refuses raises an exception with the reason."""

    def __init__(self, scenario, folder):
        # Sockets are in the folder `rave` of this directory. A private one has no sockets of other runs.
        runtime = tempfile.mkdtemp()
        self.process = subprocess.Popen(["rave", "run", scenario, "--output", folder, "--pace", "realtime",
                                         "--no-picture", "--quiet"],
                                        env=dict(os.environ, XDG_RUNTIME_DIR=runtime))
        self.line = None
        while self.line is None:
            if self.process.poll() is not None:
                raise RuntimeError("the run ended before it could be controlled")
            for path in pathlib.Path(runtime).glob("rave/*.sock"):
                peer = socket.socket(socket.AF_UNIX)
                peer.connect(str(path))
                self.line = peer.makefile("rw")
            time.sleep(0.05)

    def ask(self, do, **more):
        self.line.write(json.dumps({"rave": 2, "do": do, **more}) + "\n")
        self.line.flush()
        answer = json.loads(self.line.readline())
        if not answer["good"]:
            raise RuntimeError(answer["text"])
        return answer

    def time_s(self):
        return self.ask("status")["status"]["sim_s"]

    def step(self, count):
        """Computes steps of 10 ms of a paused run, and waits until they are done."""
        until_s = self.time_s() + count * 0.01
        self.ask("step", count=count)
        while self.time_s() < until_s - 0.005:
            time.sleep(0.01)


def main():
    run = Run(sys.argv[1], sys.argv[2])
    run.ask("pause")
    before_s = run.time_s()
    run.step(100)
    print(f"computed {run.time_s() - before_s:.1f} s")
    wall = {"name": "wall", "box_m": [0.2, 4], "x_m": 1.5, "y_m": 0, "z_m": [0, 0.5]}
    run.ask("edit", edit={"add_obstacle": wall})
    run.ask("set", robot="walker", key="program.cruise_mps", value="0.1")
    try:
        run.ask("set", robot="walker", key="program.cruise_mps", value="fast")
    except RuntimeError as refusal:
        print("refused:", refusal)
    run.step(100)  # Changes take effect in the next step.
    run.ask("end")
    print("exit code", run.process.wait())


if __name__ == "__main__":
    main()
