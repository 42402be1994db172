#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""How the memory of a long run grows: `rave run` over several processes, in real time.

Prints one JSON object: of each process its resident memory after the warm-up and at the end, and the
slope between (least squares). `grows_percent` is what it grew, `per_hour_percent` what the slope
makes of an hour. Ends with 1 if a process grows by more than --limit percent in an hour, measured
over what remains behind the warm-up."""

import argparse
import json
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).resolve().parent


def status_kb(pid):
    """Anonymous and all resident memory; None if the process has ended."""
    try:
        text = pathlib.Path(f"/proc/{pid}/status").read_text()
    except (FileNotFoundError, ProcessLookupError):
        return None
    found = dict(re.findall(r"^(RssAnon|VmRSS):\s+(\d+) kB$", text, re.MULTILINE))
    return (int(found["RssAnon"]), int(found["VmRSS"])) if len(found) == 2 else None


def hosts_of(pid):
    """The processes that a process has started, by the name of their host."""
    hosts = {}
    for child in pathlib.Path(f"/proc/{pid}/task/{pid}/children").read_text().split():
        try:
            words = pathlib.Path(f"/proc/{child}/cmdline").read_text().split("\0")
        except FileNotFoundError:
            continue
        if "--host" in words:
            hosts[words[words.index("--host") + 1]] = int(child)
    return hosts


def slope(points):
    """Least squares, in kB per second."""
    mean_t = sum(t for t, _ in points) / len(points)
    mean_kb = sum(kb for _, kb in points) / len(points)
    square = sum((t - mean_t) ** 2 for t, _ in points)
    return sum((t - mean_t) * (kb - mean_kb) for t, kb in points) / square if square else 0.0


def watch(run, options):
    """Samples of each process: time, anonymous kB, resident kB."""
    samples = {}
    begin = time.monotonic()
    names = {"manager" if options.processes > 1 else "run": run.pid}
    while run.poll() is None:
        now = time.monotonic() - begin
        if options.processes > 1:
            names.update(hosts_of(run.pid))
        for name, pid in names.items():
            found = status_kb(pid)
            if found:
                samples.setdefault(name, []).append((now, *found))
        try:
            run.wait(options.every)
        except subprocess.TimeoutExpired:
            pass
    return samples


def grown(points, warm_up_s, end_s):
    """The last moments, in which a process puts its results together, are not part of the run."""
    points = [point for point in points if warm_up_s <= point[0] <= end_s]
    if len(points) < 3:
        return None
    kb_per_s = slope([(t, anon) for t, anon, _ in points])
    first_kb, last_kb = points[0][2], points[-1][2]
    return {"rss_mb": round(first_kb / 1000, 2), "rss_end_mb": round(last_kb / 1000, 2),
            "anonymous_mb": round(points[0][1] / 1000, 2),
            "anonymous_end_mb": round(points[-1][1] / 1000, 2),
            "grows_percent": round(100 * (last_kb - first_kb) / first_kb, 2),
            "kb_per_s": round(kb_per_s, 3),
            "per_hour_percent": round(100 * 3600 * kb_per_s / first_kb, 1)}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--build", default="build/release")
    parser.add_argument("--scenario", default=str(HERE.parent / "scenarios" / "flock"))
    parser.add_argument("--processes", type=int, default=2, help="beside the manager; 1: none")
    parser.add_argument("--duration", type=float, default=600, help="seconds [600]")
    parser.add_argument("--warm-up", type=float, default=60, help="seconds [60]")
    parser.add_argument("--every", type=float, default=1, help="seconds between samples [1]")
    parser.add_argument("--pace", default="realtime")
    parser.add_argument("--limit", type=float, default=5, help="percent in an hour [5]")
    parser.add_argument("more", nargs="*", help="further options of `rave run`, behind --")
    options = parser.parse_args()
    # Whoever ends this ends what it has started.
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))
    with tempfile.TemporaryDirectory() as folder:
        rave = pathlib.Path(options.build, "bin", "rave").resolve()
        run = subprocess.Popen(
            [rave, "run", options.scenario, "--processes", str(options.processes), "--pace",
             options.pace, "--duration", str(options.duration), "--quiet", "--output",
             pathlib.Path(folder, "run"), *options.more], stdout=subprocess.DEVNULL)
        try:
            samples = watch(run, options)
        finally:
            if run.poll() is None:
                run.send_signal(signal.SIGINT)
                run.wait()
        result = json.loads(pathlib.Path(folder, "run", "result.json").read_text())
        record_mb = sum(file.stat().st_size for file in pathlib.Path(folder).rglob("*.mcap")) / 1e6
    end_s = max(points[-1][0] for points in samples.values()) - 2 * options.every - 1
    processes = {name: grown(points, options.warm_up, end_s) for name, points in samples.items()}
    measured = [one for one in processes.values() if one]
    holds = bool(measured) and all(one["per_hour_percent"] <= options.limit for one in measured)
    print(json.dumps({"scenario": pathlib.Path(options.scenario).name, "wall_s": result["wall_s"],
                      "steps": result["steps"], "whole": result["whole"],
                      "events": sum(result["events"].values()), "record_mb": round(record_mb, 1),
                      "processes": processes, "limit_percent_per_hour": options.limit,
                      "holds": holds}))
    sys.exit(0 if holds else 1)


if __name__ == "__main__":
    main()
