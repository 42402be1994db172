#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Watches a run of several processes, and reports each host and robots whose poses are stale.

    python3 monitor.py RUN

Reads the lines of JSON that `rave top` prints. It takes no part in the run: the hash is the same with and
without it.
"""
import json
import subprocess
import sys


def main():
    watch = subprocess.Popen(["rave", "top", sys.argv[1], "--json", "--robots", "--interval", "0.5"],
                             stdout=subprocess.PIPE, text=True)
    seen = set()
    for line in watch.stdout:
        state = json.loads(line)
        for host in state["hosts"]:
            if host["role"] == "host" and host["name"] not in seen and host["step"]:
                seen.add(host["name"])
                print(f"{host['name']}: {host['robots']} robots", flush=True)
        for robot in state["robots"]:
            if robot["stale"]:
                print(f"robot {robot['name']} is stale", flush=True)
        if state["phase"] in ("ended", "failed"):
            print(state["phase"], flush=True)
            break
    watch.terminate()
    watch.wait()


if __name__ == "__main__":
    main()
