#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""One world over several machines, each a network namespace with an address of its own.

    tests/machines/machines_test.py path/to/rave [Machines|Ends]

Needs root, iproute2 and nftables; exits with 77 (skipped) for others, and says so. `Ends` measures time, so nothing
else should run beside it.
"""
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

RAVE = ""
ALONE = ""
PATIENCE_S = 120
END_S = 2
# For this test itself: from before the first signal is sent until it sees that the last process is gone. What an end
# really takes is 1.0 s (hosts, which wait for a lease of 1 s) to 1.2 s (the manager).
MEASURING_S = 0.5


def call(*words):
    subprocess.run(words, check=True, stdout=subprocess.DEVNULL)


class Lab:
    """Machines on one network: a bridge in a namespace of its own, and a cable to each."""

    def __init__(self, names, network="10.77.3."):
        self.prefix = f"rave-{os.getpid()}"
        self.names = names
        self.network = network
        self.hub = f"{self.prefix}-hub"
        self.processes = []

    def __enter__(self):
        call("ip", "netns", "add", self.hub)
        call("ip", "-n", self.hub, "link", "add", "bridge", "type", "bridge",
             "mcast_snooping", "0")
        call("ip", "-n", self.hub, "link", "set", "bridge", "up")
        for number, name in enumerate(self.names, 1):
            space = self.space(name)
            call("ip", "netns", "add", space)
            call("ip", "link", "add", "eth0", "netns", space, "type", "veth",
                 "peer", "name", f"port{number}", "netns", self.hub)
            call("ip", "-n", self.hub, "link", "set", f"port{number}", "master", "bridge", "up")
            call("ip", "-n", space, "addr", "add", f"{self.address(name)}/24", "dev", "eth0")
            call("ip", "-n", space, "link", "set", "eth0", "up")
            call("ip", "-n", space, "link", "set", "lo", "up")
        for number, name in enumerate(self.names, 1):
            self.await_link(self.space(name), "eth0")
            self.await_link(self.hub, f"port{number}")
        return self

    def await_link(self, space, link):
        """The kernel brings a cable up some time after it was told to, and drops packets until then."""
        end = time.monotonic() + PATIENCE_S
        while True:
            shown = subprocess.run(["ip", "-n", space, "-json", "link", "show", "dev", link],
                                   stdout=subprocess.PIPE, text=True, check=True)
            if json.loads(shown.stdout)[0]["operstate"] == "UP":
                return
            assert time.monotonic() < end, f"{link} in {space} never came up"
            time.sleep(0.02)

    def __exit__(self, *_):
        for process in self.processes:
            process.kill()
            process.wait()
        for space in [self.hub, *map(self.space, self.names)]:
            subprocess.run(["ip", "netns", "del", space], check=False,
                           stderr=subprocess.DEVNULL)

    def space(self, name):
        return f"{self.prefix}-{name.rsplit('.', 1)[-1]}"

    def address(self, name):
        return name if name.startswith(self.network) else (
            self.network + str(self.names.index(name) + 1))

    def start(self, name, words, stdout=subprocess.DEVNULL):
        process = subprocess.Popen(["ip", "netns", "exec", self.space(name), RAVE, *words],
                                   stdout=stdout, stderr=subprocess.DEVNULL)
        self.processes.append(process)
        return process

    def cable(self, name, state):
        number = self.names.index(name) + 1
        call("ip", "-n", self.hub, "link", "set", f"port{number}", state)

    def lose_packets(self, name, percent):
        rules = ("table inet loss {\n chain in {\n  type filter hook input priority 0;\n"
                 f'  iifname "eth0" numgen random mod 100 < {percent} drop\n }}\n}}\n')
        subprocess.run(["ip", "netns", "exec", self.space(name), "nft", "-f", "-"],
                       input=rules, text=True, check=True)

    def drop_all(self, name):
        rules = ("table inet wall {\n chain in {\n  type filter hook input priority 0;\n"
                 "  meta l4proto udp drop\n }\n}\n")
        subprocess.run(["ip", "netns", "exec", self.space(name), "nft", "-f", "-"],
                       input=rules, text=True, check=True)


def blocks_of(page):
    """What a tutorial does on which machine: address, whether after the others, commands."""
    return [(on, bool(after), text) for on, after, text in
            re.findall(r"```sh on=(\S+)( after)?\n(.*?)```", page.read_text(), re.DOTALL)]


def hash_alone():
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([RAVE, "run", "flock", "--duration", Processes.duration_s, "--no-record", "--no-picture", "--quiet",
                        "--pace", "max", "--output", folder], check=True)
        return json.loads(pathlib.Path(folder, "result.json").read_text())["hash"]


def can_make_machines():
    lab = Lab(["try"])
    try:
        with lab:
            lab.lose_packets("try", 1)
    except subprocess.CalledProcessError:
        lab.__exit__()
        return False
    return True


def skip_if_there_can_be_no_machines():
    if os.geteuid() != 0 or not shutil.which("ip") or not shutil.which("nft"):
        print("skipped: needs root, iproute2 (ip) and nftables (nft), to make machines of network "
              "namespaces")
        sys.exit(77)
    if not can_make_machines():
        print("skipped: this system does not allow network namespaces, cables between them, or "
              "rules that lose packets")
        sys.exit(77)


class Processes(unittest.TestCase):
    """Runs over machines."""

    duration_s = "6"

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="rave-machines-"))
        self.addCleanup(shutil.rmtree, self.folder)

    def words(self, lab, name, what, more):
        words = [what, "flock", "--output", str(self.folder / name), "--run", "machines",
                 "--interface", lab.address(name), "--duration", self.duration_s, "--processes", "2", *more]
        return words + (["--host", name] if what == "robot" else [])

    def start(self, lab, more):
        return {name: lab.start(name, self.words(lab, name, what, more))
                for name, what in [("host-1", "robot"), ("env", "env"), ("host-2", "robot")]}

    def expect_the_same_run(self, processes):
        for name, process in processes.items():
            self.assertEqual(process.wait(PATIENCE_S), 0, name + "\n" + self.console(name))
        result = json.loads((self.folder / "env" / "result.json").read_text())
        self.assertTrue(result["whole"], result)
        self.assertEqual(result["hash"], ALONE)
        # What each machine knows of its robots has come to the manager.
        self.assertEqual([host["found"] for host in result["hosts"]], [True, True], result)
        self.assertEqual(len(result["robots"]), 10, result)

    def console(self, name):
        file = self.folder / name / "console.log"
        return file.read_text() if file.exists() else ""

    def wait_for_line(self, name, text):
        end = time.monotonic() + PATIENCE_S
        while text not in self.console(name):
            self.assertLess(time.monotonic(), end, f"{name} never said: {text}\n"
                            + self.console(name))
            time.sleep(0.02)

    def peers(self, lab):
        return [word for name in lab.names for word in ("--peer", lab.address(name))]


class Machines(Processes):
    def test_found_by_a_list_of_addresses(self):
        with Lab(["env", "host-1", "host-2"]) as lab:
            self.expect_the_same_run(self.start(lab, self.peers(lab)))

    def test_found_and_served_by_multicast(self):
        with Lab(["env", "host-1", "host-2"]) as lab:
            for name in lab.names:
                call("ip", "-n", lab.space(name), "route", "add", "224.0.0.0/4", "dev", "eth0")
            self.expect_the_same_run(self.start(lab, ["--multicast", "data"]))

    def test_ten_percent_of_all_packets_are_lost(self):
        with Lab(["env", "host-1", "host-2"]) as lab:
            for name in lab.names:
                lab.lose_packets(name, 10)
            self.expect_the_same_run(self.start(lab, self.peers(lab)))

    def test_the_tutorial_of_three_computers(self):
        page = pathlib.Path(__file__).resolve().parents[2] / "docs/tutorials/three-computers.md"
        blocks = blocks_of(page)
        names = sorted({on for on, _, _ in blocks})
        self.assertEqual(len(names), 3)
        with Lab(names, "192.168.1.") as lab:
            def start(on, text):
                folder = self.folder / on
                folder.mkdir(exist_ok=True)
                path = f"{pathlib.Path(RAVE).parent}:{os.environ['PATH']}"
                process = subprocess.Popen(
                    ["ip", "netns", "exec", lab.space(on), "sh", "-ec", text], cwd=folder,
                    env={**os.environ, "PATH": path}, text=True, stdout=subprocess.PIPE,
                    stderr=subprocess.DEVNULL)
                lab.processes.append(process)
                return process

            for process in [start(on, text) for on, after, text in blocks if not after]:
                out, _ = process.communicate(timeout=PATIENCE_S)
                self.assertEqual(process.returncode, 0, out)
                self.assertIn("done", out)
            [last] = [start(on, text) for on, after, text in blocks if after]
            out, _ = last.communicate(timeout=PATIENCE_S)
            self.assertEqual(last.returncode, 0, out)
            shown = re.findall(r'"hash": "([0-9a-f]{16})"', out)
            self.assertEqual(len(shown), 2, out)
            self.assertEqual(shown[0], shown[1])

    def test_a_cable_is_cut_and_mended(self):
        with Lab(["env", "host-1", "host-2"]) as lab:
            processes = self.start(lab, self.peers(lab) + ["--pace", "2x"])
            self.wait_for_line("env", "host `host-2` is here")
            self.wait_for_line("env", "host `host-1` is here")
            lab.cable("host-1", "down")
            self.wait_for_line("env", "host `host-1` is gone")
            self.wait_for_line("host-1", "the environment manager is lost")
            lab.cable("host-1", "up")
            self.wait_for_line("env", "host `host-1` is back")
            self.expect_the_same_run(processes)


class Ends(Processes):
    """All end that are asked to, though nothing that they send arrives any more, not even at themselves."""

    duration_s = "100000"

    def begin(self, lab):
        """A run with no end, and people who look on."""
        processes = self.start(lab, self.peers(lab))
        (self.folder / "index.html").write_text("<!doctype html><title>page</title>\n")
        at = ["--interface", lab.address("env"), *self.peers(lab)]
        processes["gui"] = lab.start("env", ["gui", "flock", "--run", "machines", "--processes", "2", "--no-open",
                                             "--port", "0", "--page", str(self.folder), *at],
                                     subprocess.PIPE)
        processes["top"] = lab.start("env", ["top", "machines", "--json", *at], subprocess.PIPE)
        self.wait_for_line("env", "host `host-1` is here")
        self.wait_for_line("env", "host `host-2` is here")
        for name in ("gui", "top"):
            # The link, and the first look at the run.
            self.assertNotEqual(processes[name].stdout.readline(), b"", name)
            self.addCleanup(processes[name].stdout.close)
        return processes

    def expect_ends(self, break_network):
        with Lab(["env", "host-1", "host-2"]) as lab:
            processes = self.begin(lab)
            for name in lab.names:
                break_network(lab, name)
            begin = time.monotonic()
            for process in processes.values():
                process.send_signal(signal.SIGINT)
            took_s = {}
            for name, process in processes.items():
                try:
                    process.wait(max(0.0, begin + END_S + MEASURING_S - time.monotonic()))
                    took_s[name] = round(time.monotonic() - begin, 2)
                except subprocess.TimeoutExpired:
                    took_s[name] = None
            self.assertNotIn(None, took_s.values(), f"{took_s}\n" + self.console("env"))
            # None was killed. The manager lacks what its hosts know; they were ended by hand, which is no failure.
            self.assertEqual(processes["env"].returncode, 1, self.console("env"))
            for name in ("host-1", "host-2"):
                self.assertEqual(processes[name].returncode, 0, name + "\n" + self.console(name))
                self.assertIn("the environment manager did not receive its results", self.console(name))

    def test_a_process_ends_whose_address_is_gone(self):
        self.expect_ends(lambda lab, name: call(
            "ip", "-n", lab.space(name), "addr", "flush", "dev", "eth0"))

    def test_a_process_ends_whose_packets_are_all_dropped(self):
        self.expect_ends(lambda lab, name: lab.drop_all(name))


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    RAVE = str(pathlib.Path(sys.argv.pop(1)).resolve())
    skip_if_there_can_be_no_machines()
    if sys.argv[1:] != ["Ends"]:
        ALONE = hash_alone()
    unittest.main(verbosity=2)
