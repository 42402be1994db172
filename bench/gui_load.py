#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What pages cost the GUI Server: `rave run --gui` of many robots, and clients that draw nothing.

    bench/gui_load.py [--build DIR] [--robots N] [--clients N] [--stalled N] [--seconds S] [--rate HZ]

Each client acknowledges every frame at once; a stalled one reads nothing any more after a second.
Prints one JSON object: the share of a core that the threads of the server take, with and without
clients; frames per client and second; how many milliseconds lie between two frames (median, 99 per
cent), what the run makes of its speed, and what a stalled client costs in memory."""

import argparse
import base64
import json
import os
import pathlib
import re
import selectors
import signal
import socket
import statistics
import struct
import subprocess
import sys
import tempfile
import time
import urllib.parse

HERE = pathlib.Path(__file__).resolve().parent
LOOK = {"type": "look", "poses": True, "true_poses": False, "readings": [], "parts": False}

SCENARIO = """name: crowd
duration_s: 100000
step_s: 0.01
robots:
  - name: walker
    file: {robot}
    team: crowd
    scatter: {{count: {robots}, x_m: [-{half}, {half}], y_m: [-{half}, {half}], clearance_m: 0.4}}
"""


def masked(payload, opcode=1):
    """A frame of a client (RFC 6455); the mask may be zero."""
    size = len(payload)
    head = bytes([0x80 | opcode])
    head += bytes([0x80 | size]) if size < 126 else struct.pack(">BH", 0x80 | 126, size)
    return head + b"\0\0\0\0" + payload


class Client:
    """One page: counts frames, acknowledges them."""

    def __init__(self, origin, cookie, rate, stalled):
        self.stalled = stalled
        self.times = []
        self.buffer = bytearray()
        host, port = origin.hostname, origin.port
        self.socket = socket.create_connection((host, port))
        key = base64.b64encode(os.urandom(16)).decode()
        self.socket.sendall((f"GET /ws HTTP/1.1\r\nHost: {host}:{port}\r\nUpgrade: websocket\r\n"
                             f"Connection: Upgrade\r\nSec-WebSocket-Key: {key}\r\n"
                             "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Protocol: rave.gui.1\r\n"
                             f"Origin: http://{host}:{port}\r\nCookie: {cookie}\r\n\r\n").encode())
        answer = b""
        while b"\r\n\r\n" not in answer:
            answer += self.socket.recv(1)
        if b" 101 " not in answer.split(b"\r\n")[0] + b" ":
            raise RuntimeError(f"not let in: {answer.decode(errors='replace')}")
        self.socket.sendall(masked(json.dumps(LOOK | {"max_hz": rate}).encode()))
        self.socket.setblocking(False)

    def take(self, now):
        try:
            data = self.socket.recv(1 << 20)
        except BlockingIOError:
            return
        if not data:
            raise RuntimeError("the server has closed a connection")
        self.buffer += data
        at = 0
        while len(self.buffer) - at >= 2:
            opcode, size, head = self.buffer[at] & 15, self.buffer[at + 1] & 127, 2
            if size == 126:
                head = 4
                if len(self.buffer) - at < head:
                    break
                size = struct.unpack_from(">H", self.buffer, at + 2)[0]
            elif size == 127:
                head = 10
                if len(self.buffer) - at < head:
                    break
                size = struct.unpack_from(">Q", self.buffer, at + 2)[0]
            if len(self.buffer) - at < head + size:
                break
            self.frame(opcode, at + head, size, now)
            at += head + size
        del self.buffer[:at]

    def frame(self, opcode, at, size, now):
        if opcode == 9:
            self.socket.send(masked(bytes(self.buffer[at:at + size]), 10))
        # A frame of poses that does not only fill trails.
        if opcode != 2 or self.buffer[at] != 1 or self.buffer[at + 1] & 1:
            return
        self.times.append(now)
        sequence = struct.unpack_from("<I", self.buffer, at + 4)[0]
        self.socket.send(masked(b'{"type":"ack","sequence":%d}' % sequence))


def threads_of(pid):
    """Seconds of processor time of each thread, by name."""
    spent = {}
    tick = os.sysconf("SC_CLK_TCK")
    for folder in pathlib.Path(f"/proc/{pid}/task").iterdir():
        try:
            text = (folder / "stat").read_text()
        except FileNotFoundError:
            continue
        name, rest = text[text.index("(") + 1:text.rindex(")")], text[text.rindex(")") + 2:].split()
        key = f"{name}-{folder.name}"
        spent[key] = (int(rest[11]) + int(rest[12])) / tick
    return spent


def rss_mb(pid):
    text = pathlib.Path(f"/proc/{pid}/status").read_text()
    return int(re.search(r"^VmRSS:\s+(\d+)", text, re.MULTILINE).group(1)) / 1000


def measure(clients, pid, seconds):
    """Spins the clients for so long. The share of a core of each thread of the process."""
    selector = selectors.DefaultSelector()
    for client in clients:
        client.times.clear()
        selector.register(client.socket, selectors.EVENT_READ, client)
    before, begin = threads_of(pid), time.monotonic()
    stall_at = begin + 1
    while (now := time.monotonic()) < begin + seconds:
        for key, _ in selector.select(0.1):
            client = key.data
            if client.stalled and now > stall_at:
                selector.unregister(client.socket)
                continue
            client.take(time.monotonic())
    wall = time.monotonic() - begin
    after = threads_of(pid)
    selector.close()
    return {name: (spent - before.get(name, 0)) / wall for name, spent in after.items()}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--build", default="build/release")
    parser.add_argument("--robots", type=int, default=1000)
    parser.add_argument("--clients", type=int, default=200)
    parser.add_argument("--stalled", type=int, default=0, help="of the clients")
    parser.add_argument("--seconds", type=float, default=10)
    parser.add_argument("--rate", type=float, default=30, help="frames per second that are asked for")
    options = parser.parse_args()
    rave = pathlib.Path(options.build).resolve() / "bin" / "rave"
    with tempfile.TemporaryDirectory() as folder:
        scenario = pathlib.Path(folder) / "scenario.yaml"
        half = max(5, round(options.robots ** 0.5))
        scenario.write_text(SCENARIO.format(robot=HERE.parent / "robots" / "wanderer.yaml",
                                            robots=options.robots, half=half))
        run = subprocess.Popen([rave, "run", scenario, "--gui", "--no-open", "--port", "0", "--quiet",
                                "--no-record", "--no-picture", "--output", pathlib.Path(folder) / "run"],
                               stdout=subprocess.PIPE, text=True)
        try:
            print(json.dumps(load(run, options)))
        finally:
            run.send_signal(signal.SIGTERM)
            run.wait(20)
    return 0


def load(run, options):
    link = ""
    while "http" not in link:
        link = run.stdout.readline()
        if link == "":
            raise RuntimeError("the run has ended")
    url = urllib.parse.urlsplit(re.search(r"http\S+", link).group(0))
    with socket.create_connection((url.hostname, url.port)) as door:
        door.sendall(f"GET {url.path}?{url.query} HTTP/1.1\r\nHost: {url.netloc}\r\n"
                     "Connection: close\r\n\r\n".encode())
        answer = b""
        while part := door.recv(4096):
            answer += part
    cookie = re.search(rb"Set-Cookie: ([^;]+)", answer, re.IGNORECASE).group(1).decode()
    time.sleep(3)
    alone = measure([], run.pid, 3)
    rss = rss_mb(run.pid)
    clients = [Client(url, cookie, options.rate, i < options.stalled) for i in range(options.clients)]
    watched = measure(clients, run.pid, 2)
    watched = measure(clients, run.pid, options.seconds)
    gaps = [1000 * (b - a) for client in clients if not client.stalled
            for a, b in zip(client.times, client.times[1:])]
    awake = [client for client in clients if not client.stalled]
    # The thread that serves is the one that the clients make busy.
    server = max(watched, key=lambda name: watched[name] - alone.get(name, 0))
    return {"robots": options.robots, "clients": options.clients, "stalled": options.stalled,
            "server_core_pct": round(100 * watched[server], 1),
            "server_core_pct_alone": round(100 * alone.get(server, 0), 1),
            "run_core_pct": round(100 * (sum(watched.values()) - watched[server]), 1),
            "run_core_pct_alone": round(100 * (sum(alone.values()) - alone.get(server, 0)), 1),
            "frames_per_client_s": round(sum(len(c.times) for c in awake) / len(awake) / options.seconds, 1),
            "gap_ms_median": round(statistics.median(gaps), 1) if gaps else None,
            "gap_ms_p99": round(statistics.quantiles(gaps, n=100)[98], 1) if len(gaps) > 100 else None,
            "mb_per_client": round((rss_mb(run.pid) - rss) / options.clients, 3)}


if __name__ == "__main__":
    sys.exit(main())
