#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Installs the component gui, and nothing else, and looks at a recording with it.

    tests/install/gui_alone.py --build BUILD
"""
import argparse
import http.client
import os
import pathlib
import subprocess
import sys
import tempfile

SOURCE = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(SOURCE / "bench"))
sys.dont_write_bytecode = True
from gui_page import Page, Server  # pylint: disable=wrong-import-position

HERE = ["bin", "share"]
SHARED = ["foxglove", "web"]


def expect(good, text):
    if not good:
        raise SystemExit(text)


def names(folder):
    return sorted(entry.name for entry in folder.iterdir())


def get(server, path):
    """Status and body, as a browser that is signed in gets them."""
    line = http.client.HTTPConnection(server.url.hostname, server.url.port, timeout=10)
    line.request("GET", path, headers={"Cookie": server.cookie})
    answer = line.getresponse()
    return answer.status, answer.read()


def check_page(server, web):
    status, body = get(server, "/")
    expect(status == 200 and body == (web / "index.html").read_bytes(), f"the page: {status}, {body[:200]}")
    for file in sorted((web / "assets").iterdir()):
        if file.suffix != ".gz":
            status, body = get(server, f"/assets/{file.name}")
            expect(status == 200 and len(body) > 0, f"{file.name}: {status}")


def check_run(server):
    page = Page(server)
    hello = page.next()
    expect(hello["type"] == "hello" and hello["run"]["name"] == "flock", f"first message: {hello}")
    page.send({"type": "look", "poses": True, "true_poses": False, "readings": [], "parts": False, "max_hz": 30})
    page.moment()


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--build", required=True)
    build = pathlib.Path(parser.parse_args().build)
    expect((build / "share/rave/web/index.html").exists(), "the page is not built: ninja rave_page")
    with tempfile.TemporaryDirectory(prefix="rave-gui-") as scratch:
        prefix, run = pathlib.Path(scratch) / "prefix", pathlib.Path(scratch) / "run"
        subprocess.run(["cmake", "--install", build, "--prefix", prefix, "--component", "gui"], check=True,
                       stdout=subprocess.DEVNULL)
        expect(names(prefix) == HERE and names(prefix / "share/rave") == SHARED,
               f"the component gui installs {names(prefix)} and {names(prefix / 'share/rave')}")
        declared = prefix / "share/rave/web/types/panel_api/index.d.ts"
        expect(declared.exists() and "interface PanelContext" in declared.read_text(encoding="utf-8"),
               f"the declarations for panels are missing: {declared}")
        subprocess.run([build / "bin/rave", "run", SOURCE / "scenarios/flock", "--duration", "1", "--pace", "max",
                        "--quiet", "--no-picture", "--output", run], check=True)
        # Nothing of the build tree is found by way of the environment or of this folder.
        os.chdir(scratch)
        for variable in ("RAVE_SHARE", "RAVE_PLUGIN_PATH", "LD_LIBRARY_PATH"):
            os.environ.pop(variable, None)
        server = Server([prefix / "bin/rave", "gui", run, "--no-open", "--port", "0"])
        try:
            check_page(server, prefix / "share/rave/web")
            check_run(server)
        finally:
            server.end()
    print("the component gui shows a recording by itself")
    return 0


if __name__ == "__main__":
    sys.exit(main())
