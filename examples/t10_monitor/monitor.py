#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Looks on at a run through the stream of the page, and prints how well a flock is aligned.

    python3 monitor.py LINK

LINK is what `rave run --gui` prints. The stream is a WebSocket (RFC 6455) with JSON messages and binary
frames of poses; docs/explanation/gui-protocol.md describes it. This file uses the Python library only.
"""
import base64
import cmath
import json
import os
import socket
import struct
import sys
import urllib.parse
import urllib.request

TEXT, BINARY, CLOSE, PING, PONG = 1, 2, 8, 9, 10
HEAD = struct.Struct("<BBHIdII")  # Kind, flags, unused, sequence, time, step, robots.
PAST, TRUE_POSES = 1, 2
KNOWN = 1


class Stream:
    """A connection as the page has it."""

    def __init__(self, link):
        url = urllib.parse.urlsplit(link)
        # The link works once and gives a session: a cookie that the WebSocket must bring.
        opener = urllib.request.build_opener(urllib.request.HTTPCookieProcessor())
        opener.open(link).read()
        jar = next(h for h in opener.handlers if isinstance(h, urllib.request.HTTPCookieProcessor)).cookiejar
        cookie = "; ".join(f"{one.name}={one.value}" for one in jar)
        self.socket = socket.create_connection((url.hostname, url.port))
        self.file = self.socket.makefile("rb")
        self.socket.sendall((f"GET /ws HTTP/1.1\r\nHost: {url.netloc}\r\nOrigin: http://{url.netloc}\r\n"
                             "Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
                             f"Sec-WebSocket-Key: {base64.b64encode(os.urandom(16)).decode()}\r\n"
                             f"Sec-WebSocket-Protocol: rave.gui.1\r\nCookie: {cookie}\r\n\r\n").encode())
        answer = self.file.readline()
        if b" 101 " not in answer:
            raise RuntimeError(f"not let in: {answer.decode()}")
        while self.file.readline().strip():
            pass

    def send(self, payload, kind=TEXT):
        # A client masks what it sends; with a mask of zeros the bytes stay as they are.
        size = struct.pack(">B", 0x80 | len(payload)) if len(payload) < 126 else struct.pack(
            ">BH", 0x80 | 126, len(payload))
        self.socket.sendall(bytes([0x80 | kind]) + size + bytes(4) + payload)

    def say(self, **message):
        self.send(json.dumps(message).encode())

    def received(self):
        """Each message (an object) and each binary frame (bytes), until the server closes."""
        while head := self.file.read(2):
            kind, size = head[0] & 15, head[1] & 127
            if size > 125:
                size = struct.unpack(*((">H", self.file.read(2)) if size == 126 else (">Q", self.file.read(8))))[0]
            payload = self.file.read(size)
            if kind == CLOSE:
                return
            if kind == PING:
                self.send(payload, PONG)
            elif kind == TEXT:
                yield json.loads(payload)
            elif kind == BINARY:
                yield payload


def alignment(frame, robots):
    """Length of the mean of the headings as unit vectors (Vicsek et al. 1995): 1 is all in one direction."""
    yaws = struct.unpack_from(f"<{robots}H", frame, 48 + 8 * robots)
    flags = struct.unpack_from(f"<{robots}H", frame, 48 + 12 * robots)
    known = [cmath.rect(1, 2 * cmath.pi * yaw / 65536) for yaw, flag in zip(yaws, flags) if flag & KNOWN]
    return abs(sum(known)) / len(known) if known else 0


def main():
    stream = Stream(sys.argv[1])
    next_s, sources = 0, set()
    for got in stream.received():
        if isinstance(got, dict):
            if got["type"] == "hello":
                sources.add(got["run"]["source"])
                if len(sources) > 1:  # A run that has ended becomes a replay.
                    print("the run has ended")
                    return
                stream.say(type="look", poses=True, true_poses=False, readings=[], parts=False, max_hz=10)
            elif got["type"] == "roster":
                print(f"{len(got['robots'])} robots", flush=True)
            continue
        kind, flags, _, sequence, time_s, _, robots = HEAD.unpack_from(got)
        if kind != 1 or flags & (PAST | TRUE_POSES):
            continue
        # Without this the server stops after two frames: it sends no more than a page can draw.
        stream.say(type="ack", sequence=sequence)
        if time_s >= next_s:
            print(f"{time_s:4.1f} s: alignment {alignment(got, robots):.2f}", flush=True)
            next_s = int(time_s) + 1


if __name__ == "__main__":
    main()
