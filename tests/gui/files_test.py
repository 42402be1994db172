#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What a GUI Server serves beside its socket, asked for over plain sockets: the files of the page, the
recording, and whether it is well.

    tests/gui/files_test.py path/to/rave
"""
import gzip
import json
import pathlib
import random
import shutil
import socket
import subprocess
import sys
import tempfile
import unittest
import urllib.parse

SOURCE = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(SOURCE / "bench"))
sys.dont_write_bytecode = True
from gui_page import Page, Server  # pylint: disable=wrong-import-position

RAVE = ""
PASSWORD = "correct horse"
NOISE = random.Random(1).randbytes(3000)
# Path, Content-Type, content, and whether compression makes it smaller.
FILES = [
    ("/index.html", "text/html; charset=utf-8", b"<!doctype html><title>page</title>\n" * 40, True),
    ("/assets/app-0a1b.js", "text/javascript; charset=utf-8", b"export const robots = [];\n" * 9000, True),
    ("/assets/app-0a1b.css", "text/css; charset=utf-8", b"a { color: inherit }\n" * 50, True),
    ("/site.webmanifest", "application/manifest+json", b'{"name": "page"}\n' * 50, True),
    ("/icon.svg", "image/svg+xml", b"<svg><path d='M0 0'/></svg>\n" * 50, True),
    ("/assets/icon-0a1b.png", "image/png", NOISE, False),
    ("/assets/inter-0a1b.woff2", "font/woff2", NOISE, False),
    ("/small.txt", "text/plain; charset=utf-8", b"small\n", False),
]


class Answer:
    """One response, in full."""

    def __init__(self, data):
        head, self.body = data.split(b"\r\n\r\n", 1)
        lines = head.decode("latin-1").split("\r\n")
        self.status = int(lines[0].split(" ")[1])
        self.headers = {}
        for line in lines[1:]:
            name, value = line.split(": ", 1)
            self.headers[name.lower()] = value


def ask(server, target, headers=None, method="GET", body=b""):
    """Sends one request and reads until the server closes the connection."""
    lines = {"Host": server.url.netloc, "Connection": "close", "Content-Length": str(len(body)), **(headers or {})}
    head = f"{method} {target} HTTP/1.1\r\n" + "".join(f"{name}: {value}\r\n" for name, value in lines.items())
    with socket.create_connection((server.url.hostname, server.url.port), timeout=60) as line:
        line.sendall(head.encode() + b"\r\n" + body)
        data = b""
        while part := line.recv(1 << 16):
            data += part
    return Answer(data)


def sign_in(server, name):
    """The cookie of somebody with an account."""
    form = urllib.parse.urlencode({"name": name, "password": PASSWORD}).encode()
    answer = ask(server, "/login", {"Origin": f"http://{server.url.netloc}"}, "POST", form)
    if answer.status != 303:
        raise RuntimeError(f"{name} is not let in: {answer.status} {answer.body}")
    return answer.headers["set-cookie"].split(";")[0]


class Files(unittest.TestCase):
    """One server of a recording, for all tests."""

    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="rave-gui-files-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        for path, _, content, _ in FILES:
            file = cls.folder / "page" / path[1:]
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_bytes(content)
        subprocess.run([RAVE, "run", SOURCE / "scenarios/flock", "--duration", "20", "--pace", "max", "--quiet",
                        "--no-picture", "--output", cls.folder / "run"], check=True)
        cls.recorded = (cls.folder / "run/run.mcap").read_bytes()
        for name, role in [("ada", "super_user"), ("ben", "commander"), ("eve", "observer")]:
            subprocess.run([RAVE, "people", "add", name, "--role", role, "--accounts", cls.folder / "accounts"],
                           input=PASSWORD + "\n", text=True, check=True, stdout=subprocess.DEVNULL)
        cls.server = Server([RAVE, "gui", cls.folder / "run", "--no-open", "--port", "0",
                             "--page", cls.folder / "page", "--accounts", cls.folder / "accounts"])
        cls.addClassCleanup(cls.server.end)
        cls.ada = {"Cookie": cls.server.cookie}

    def ask(self, target, headers=None, method="GET"):
        return ask(self.server, target, headers, method)

    def test_health_needs_no_account(self):
        for method, body in [("GET", b"ok\n"), ("HEAD", b"")]:
            answer = self.ask("/healthz", method=method)
            self.assertEqual((answer.status, answer.body), (200, body))
            self.assertEqual(answer.headers["content-type"], "text/plain; charset=utf-8")
            self.assertEqual(answer.headers["content-length"], "3")

    def test_files_are_packed_for_those_who_take_it(self):
        for path, kind, content, packs in FILES:
            with self.subTest(path):
                answer = self.ask(path, {**self.ada, "Accept-Encoding": "br;q=1, gzip;q=0.8, *;q=0.1"})
                self.assertEqual(answer.status, 200)
                self.assertEqual(answer.headers["content-type"], kind)
                self.assertEqual(answer.headers["x-content-type-options"], "nosniff")
                self.assertEqual(answer.headers["content-length"], str(len(answer.body)))
                self.assertEqual(answer.headers.get("content-encoding"), "gzip" if packs else None)
                self.assertEqual(answer.headers.get("vary"), "Accept-Encoding" if packs else None)
                self.assertEqual(gzip.decompress(answer.body) if packs else answer.body, content)
                if packs:
                    self.assertLess(len(answer.body), len(content) / 2)

    def test_files_are_plain_for_others(self):
        for path, kind, content, packs in FILES:
            for encodings in (None, "identity", "br", "gzip;q=0", "*;q=0", "notgzip"):
                with self.subTest(path, encodings=encodings):
                    answer = self.ask(path, {**self.ada, **({"Accept-Encoding": encodings} if encodings else {})})
                    self.assertEqual(answer.status, 200)
                    self.assertEqual(answer.headers["content-type"], kind)
                    self.assertNotIn("content-encoding", answer.headers)
                    self.assertEqual(answer.headers.get("vary"), "Accept-Encoding" if packs else None)
                    self.assertEqual(answer.body, content)

    def test_who_has_a_file_already_gets_no_second_one(self):
        for path, _, content, packs in FILES:
            tags = set()
            for encodings in ("gzip", "identity"):
                with self.subTest(path, encodings=encodings):
                    known = {**self.ada, "Accept-Encoding": encodings}
                    first = self.ask(path, known)
                    tag = first.headers["etag"]
                    self.assertRegex(tag, r'^"[^"]+"$')
                    tags.add(tag)
                    for condition in (tag, f"W/{tag}", f'"other", {tag}', "*"):
                        again = self.ask(path, {**known, "If-None-Match": condition})
                        self.assertEqual((again.status, again.body), (304, b""), condition)
                        # What the first answer said of caching counts for what is kept (RFC 9110, 15.4.5).
                        for name in ("etag", "vary", "cache-control"):
                            self.assertEqual(again.headers.get(name), first.headers.get(name), name)
                    other = self.ask(path, {**known, "If-None-Match": '"other"'})
                    self.assertEqual((other.status, other.body), (200, first.body))
            # Bytes that differ do not have one strong tag (RFC 9110, 8.8.3.3).
            self.assertEqual(len(tags), 2 if packs else 1, path)

    def test_names_with_a_hash_are_kept_for_ever_and_others_asked_for(self):
        for path, _, _, _ in FILES:
            kept = self.ask(path, self.ada).headers["cache-control"]
            self.assertEqual("immutable" in kept, path.startswith("/assets/"), path)
            self.assertEqual(kept == "no-cache", not path.startswith("/assets/"), path)

    def test_the_recording_is_what_was_recorded(self):
        self.assertGreater(len(self.recorded), 1 << 19, "a file of one piece shows little")
        name = json.loads((self.folder / "run/result.json").read_text())["scenario"]
        for cookie in (self.server.cookie, sign_in(self.server, "ada")):
            answer = self.ask("/recording", {"Cookie": cookie, "Accept-Encoding": "gzip"})
            self.assertEqual(answer.status, 200)
            self.assertEqual(answer.headers["content-type"], "application/octet-stream")
            self.assertEqual(answer.headers["content-length"], str(len(self.recorded)))
            self.assertEqual(answer.headers["content-disposition"], f'attachment; filename="{name}.mcap"')
            self.assertNotIn("content-encoding", answer.headers)
            self.assertTrue(answer.body == self.recorded, "the bytes differ")
            head = self.ask("/recording", {"Cookie": cookie}, "HEAD")
            self.assertEqual((head.status, head.body), (200, b""))
            self.assertEqual(head.headers["content-length"], str(len(self.recorded)))
            # Ranges are not served, and no answer pretends so: all of it comes.
            part = self.ask("/recording", {"Cookie": cookie, "Range": "bytes=8-15"})
            self.assertEqual((part.status, len(part.body)), (200, len(self.recorded)))
            self.assertNotIn("accept-ranges", answer.headers)

    def test_others_get_not_one_byte_of_the_recording(self):
        pieces = [self.recorded[at:at + 8] for at in (0, len(self.recorded) // 2, len(self.recorded) - 8)]
        for name, status in [("eve", 403), ("ben", 403), (None, 401)]:
            cookie = {"Cookie": sign_in(self.server, name)} if name else {}
            for target in ("/recording", "/recording?x=1", "/%72ecording"):
                for method in ("GET", "HEAD"):
                    for more in ({}, {"Range": "bytes=0-7"}, {"Accept-Encoding": "gzip"}):
                        answer = self.ask(target, {**cookie, **more}, method)
                        self.assertEqual(answer.status, status, (name, target, more))
                        self.assertLess(len(answer.body), 100)
                        self.assertNotIn("content-disposition", answer.headers)
                        # Nor how large it is, nor what it is called.
                        self.assertNotIn(str(len(self.recorded)), answer.headers.values())
                        for piece in pieces:
                            self.assertNotIn(piece, answer.body)
        log = (self.folder / "accounts/audit.jsonl").read_text()
        for name in ("eve", "ben"):
            self.assertRegex(log, rf'"what":"refused","why":"recording","user":"{name}"')

    def test_no_other_path_leads_to_the_recording(self):
        for target in ("/run.mcap", "/recording/run.mcap", "/recording/", "/assets/run.mcap"):
            self.assertEqual(self.ask(target, self.ada).status, 404, target)


class WhileItRuns(unittest.TestCase):
    """A run in the process of its page."""

    def test_the_recording_is_there_when_the_run_is_over(self):
        folder = pathlib.Path(tempfile.mkdtemp(prefix="rave-gui-files-"))
        self.addCleanup(shutil.rmtree, folder)
        (folder / "page").mkdir()
        (folder / "page/index.html").write_text("<!doctype html><title>page</title>\n")
        server = Server([RAVE, "run", SOURCE / "scenarios/flock", "--duration", "2", "--gui", "--no-open", "--port",
                         "0", "--quiet", "--no-picture", "--page", folder / "page", "--output", folder / "run"])
        self.addCleanup(server.end)
        page = Page(server)
        hello = page.next()
        self.assertEqual(hello["run"]["source"], "live")
        early = ask(server, "/recording", {"Cookie": server.cookie})
        self.assertEqual((early.status, early.body), (404, b"there is no recording\n"))
        while not (isinstance(hello, dict) and hello["type"] == "hello" and hello["run"]["source"] == "replay"):
            hello = page.next()
        answer = ask(server, "/recording", {"Cookie": server.cookie})
        self.assertEqual(answer.status, 200)
        self.assertTrue(answer.body == (folder / "run/run.mcap").read_bytes(), "the bytes differ")


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    RAVE = str(pathlib.Path(sys.argv.pop(1)).resolve())
    unittest.main(verbosity=2)
