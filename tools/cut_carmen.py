#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Cuts a stretch out of a CARMEN log, keeping every row's text as it was.

    tools/cut_carmen.py LOG START_S END_S OUTPUT NAME

LOG is a CARMEN log as it is or gzipped. START_S and END_S are its own stamps (ipc_timestamp of
FLASER and ODOM rows); the moment 0 of the stretch is that of the log. OUTPUT receives NAME.log.gz
and `stretch.txt`.

Comment and PARAM rows are kept all. Of the others those are kept whose scan or odometry is stamped
from 1 s before START_S to 1 s after END_S. Rows without a stamp of their own (NEFF, and the ODOM
rows behind a scan that a mapping program left unstamped) go with the row before them. The last scan
and the last odometry before that margin are kept too, because a reader holds the last value. The
same arguments give the same bytes.
"""
import gzip
import pathlib
import sys

from cut_utias import MARGIN_NS, seconds_text, stamp_ns, write_packed

STAMPED = ("FLASER", "ODOM")


def read_lines(path):
    data = path.read_bytes()
    if data[:2] == b"\x1f\x8b":
        data = gzip.decompress(data)
    return data.decode("ascii").splitlines(keepends=True)


def row_stamp_ns(words):
    """The stamp of a row, or None where the text is no plain decimal number."""
    text = words[-3]
    whole, _, fraction = text.partition(".")
    plain = whole.isdigit() and len(fraction) <= 9 and (fraction or "0").isdigit()
    return stamp_ns(text) if plain else None


def cut(lines, start_ns, end_ns):
    first, last = start_ns - MARGIN_NS, end_ns + MARGIN_NS
    kept, held, keep, scan_ns = [], {}, False, None
    for line in lines:
        words = line.split()
        name = words[0] if words else "#"
        if name.startswith("#") or name == "PARAM":
            kept.append(line)
            continue
        t_ns = row_stamp_ns(words) if name in STAMPED else None
        behind_scan, after_scan_ns = scan_ns is not None, scan_ns
        scan_ns = t_ns if name == "FLASER" else None
        junk = behind_scan and (t_ns is None or t_ns < after_scan_ns - MARGIN_NS)
        if t_ns is not None and not junk:
            keep = first <= t_ns <= last
            if t_ns < first:
                held[name] = line
        if keep:
            kept += held.values()
            held = {}
            kept.append(line)
    return kept


def main(arguments):
    if len(arguments) != 5:
        raise SystemExit(__doc__)
    source, output = pathlib.Path(arguments[0]), pathlib.Path(arguments[3])
    start_ns, end_ns = stamp_ns(arguments[1]), stamp_ns(arguments[2])
    if end_ns <= start_ns:
        raise SystemExit("END_S must be later than START_S")
    output.mkdir(parents=True, exist_ok=True)
    name = f"{arguments[4]}.log.gz"
    digest = write_packed(output / name, cut(read_lines(source), start_ns, end_ns))
    (output / "stretch.txt").write_text(
        "# Cut by tools/cut_carmen.py. Times are seconds; start and end count from the origin.\n"
        f"origin_s: {seconds_text(0)}\nstart_s: {seconds_text(start_ns)}\n"
        f"end_s: {seconds_text(end_ns)}\nsha256: {digest} {name}\n", encoding="ascii")


if __name__ == "__main__":
    main(sys.argv[1:])
