#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Reckons the messages of a run of many hosts, from robots, hosts, rate, range and density.

    bench/message_load.py [--robots 100000] [--hosts 100] [--rate 10] [--range 8] [--density 0.1]
                          [--clock lock_step] [--network ethernet]
    bench/message_load.py --measure build/release/bin/rave

Prints JSON: what each process sends and gets, in bytes and messages per second, and the share of a
core it takes, for three ways to share a world (docs/explanation/scaling.md). With
--measure it runs small cases in a network namespace of its own, counts the bytes on its loopback, and
exits with 1 if the model is off by more than a tenth, with 77 if there can be no such namespace.
"""
import argparse
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile

# Bytes of a message as it is serialised: its head, and what each robot in it takes.
SIZES = {"lock_step": {"report": (120, 28), "world": (220, 49)},
         "real_time": {"report": (130, 60), "world": (150, 60)}}
TOUCH_BYTES = 20          # more for a robot that touches something, in lock-step
ID_BYTES = 4              # more per robot in a world that has not all of them, in lock-step
SEAT_BYTES = 8            # more per host in the head of a world in lock-step
PACKET_HEAD = 28 + 20 + 12 + 36   # IP and UDP, RTPS, its time, DATA or DATA_FRAG
HEARTBEAT = 32
ACK_BYTES = 28 + 20 + 16 + 28
NETWORKS = {
    "loopback": {"fragment": 63_000, "frame": 65_500, "frame_head": 14},
    "ethernet": {"fragment": 1344, "frame": 1500, "frame_head": 38},
}
# Nanoseconds of a core per robot, as perf shows them in a run of three processes with 10 000 robots
# (docs/benchmarks.md, Where a step of three processes goes), and per message.
COSTS_NS = {
    "read_report": 41, "step": 179, "write_world": 22, "send": 10,    # the manager
    "read_world": 50, "join": 84, "own": 555,                         # a host
    "message": 10_000,
}


def wire_bytes(size, network):
    """A message of `size` bytes with all heads around it."""
    net = NETWORKS[network]
    fragments = max(1, math.ceil(size / net["fragment"]))
    whole = size + fragments * PACKET_HEAD + HEARTBEAT
    frames = fragments if net["frame"] > net["fragment"] else math.ceil(whole / net["frame"])
    return whole + frames * net["frame_head"]


def ack_bytes(network):
    return ACK_BYTES + NETWORKS[network]["frame_head"]


def neighbourhood(robots, density, reach_m):
    """Robots within reach of a square that holds `robots`, those in it left out."""
    side_m = math.sqrt(robots / density)
    return density * (4 * side_m * reach_m + math.pi * reach_m**2)


def traffic(out, into, network):
    """Of messages that a process sends and gets: (number, size) each; acknowledged one by one."""
    ack = ack_bytes(network)
    sent = sum(count * wire_bytes(size, network) for count, size in out)
    got = sum(count * wire_bytes(size, network) for count, size in into)
    out_count, in_count = sum(count for count, _ in out), sum(count for count, _ in into)
    return {"out_Bps": sent + in_count * ack, "in_Bps": got + out_count * ack,
            "out_per_s": out_count, "in_per_s": in_count}


def shares(case):
    """How each of three ways loads a host and the manager."""
    clock, hosts, rate = case["clock"], case["hosts"], case["rate"]
    own = case["robots"] / hosts
    lock_step = clock == "lock_step"
    report_head, report_each = SIZES[clock]["report"]
    world_head, world_each = SIZES[clock]["world"]
    if lock_step:
        world_head += SEAT_BYTES * hosts
        world_each += TOUCH_BYTES * case["touching"]
    id_bytes = ID_BYTES if lock_step else 0  # in real time each robot has its number already
    near = min(case["robots"] - own, neighbourhood(own, case["density"], case["range"]))
    report = report_head + report_each * own
    cost, network = COSTS_NS, case["network"]

    def host(world_robots, each):
        world = world_head + each * world_robots
        load = traffic([(rate, report)], [(rate, world)], network)
        busy_ns = (world_robots * (cost["read_world"] + cost["join"]) + own * cost["own"]
                   + 2 * cost["message"])
        return world, {**load, "core_share": rate * busy_ns * 1e-9}

    def manager(world, world_robots):
        load = traffic([(rate * hosts, world)], [(rate * hosts, report)], network)
        busy_ns = (case["robots"] * (cost["read_report"] + cost["step"])
                   + hosts * world_robots * cost["send"] + 2 * hosts * cost["message"])
        # One world for all is written once, and those of regions one by one.
        written = case["robots"] if world_robots == case["robots"] else hosts * world_robots
        return {**load, "core_share": rate * (busy_ns + written * cost["write_world"]) * 1e-9}

    everything, everything_host = host(case["robots"], world_each)
    part, part_host = host(own + near, world_each + id_bytes)
    # A host is the authority of its square and tells each of eight others what is near their border.
    border = (world_head + (world_each + id_bytes + report_each) * near / 8)
    federated = traffic([(8 * rate, border)], [(8 * rate, border)], network)
    federated_ns = ((own + near) * (cost["step"] + cost["join"] + cost["read_world"])
                    + own * (cost["own"] + cost["write_world"]) + 16 * cost["message"])
    return {
        "robots_near_a_host": near,
        "one authority, all robots to each host":
            {"host": everything_host, "manager": manager(everything, case["robots"])},
        "one authority, its region to each host":
            {"host": part_host, "manager": manager(part, own + near)},
        "an authority per host, borders to its neighbours":
            {"host": {**federated, "core_share": rate * federated_ns * 1e-9}},
    }


def rounded(value):
    if isinstance(value, dict):
        return {key: rounded(each) for key, each in value.items()}
    if isinstance(value, float):
        return float(f"{value:.3g}") if abs(value) < 100 else round(value)
    return value


def bytes_per_step(case):
    """All that is on the loopback in one step, both ways, in the way it is built."""
    load = shares({**case, "rate": 1})["one authority, all robots to each host"]["manager"]
    return load["in_Bps"] + load["out_Bps"]


def loopback_bytes():
    counts = re.search(r"lo:\s*(\d+)\s+(\d+)", pathlib.Path("/proc/self/net/dev").read_text())
    return int(counts[1])


def run_and_count(rave, swarm, folder, hosts, steps):
    before = loopback_bytes()
    output = pathlib.Path(folder, f"{hosts}-{steps}")
    subprocess.run([rave, "run", swarm, "--processes", str(hosts), "--duration", str(steps / 10),
                    "--no-record", "--no-picture", "--quiet", "--pace", "max", "--dds-only",
                    "--output", output], check=True)
    contacts = json.loads((output / "result.json").read_text())["events"]["contact"]
    return loopback_bytes() - before, contacts


def measure_case(rave, robots, hosts, steps):
    """Bytes per step, as the difference of a long and a short run."""
    with tempfile.TemporaryDirectory() as folder:
        swarm = pathlib.Path(folder, "swarm")
        subprocess.run([rave, "bench", "swarm", "--robots", str(robots), "--steps", str(steps),
                        "--write", swarm], check=True, stdout=subprocess.DEVNULL)
        short, _ = run_and_count(rave, swarm, folder, hosts, steps // 4)
        long, _ = run_and_count(rave, swarm, folder, hosts, steps)
    return (long - short) / (steps - steps // 4)


def close(measured, model):
    return abs(measured - model) <= 0.1 * model


def measure(rave):
    subprocess.run(["ip", "link", "set", "lo", "up"], check=True)
    good = True
    for robots, hosts, steps in [(300, 3, 400), (1000, 2, 300), (3000, 3, 200)]:
        case = {"robots": robots, "hosts": hosts, "clock": "lock_step", "network": "loopback",
                "range": 3, "density": 0.1, "touching": 0.0}
        model = bytes_per_step(case)
        for _ in range(3):
            measured = measure_case(rave, robots, hosts, steps)
            # What a machine that was busy could not answer in time was sent again.
            if close(measured, model):
                break
        good = good and close(measured, model)
        print(json.dumps({"robots": robots, "hosts": hosts, "measured_B_per_step": round(measured),
                          "model_B_per_step": round(model),
                          "measured_to_model": round(measured / model, 3)}), flush=True)
    return 0 if good else 1


def in_a_namespace(rave):
    """Measures where nobody else's packets are counted."""
    spaces = ["unshare", "--net"] + ([] if os.geteuid() == 0 else ["--map-root-user"])
    if subprocess.run([*spaces, "ip", "link", "set", "lo", "up"], check=False).returncode != 0:
        print("skipped: no network namespace can be made here", file=sys.stderr)
        return 77
    return subprocess.run([*spaces, sys.executable, __file__, "--measure-here", rave],
                          check=False).returncode


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--robots", type=int, default=100_000)
    parser.add_argument("--hosts", type=int, default=100)
    parser.add_argument("--rate", type=float, default=10, help="steps or worlds per second [10]")
    parser.add_argument("--range", type=float, default=8, help="of the sensors, in m [8]")
    parser.add_argument("--density", type=float, default=0.1, help="robots per m² [0.1]")
    parser.add_argument("--touching", type=float, default=0.02, help="part of all robots [0.02]")
    parser.add_argument("--clock", choices=SIZES, default="lock_step")
    parser.add_argument("--network", choices=NETWORKS, default="ethernet")
    parser.add_argument("--measure", metavar="RAVE")
    parser.add_argument("--measure-here", metavar="RAVE", help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.measure:
        sys.exit(in_a_namespace(options.measure))
    if options.measure_here:
        sys.exit(measure(options.measure_here))
    if not 1 <= options.hosts <= options.robots:
        parser.error(f"--hosts: {options.hosts} is not in 1 to {options.robots}")
    case = {key: value for key, value in vars(options).items() if not key.startswith("measure")}
    print(json.dumps({**case, **rounded(shares(case))}, indent=2))


if __name__ == "__main__":
    main()
