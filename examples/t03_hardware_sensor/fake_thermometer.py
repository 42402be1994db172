#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Stands for the hardware: a pseudo-terminal on which a temperature rises. Links it to ./ttyT."""
import os
import pty
import sys
import time
import tty

device, line = pty.openpty()
tty.setraw(line)
if os.path.islink("ttyT"):
    os.unlink("ttyT")
os.symlink(os.ttyname(line), "ttyT")
print("ready", flush=True)
for count in range(int(float(sys.argv[1]) * 10)):
    os.write(device, f"T {20 + 0.05 * count:.2f}\n".encode())
    time.sleep(0.1)
