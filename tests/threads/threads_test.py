#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What commands do where the system grants no more threads: they say so, and none crashes or hangs.

    tests/threads/threads_test.py path/to/rave path/to/librefuse_threads.so

Each command runs several times: without its last thread, without its last two, and so on to the first. The library
refuses them."""
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

SOURCE = pathlib.Path(__file__).resolve().parents[2]
RAVE = ""
LIBRARY = ""
PATIENCE_S = 60
REFUSED = "REFUSED A THREAD"
MOST_THREADS = 40
# Others may have runs on this machine.
DOMAIN = ["--domain", str(1 + os.getpid() % 229)]


def environment(first):
    """Of a process that gets no thread from this one on; 0: all."""
    if first == 0:
        return {**os.environ}
    return {**os.environ, "LD_PRELOAD": LIBRARY, "RAVE_REFUSE_THREAD": str(first)}


class Threads(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="rave-threads-"))
        self.addCleanup(shutil.rmtree, self.folder)
        (self.folder / "page").mkdir()
        (self.folder / "page/index.html").write_text("<!doctype html><title>page</title>\n")
        # Sockets of runs, apart from those of others.
        self.addCleanup(os.environ.update, {"XDG_RUNTIME_DIR": os.environ.get("XDG_RUNTIME_DIR", "")})
        os.environ["XDG_RUNTIME_DIR"] = str(self.folder)

    def console(self):
        """What logs of the run say, in whatever folder below."""
        return "".join(file.read_text() for file in sorted(self.folder.rglob("console*.log")))

    def run_once(self, words, first, lasts):
        """Its exit code and all that it said. Who would stay is asked to end once it shows a link."""
        process = subprocess.Popen([RAVE, *map(str, words)], env=environment(first), stdout=subprocess.PIPE,
                                   stderr=subprocess.STDOUT, text=True)
        said = ""
        if lasts:
            for line in process.stdout:
                said += line
                if "http" in line or line.startswith("{"):
                    process.send_signal(signal.SIGINT)
        try:
            said += process.communicate(timeout=PATIENCE_S)[0]
        except subprocess.TimeoutExpired:
            process.kill()
            self.fail(f"without thread {first}: did not end\n{said}{process.communicate()[0]}")
        return process.returncode, said + self.console()

    def expect_told(self, words, lasts=False, least=1):
        """Returns what it said and its exit code without each thread."""
        answers = []
        for first in range(1, MOST_THREADS):
            for old in self.folder.glob("run*"):
                shutil.rmtree(old)
            code, said = self.run_once([*words, *self.output(words)], first, lasts)
            if REFUSED not in said:
                self.assertGreaterEqual(len(answers), least, f"threads that it asks for: {said}")
                return answers
            told = said.replace(REFUSED, "")
            self.assertIn(code, (0, 1, 2), f"without thread {first}: exit code {code}\n{said}")
            self.assertIn("thread", told, f"without thread {first} nothing is said, exit code {code}\n{said}")
            answers.append((code, told))
        self.fail("it asks for more and more threads")

    def output(self, words):
        return ["--output", self.folder / "run"] if words[0] == "run" else []

    def test_a_run(self):
        answers = self.expect_told(["run", SOURCE / "scenarios/flock", "--duration", "1", "--pace", "max", "--quiet",
                                    "--no-picture"], least=3)
        texts = "".join(text for _, text in answers)
        for what in ("the recording", "the watch over steps"):
            self.assertIn(f"cannot start the thread of {what}", texts)

    def test_a_run_with_threads(self):
        answers = self.expect_told(["run", SOURCE / "scenarios/flock", "--duration", "1", "--pace", "max", "--quiet",
                                    "--no-picture", "--no-record", "--threads", "3"], least=4)
        # Fewer than were asked for are an error.
        self.assertTrue(any(code == 2 and "3 threads" in text for code, text in answers), answers)

    def test_a_run_with_its_page(self):
        answers = self.expect_told(["run", SOURCE / "scenarios/flock", "--duration", "1", "--gui", "--no-open", "--port",
                                    "0", "--no-picture", "--page", self.folder / "page"], lasts=True, least=4)
        self.assertTrue(any("cannot start the thread of the web server" in text for _, text in answers), answers)

    def test_a_run_of_several_processes(self):
        self.expect_told(["run", SOURCE / "scenarios/flock", "--duration", "1", "--pace", "max", "--quiet",
                          "--no-picture", "--no-record", "--processes", "2", *DOMAIN], least=2)

    def test_the_page_of_a_run_on_the_bus(self):
        answers = self.expect_told(["gui", SOURCE / "scenarios/flock", "--processes", "2", "--no-open", "--port", "0",
                                    "--page", self.folder / "page", *DOMAIN], lasts=True, least=5)
        texts = "".join(text for _, text in answers)
        for what in ("the sender of orders", "requests of pages", "the status of robots", "the page's feed", "the web server"):
            self.assertIn(f"cannot start the thread of {what}", texts)

    def test_a_look_at_runs(self):
        answers = self.expect_told(["top", "--once", "--json", *DOMAIN])
        self.assertIn("cannot start the thread of the keys", answers[0][1])

    def test_a_stop_comes_to_a_run_all_the_same(self):
        run = subprocess.Popen([RAVE, "run", SOURCE / "scenarios/flock", "--duration", "1000", "--pace", "realtime",
                                "--no-picture", "--no-record", "--output", self.folder / "run"],
                               stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        self.addCleanup(run.stdout.close)
        self.addCleanup(run.wait, PATIENCE_S)
        self.addCleanup(run.send_signal, signal.SIGINT)
        code, said = 2, ""
        end = time.monotonic() + PATIENCE_S
        while code != 0 and run.poll() is None and time.monotonic() < end:
            # Until its socket is there no run is found, and until it has begun none is in progress.
            code, said = self.run_once(["stop", "--all"], 1, False)
        self.assertEqual(code, 0, said)
        self.assertIn("stopped", said)


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    RAVE, LIBRARY = (str(pathlib.Path(sys.argv.pop(1)).resolve()) for _ in range(2))
    unittest.main(verbosity=2)
