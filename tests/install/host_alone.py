#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Installs the components host and gui, and nothing else, and commands a robot on serial lines with them.

    tests/install/host_alone.py --build BUILD --stand-in PROGRAM

The robot is the stand-in of a Create: a process of its own with wheels, a laser and a room."""
import argparse
import json
import math
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time

SOURCE = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(SOURCE / "bench"))
sys.dont_write_bytecode = True
from gui_page import Page, Server  # pylint: disable=wrong-import-position

GOAL = [0.8, 0.5]
REACHED_M = 0.2
PATIENCE_S = 60


def distance(x_m, y_m):
    return math.hypot(x_m - GOAL[0], y_m - GOAL[1])


def expect(good, text):
    if not good:
        raise SystemExit(text)


def check_drivers(rave):
    """Of the installed package, by kind: there are real ones, and no virtual one."""
    said = subprocess.run([rave, "drivers", "--json"], check=True, stdout=subprocess.PIPE, text=True)
    drivers = json.loads(said.stdout)["drivers"]
    kinds = {driver["name"]: driver["kind"] for driver in drivers}
    expect("create_drive" in kinds and "obey" in kinds, f"drivers: {sorted(kinds)}")
    virtual = [name for name, kind in kinds.items() if kind.startswith("virtual")]
    expect(not virtual, f"the component host installs virtual drivers: {virtual}")


def check_simulated_is_refused(rave):
    tried = subprocess.run([rave, "check", SOURCE / "scenarios/convoy"], check=False, capture_output=True,
                           text=True)
    said = tried.stdout + tried.stderr
    expect(tried.returncode == 2 and "differential_drive" in said and "truck.yaml:" in said,
           f"a simulated robot: {tried.returncode}, {said}")


def answer_to(page, message, number):
    """What the server answers to a request of the page."""
    page.send({**message, "request": number})
    end = time.monotonic() + PATIENCE_S
    while time.monotonic() < end:
        got = page.next()
        if isinstance(got, dict) and got.get("type") == "answer" and got.get("request") == number:
            return got
    raise SystemExit(f"no answer to {message}")


def said_in_time(page, text):
    """Waits until an event of the run says this."""
    end = time.monotonic() + PATIENCE_S
    while time.monotonic() < end:
        got = page.next()
        if isinstance(got, dict) and got.get("type") == "events" and text in json.dumps(got):
            return
    raise SystemExit(f"no event says {text}")


def drive(rave, page):
    """Armed by hand, where the robot is, it goes where the page sends it."""
    armed = subprocess.run([rave, "arm"], check=False, capture_output=True, text=True)
    expect(armed.returncode == 0, f"arm: {armed.stdout}{armed.stderr}")
    sent = answer_to(page, {"type": "order", "kind": "goal", "slots": [0], "points": [GOAL]}, 1)
    expect(sent["good"], f"goal: {sent}")


def start_stand_in(program, folder):
    stand_in = subprocess.Popen([program, "--link", folder / "base", "--laser-link", folder / "laser", "--room",
                                 SOURCE / "scenarios/figure-3/room.txt", "--pose", "0,0,0", "--log",
                                 folder / "truth.csv"], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                text=True)  # It ends when its input does.
    expect("ready" in stand_in.stdout.readline(), "the stand-in does not start")
    return stand_in


def command(rave, folder):
    """From start to end of a run in which a page sends the robot somewhere; the result."""
    share = rave.parent.parent / "share/rave"
    run = folder / "run"
    lines = [f"robots.create.variables.{line}={folder / line}" for line in ("base", "laser")]
    server = Server([rave, "run", share / "scenarios/remote-create", "--gui", "--port", "0", "--no-open",
                     "--no-picture", "--output", run, "--set", lines[0], "--set", lines[1]])
    try:
        page = Page(server)
        hello = page.next()
        expect(hello["type"] == "hello", f"first message: {hello}")
        page.send({"type": "look", "poses": True, "true_poses": False, "readings": [], "parts": False, "max_hz": 30})
        page.moment()
        drive(rave, page)
        said_in_time(page, "I am at the goal")
    finally:
        server.process.send_signal(signal.SIGINT)
        server.process.wait(30)
    return json.loads((run / "result.json").read_text())


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--build", required=True)
    parser.add_argument("--stand-in", required=True, type=pathlib.Path)
    arguments = parser.parse_args()
    program = arguments.stand_in.resolve()
    with tempfile.TemporaryDirectory(prefix="rave-host-") as scratch:
        folder = pathlib.Path(scratch)
        for component in ("host", "gui"):
            subprocess.run(["cmake", "--install", arguments.build, "--prefix", folder / "prefix", "--component",
                            component], check=True, stdout=subprocess.DEVNULL)
        os.chdir(folder)
        for variable in ("RAVE_SHARE", "RAVE_PLUGIN_PATH", "LD_LIBRARY_PATH"):
            os.environ.pop(variable, None)
        # Other runs of this machine are none of its business.
        os.environ["XDG_RUNTIME_DIR"] = scratch
        rave = folder / "prefix/bin/rave"
        check_drivers(rave)
        check_simulated_is_refused(rave)
        stand_in = start_stand_in(program, folder)
        try:
            result = command(rave, folder)
        finally:
            stand_in.kill()
            stand_in.wait()
        pose = result["robots"][0]["final_pose"]
        expect(distance(pose["x_m"], pose["y_m"]) < REACHED_M, f"the robot says that it is at {pose}")
        # Its body, of which RAVE knows nothing: word, stamps, x, y and more.
        truth = (folder / "truth.csv").read_text().splitlines()[-1].split()
        expect(distance(float(truth[3]), float(truth[4])) < REACHED_M, f"the body of the robot is at {truth}")
    print("the components host and gui command a robot by themselves")


main()
