#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Man pages and bash completion as people use them: pages are rendered, and words are completed.

    tests/docs/man_completion_test.py --rave PROGRAM
"""
import argparse
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
TOOL = ROOT / "tools/docs/command_docs.py"
RAVE = None
ARENA = """\
name: arena
duration_s: 600
robots:
  - name: r
    pose: {x_m: 0, y_m: 0}
    robot: {body: {shapes: [{disc_radius_m: 0.2, z_m: [0, 0.3]}]}}
"""


def output_of(*command, **more):
    return subprocess.run([str(c) for c in command], check=True, capture_output=True, text=True,
                          timeout=60, **more).stdout


class CommandDocs(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="rave-command-docs-"))
        cls.man, cls.bash = cls.folder / "man1", cls.folder / "rave.bash"
        output_of(sys.executable, TOOL, "--rave", RAVE, "--man", cls.man, "--bash", cls.bash)

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def complete(self, *words):
        """What bash offers for the last word."""
        line = " ".join(f"'{w}'" for w in words)
        script = (f"source '{self.bash}'; COMP_WORDS=({line}); COMP_CWORD={len(words) - 1}; "
                  "_rave; printf '%s\\n' \"${COMPREPLY[@]}\"")
        path = f"{RAVE.parent}:{os.environ['PATH']}"
        # A folder for the sockets of runs apart from that of the user, whose runs are none of ours.
        env = dict(os.environ, PATH=path, XDG_RUNTIME_DIR=str(self.folder))
        return set(output_of("bash", "-c", script, env=env, cwd=self.folder).split())

    def test_every_command_has_a_page(self):
        listed = output_of(RAVE, "--help").partition("\nExamples:")[0]
        commands = re.findall(r"^  ([a-z][a-z-]*) ", listed, re.MULTILINE)
        self.assertGreater(len(commands), 20)
        for command in commands:
            self.assertTrue((self.man / f"rave-{command}.1").exists(), command)
        self.assertTrue((self.man / "rave-edit-add.1").exists())

    @unittest.skipUnless(shutil.which("man") or shutil.which("mandoc"), "no man on this machine")
    def test_pages_render_without_a_warning(self):
        for page in sorted(self.man.iterdir()):
            if shutil.which("mandoc"):
                done = subprocess.run(["mandoc", "-T", "lint", "-W", "error", page], check=False,
                                      capture_output=True, text=True)
            else:
                done = subprocess.run(["man", "--warnings", "-E", "UTF-8", "-l", "-Tutf8", "-Z", page],
                                      check=False, capture_output=True, text=True)
            self.assertEqual((done.returncode, done.stderr), (0, ""), page.name + done.stdout)

    def test_a_page_says_what_help_says(self):
        text = (self.man / "rave-run.1").read_text().replace("\\-", "-")
        self.assertIn("rave-run - run a scenario", text)
        self.assertIn("--seed N\nRandom seed (overrides the scenario).", text)
        self.assertIn(".SH EXAMPLES", text)

    def test_completes_commands(self):
        self.assertEqual(self.complete("rave", "ver"), {"verify", "version"})
        self.assertEqual(self.complete("rave", "edit", ""), {"add", "move", "remove", "list"})
        self.assertEqual(self.complete("rave", "rnu"), set())

    def test_completes_options(self):
        self.assertEqual(self.complete("rave", "run", "--no"),
                         {"--no-picture", "--no-record", "--no-open"})
        self.assertIn("--at", self.complete("rave", "edit", "add", "--"))

    def test_completes_values(self):
        (self.folder / "robot.yaml").touch()
        (self.folder / "scenarios/lab").mkdir(parents=True)
        self.assertEqual(self.complete("rave", "check", "rob"), {"robot.yaml"})
        self.assertEqual(self.complete("rave", "check", "a", "rob"), {"robot.yaml"})
        self.assertIn("lab", self.complete("rave", "run", "--seed", "7", "la"))
        self.assertEqual(self.complete("rave", "schema", "s"), {"scenario"})
        self.assertEqual(self.complete("rave", "new", ""), {"program", "driver", "panel"})
        self.assertEqual(self.complete("rave", "edit", "add", ""), {"box", "disc", "polygon"})
        self.assertEqual(self.complete("rave", "run", "--pace", "r"), {"realtime"})
        self.assertEqual(self.complete("rave", "bench", "swarm", "--workload", ""), {"A", "B"})

    def test_completes_drivers_and_not_what_they_contain(self):
        offered = self.complete("rave", "describe", "r")
        drivers = json.loads(output_of(RAVE, "drivers", "--json"))["drivers"]
        self.assertEqual(offered, {d["name"] for d in drivers if d["name"].startswith("r")})

    def test_completes_runs_and_not_the_table_around_them(self):
        (self.folder / "arena.yaml").write_text(ARENA)
        env = dict(os.environ, XDG_RUNTIME_DIR=str(self.folder))
        command = [RAVE, "run", "arena.yaml", "--pace", "realtime", "--no-record", "--no-picture",
                   "--quiet"]
        with subprocess.Popen(command, cwd=self.folder, env=env, stderr=subprocess.DEVNULL) as run:
            try:
                offered = self.complete("rave", "pause", "")
                for _ in range(200):
                    if offered or run.poll() is not None:
                        break
                    offered = self.complete("rave", "pause", "")
                self.assertEqual(offered, {f"arena-{run.pid}"})
                self.assertEqual(self.complete("rave", "pause", "x"), set())
            finally:
                run.terminate()


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--rave", type=pathlib.Path, required=True)
    arguments, rest = parser.parse_known_args()
    RAVE = arguments.rave.resolve()
    unittest.main(argv=[sys.argv[0], *rest])
