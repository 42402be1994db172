#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Measures how the bus and the environment manager bear many processes and robots.

    bench/bus_scale.py [--build build/release] [--rounds 5] [PART ...]

Parts: ping, busy, world, crowd, deaths, manager; all by default. Prints one JSON line per part: medians
of the rounds with the least and the most, and the load of the machine before and after. Let the machine
do nothing else.
"""
import argparse
import contextlib
import json
import os
import pathlib
import re
import signal
import statistics
import subprocess
import sys
import tempfile
import time
import uuid

ROBOTS = 10_000
HOSTS = 10
TICKS_PER_S = os.sysconf("SC_CLK_TCK")


def spread(values, digits=3):
    """The median with the least and the most."""
    return {"median": round(statistics.median(values), digits), "least": round(min(values), digits),
            "most": round(max(values), digits)}


def bench_bus(options, *words):
    program = pathlib.Path(options.build, "bench", "bench_bus")
    done = subprocess.run([program, *map(str, words)], check=True, stdout=subprocess.PIPE, text=True)
    return json.loads(done.stdout)


def ping(options, round_trips=20_000, more=()):
    """64 bytes there and back, beside a plain UDP socket in the same run."""
    rounds = [bench_bus(options, "ping", round_trips) for _ in range(options.rounds)]
    names = ["udp_median_us", "bus_median_us", "bus_ratio", "listener_median_us", "listener_ratio",
             "short_median_us", "local_ratio", *more]
    return {name: spread([one[name] for one in rounds]) for name in names}


def busy(options):
    """The same while each core has other work that never waits."""
    others = [subprocess.Popen([sys.executable, "-c", "while True: pass"])
              for _ in range(os.cpu_count() or 1)]
    try:
        # For a second each, so that what happens now and then is in the means.
        return ping(options, 500_000, ["udp_mean_us", "bus_mean_us", "short_mean_us"])
    finally:
        for other in others:
            other.kill()
            other.wait()


def world(options):
    """The world at 10 Hz from one process to many."""
    rounds = [bench_bus(options, "world", HOSTS, ROBOTS, 10) for _ in range(options.rounds)]
    names = ["missing", "receivers_core_percent", "writer_core_percent"]
    return {"receivers": HOSTS, "robots": ROBOTS,
            **{name: spread([one[name] for one in rounds]) for name in names}}


def crowd(options):
    """From the start of the first process until all know all."""
    return {str(count): spread([bench_bus(options, "crowd", count, 0)["all_know_all_s"]
                                for _ in range(options.rounds)]) for count in (10, 50)}


def deaths(options):
    """From `kill -9` until the last of the others knows it."""
    result = {}
    for count, few in ((10, 8), (50, 10)):
        times = bench_bus(options, "crowd", count, few)["death_known_s"]
        result[str(count)] = {"deaths": few, **spread(times)}
    return result


def cpu_s(process):
    fields = pathlib.Path(f"/proc/{process.pid}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / TICKS_PER_S


def memory_mb(process, what):
    status = pathlib.Path(f"/proc/{process.pid}/status").read_text()
    return int(re.search(rf"{what}:\s+(\d+) kB", status)[1]) / 1000


def wait_for_line(file, text, process):
    while not (file.exists() and text in file.read_text()):
        if process.poll() is not None:
            sys.exit(f"{file} ended before it said: {text}")
        time.sleep(0.1)


@contextlib.contextmanager
def live_swarm(rave, folder):
    """The environment manager of a swarm in real time, when all its hosts are there."""
    subprocess.run([rave, "bench", "swarm", "--robots", str(ROBOTS), "--steps", "1",
                    "--write", folder / "swarm"], check=True, stdout=subprocess.DEVNULL)
    file = folder / "swarm" / "scenario.yaml"
    text = re.sub(r"^pace: .*$", "pace: realtime\nclock: real_time\nhost_timeout_s: 60", file.read_text(),
                  flags=re.MULTILINE)
    file.write_text(text)
    run = uuid.uuid4().hex
    common = ["--processes", str(HOSTS), "--duration", "100000", "--run", run, "--bus-tag", run,
              "--quiet"]
    processes = []

    def start(what, name, *more):
        processes.append(subprocess.Popen(
            [rave, what, file, *common, *more, "--output", folder / name],
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL))

    try:
        start("env", "env")
        manager = processes[0]
        for host in range(1, HOSTS + 1):
            start("robot", f"host-{host}", "--host", f"host-{host}", "--no-record")
        wait_for_line(folder / "env" / "console.log", "all hosts are there", manager)
        yield manager
    finally:
        for process in processes:
            process.kill()
            process.wait()


def manager(options):
    """An environment manager of many robots that report at 10 Hz and see the world at 10 Hz."""
    shares = []
    with tempfile.TemporaryDirectory() as name:
        rave = pathlib.Path(options.build, "bin", "rave").resolve()
        with live_swarm(rave, pathlib.Path(name)) as process:
            time.sleep(3)
            for _ in range(options.rounds):
                begin, before = time.monotonic(), cpu_s(process)
                time.sleep(5)
                shares.append(100 * (cpu_s(process) - before) / (time.monotonic() - begin))
            rss, most = memory_mb(process, "VmRSS"), memory_mb(process, "VmHWM")
            process.send_signal(signal.SIGINT)
            process.wait()
        result = json.loads(pathlib.Path(name, "env", "result.json").read_text())
    return {"robots": ROBOTS, "hosts": HOSTS, "core_percent": spread(shares, 1),
            "rss_mb": round(rss, 1), "rss_most_mb": round(most, 1),
            "worlds_per_s": round(result["worlds"] / result["wall_s"], 2),
            "reports_per_s": round(result["states"] / result["wall_s"], 1)}


PARTS = {part.__name__: part for part in (ping, busy, world, crowd, deaths, manager)}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--build", default="build/release")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("parts", nargs="*", metavar="PART",
                        help=f"of {', '.join(PARTS)} [all]")
    options = parser.parse_args()
    unknown = [part for part in options.parts if part not in PARTS]
    if unknown:
        parser.error(f"there is no part `{unknown[0]}`; there are {', '.join(PARTS)}")
    # Whoever ends this ends what it has started.
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))
    for part in options.parts or PARTS:
        before = os.getloadavg()[0]
        result = PARTS[part](options)
        print(json.dumps({"part": part, **result, "load_before": round(before, 2),
                          "load_after": round(os.getloadavg()[0], 2)}), flush=True)


if __name__ == "__main__":
    main()
