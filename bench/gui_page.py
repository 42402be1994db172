# SPDX-License-Identifier: Apache-2.0
"""What benchmarks of the GUI Server share: start one, sign in, be a page."""

import base64
import json
import os
import pathlib
import re
import signal
import socket
import ssl
import statistics
import struct
import subprocess
import time
import urllib.parse


class Server:
    """A process with a page, and somebody who is signed in."""

    def __init__(self, command, authority=None):
        self.authority = authority
        self.process = subprocess.Popen([str(word) for word in command], stdout=subprocess.PIPE, text=True)
        link = ""
        while "http" not in link:
            link = self.process.stdout.readline()
            if link == "":
                raise RuntimeError("the process has ended: " + " ".join(map(str, command)))
        self.url = urllib.parse.urlsplit(re.search(r"http\S+", link).group(0))
        with self.connect() as door:
            door.sendall(f"GET {self.url.path}?{self.url.query} HTTP/1.1\r\nHost: {self.url.netloc}\r\n"
                         "Connection: close\r\n\r\n".encode())
            answer = b""
            while part := door.recv(4096):
                answer += part
        self.cookie = re.search(rb"Set-Cookie: ([^;]+)", answer, re.IGNORECASE).group(1).decode()

    def connect(self):
        plain = socket.create_connection((self.url.hostname, self.url.port))
        if self.authority is None:
            return plain
        return ssl.create_default_context(cafile=self.authority).wrap_socket(
            plain, server_hostname=self.url.hostname)

    @property
    def pid(self):
        return self.process.pid

    def rss_mb(self):
        text = pathlib.Path(f"/proc/{self.pid}/status").read_text()
        return int(re.search(r"^VmRSS:\s+(\d+)", text, re.MULTILINE).group(1)) / 1000

    def threads(self):
        """Seconds of processor time of each thread, by name."""
        spent = {}
        tick = os.sysconf("SC_CLK_TCK")
        for folder in pathlib.Path(f"/proc/{self.pid}/task").iterdir():
            try:
                text = (folder / "stat").read_text()
            except FileNotFoundError:
                continue
            name, rest = text[text.index("(") + 1:text.rindex(")")], text[text.rindex(")") + 2:].split()
            spent[f"{name}-{folder.name}"] = (int(rest[11]) + int(rest[12])) / tick
        return spent

    def shares(self, span):
        """Calls `span` and returns the share of a core of each thread meanwhile."""
        before, begin = self.threads(), time.monotonic()
        span()
        wall = time.monotonic() - begin
        return {name: (spent - before.get(name, 0)) / wall for name, spent in self.threads().items()}

    def end(self):
        self.process.send_signal(signal.SIGTERM)
        self.process.wait(20)
        self.process.stdout.close()


def masked(payload, opcode=1):
    """A frame of a client (RFC 6455); the mask may be zero."""
    size = len(payload)
    head = bytes([0x80 | opcode])
    head += bytes([0x80 | size]) if size < 126 else struct.pack(">BH", 0x80 | 126, size)
    return head + b"\0\0\0\0" + payload


class Page:
    """One page that waits for what it is sent; it acknowledges frames."""

    def __init__(self, server):
        self.socket = server.connect()
        host = server.url.netloc
        key = base64.b64encode(os.urandom(16)).decode()
        self.socket.sendall((f"GET /ws HTTP/1.1\r\nHost: {host}\r\nUpgrade: websocket\r\n"
                             f"Connection: Upgrade\r\nSec-WebSocket-Key: {key}\r\n"
                             "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Protocol: rave.gui.1\r\n"
                             f"Origin: {server.url.scheme}://{host}\r\nCookie: {server.cookie}\r\n\r\n").encode())
        self.buffer = b""
        while b"\r\n\r\n" not in self.buffer:
            self.fill()
        answer, self.buffer = self.buffer.split(b"\r\n\r\n", 1)
        if b" 101 " not in answer.split(b"\r\n")[0] + b" ":
            raise RuntimeError(f"not let in: {answer.decode(errors='replace')}")

    def fill(self):
        part = self.socket.recv(1 << 20)
        if not part:
            raise RuntimeError("the server has closed a connection")
        self.buffer += part

    def exactly(self, size):
        while len(self.buffer) < size:
            self.fill()
        taken, self.buffer = self.buffer[:size], self.buffer[size:]
        return taken

    def send(self, message):
        self.socket.sendall(masked(json.dumps(message).encode()))

    def next(self):
        """The next message or frame: an object, or bytes."""
        while True:
            head = self.exactly(2)
            opcode, size = head[0] & 15, head[1] & 127
            if size == 126:
                size = struct.unpack(">H", self.exactly(2))[0]
            elif size == 127:
                size = struct.unpack(">Q", self.exactly(8))[0]
            payload = self.exactly(size)
            if opcode == 9:
                self.socket.sendall(masked(payload, 10))
            elif opcode == 1:
                return json.loads(payload)
            elif opcode == 2:
                if payload[0] == 1 and not payload[1] & 3:
                    self.send({"type": "ack", "sequence": struct.unpack_from("<I", payload, 4)[0]})
                return payload

    def moment(self):
        """The time of the next frame of reported poses that is none of the past, seconds of the run."""
        while True:
            got = self.next()
            if isinstance(got, bytes) and got[0] == 1 and not got[1] & 3:
                return struct.unpack_from("<d", got, 8)[0]


def medians(rounds):
    """One object of several alike: the median of each number."""
    first = rounds[0]
    if isinstance(first, dict):
        return {key: medians([one[key] for one in rounds]) for key in first}
    if isinstance(first, (int, float)) and not isinstance(first, bool):
        return round(statistics.median(rounds), 3)
    return first
