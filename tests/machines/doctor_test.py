#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""`rave doctor` between machines, each a network namespace, with what can go wrong between them.

    tests/machines/doctor_test.py path/to/rave

Needs root, iproute2 and nftables; exits with 77 (skipped) for others, and says so.
"""
import json
import pathlib
import subprocess
import sys
import tempfile
import time
import unittest

import machines_test
from machines_test import Lab, call

PATIENCE_S = 60


class TwoMachines(Lab):
    """`here` asks, `there` listens."""

    def __init__(self):
        super().__init__(["here", "there"])

    def __exit__(self, *problem):
        super().__exit__(*problem)
        for process in self.processes:
            if process.stderr:
                process.stderr.close()

    def listen(self, *more):
        process = subprocess.Popen(
            ["ip", "netns", "exec", self.space("there"), machines_test.RAVE, "doctor", "--listen",
             "--interface", self.address("there"), *more],
            stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        self.processes.append(process)
        line = process.stderr.readline()
        assert line.startswith("listening at"), line
        return process

    def ask(self, *more):
        """The findings as {check: finding}; the worst of a check counts."""
        run = subprocess.run(
            ["ip", "netns", "exec", self.space("here"), machines_test.RAVE, "doctor", "--json",
             "--interface", self.address("here"), "--peer", self.address("here"),
             "--peer", self.address("there"), *more],
            stdout=subprocess.PIPE, text=True, timeout=PATIENCE_S, check=False)
        order = ["good", "unknown", "advice", "problem"]
        worst = {}
        for finding in json.loads(run.stdout)["findings"]:
            known = worst.get(finding["check"])
            if known is None or order.index(known["verdict"]) < order.index(finding["verdict"]):
                worst[finding["check"]] = finding
        return run.returncode, worst

    def filter(self, name, chain, rule):
        rules = f"table inet t {{\n chain c {{\n  type filter hook {chain};\n  {rule}\n }}\n}}\n"
        subprocess.run(["ip", "netns", "exec", self.space(name), "nft", "-f", "-"], input=rules,
                       text=True, check=True)


class Doctor(unittest.TestCase):
    def expect(self, findings, check, verdict, what="", mend=""):
        finding = findings.get(check, {"verdict": "not there", "what": "", "mend": ""})
        self.assertEqual(finding["verdict"], verdict, findings)
        self.assertIn(what, finding["what"])
        self.assertIn(mend, finding["mend"])

    def expect_well(self, findings, *checks):
        for check in checks:
            self.expect(findings, check, "good")

    def test_all_is_well(self):
        with TwoMachines() as lab:
            lab.listen()
            code, findings = lab.ask()
            self.expect_well(findings, "interface", "peers", "way", "version", "clock", "ports",
                             "sizes", "bus", "domain", "keys", "self")
            self.assertEqual(code, 0, findings)

    def test_all_is_well_by_multicast(self):
        with TwoMachines() as lab:
            for name in lab.names:
                call("ip", "-n", lab.space(name), "route", "add", "224.0.0.0/4", "dev", "eth0")
            lab.listen("--multicast", "data")
            code, findings = lab.ask("--multicast", "data")
            self.expect_well(findings, "multicast", "bus", "way")
            self.assertEqual(code, 0, findings)

    def test_nobody_listens(self):
        with TwoMachines() as lab:
            code, findings = lab.ask()
            self.assertEqual(code, 1)
            self.expect(findings, "way", "problem", "`rave doctor --listen` does not run on it", "rave doctor --listen")

    def test_a_firewall_here(self):
        with TwoMachines() as lab:
            lab.listen()
            lab.filter("here", "input priority 0", "udp dport 7400-7649 drop")
            code, findings = lab.ask()
            self.assertEqual(code, 1)
            self.expect(findings, "way", "problem", "no answer")
            self.expect(findings, "self", "problem", "do not arrive",
                        "sudo nft list ruleset    # shows the rules; accept UDP 7400 to 7649")
            subprocess.run(["ip", "netns", "exec", lab.space("here"), "nft", "delete", "table",
                            "inet", "t"], check=True)
            code, findings = lab.ask()
            self.assertEqual(code, 0, findings)

    def test_a_firewall_there_that_lets_a_part_through(self):
        with TwoMachines() as lab:
            lab.listen()
            lab.filter("there", "input priority 0", "udp dport 7410-7649 drop")
            code, findings = lab.ask()
            self.assertEqual(code, 1)
            self.expect_well(findings, "way", "self")
            self.expect(findings, "ports", "problem", "cannot be reached, but 7402 can")
            self.expect(findings, "bus", "problem", "is not visible on the bus")

    def test_another_domain(self):
        with TwoMachines() as lab:
            lab.listen("--domain", "7")
            code, findings = lab.ask()
            self.assertEqual(code, 1)
            self.expect(findings, "domain", "problem", "it uses domain 7, this machine 0",
                        "--domain 7")

    def test_multicast_is_dropped(self):
        with TwoMachines() as lab:
            for name in lab.names:
                call("ip", "-n", lab.space(name), "route", "add", "224.0.0.0/4", "dev", "eth0")
            lab.listen("--multicast", "data")
            lab.filter("there", "input priority 0", "ip daddr 224.0.0.0/4 drop")
            code, findings = lab.ask("--multicast", "data")
            self.assertEqual(code, 1)
            self.expect(findings, "multicast", "problem", "multicast packets from here do not arrive there",
                        "--multicast none --peer")

    def test_fragments_are_dropped(self):
        with TwoMachines() as lab:
            lab.listen()
            # Before packets are put together again.
            lab.filter("there", "prerouting priority -450", "ip frag-off & 0x3fff != 0 drop")
            code, findings = lab.ask()
            self.assertEqual(code, 1)
            self.expect_well(findings, "way", "ports")
            self.expect(findings, "sizes", "problem", "datagrams of 4000 bytes and more do not arrive")

    def test_keys_of_another_authority(self):
        with tempfile.TemporaryDirectory() as folder, TwoMachines() as lab:
            for name in lab.names:
                subprocess.run([machines_test.RAVE, "keys", "new", f"{folder}/{name}-set", name],
                               check=True, stdout=subprocess.DEVNULL)
            lab.listen("--security", f"{folder}/there-set/there")
            code, findings = lab.ask("--security", f"{folder}/here-set/here")
            self.assertEqual(code, 1)
            self.expect(findings, "keys", "problem", "it has those of", "rave keys new SET")

    def test_no_cable(self):
        with TwoMachines() as lab:
            lab.listen()
            lab.cable("here", "down")
            code, findings = lab.ask()
            self.assertEqual(code, 1)
            self.expect(findings, "interface", "problem", "eth0 is down, or has no cable")


class Top(unittest.TestCase):
    def test_a_run_of_other_machines_is_watched_from_a_third(self):
        with Lab(["env", "host-1", "host-2", "desk"]) as lab, \
                tempfile.TemporaryDirectory() as folder:
            peers = [word for name in lab.names for word in ("--peer", lab.address(name))]
            span = ["--duration", "100", "--processes", "2"]
            for name in ("env", "host-1", "host-2"):
                words = ["env"] if name == "env" else ["robot", "--host", name]
                lab.start(name, [words[0], "flock", *words[1:], *span, "--run", "watched",
                                 "--output", f"{folder}/{name}", "--interface", lab.address(name),
                                 *peers, *(["--pace", "1x"] if name == "env" else [])])
            end = time.monotonic() + PATIENCE_S
            states = {}
            while states != {"environment manager": "here", "host-1": "here", "host-2": "here"}:
                self.assertLess(time.monotonic(), end, states)
                run = subprocess.run(
                    ["ip", "netns", "exec", lab.space("desk"), machines_test.RAVE, "top",
                     "watched", "--once", "--json", "--interval", "0.5", "--interface",
                     lab.address("desk"), *peers], stdout=subprocess.PIPE,
                    stderr=subprocess.DEVNULL, text=True, check=False)
                if run.returncode == 0:
                    document = json.loads(run.stdout)
                    states = {host["name"]: host["state"] for host in document["hosts"]}


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    machines_test.RAVE = str(pathlib.Path(sys.argv.pop(1)).resolve())
    machines_test.skip_if_there_can_be_no_machines()
    unittest.main(verbosity=2)
