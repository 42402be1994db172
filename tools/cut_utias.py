#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Cuts a stretch out of a UTIAS MRCLAM data set, keeping every row's text as it was.

    tools/cut_utias.py SOURCE START_S END_S OUTPUT

SOURCE holds Barcodes.dat, Landmark_Groundtruth.dat and RobotN_{Groundtruth,Odometry,
Measurement}.dat, each as it is or gzipped (.dat.gz). START_S and END_S count from the earliest
stamp of the whole data set, which is the origin of every file: a file is never counted from its
own first row. OUTPUT receives the gzipped files and `stretch.txt`.

Margin: rows from 1 s before START_S to 1 s after END_S are kept, so that poses can be
interpolated and smoothed at both ends and a measurement clock can be shifted by up to 1 s. Of
poses and commanded velocities the last row before that margin is kept too, because a reader
holds the last value. The same arguments give the same bytes.
"""
import gzip
import hashlib
import pathlib
import sys

MARGIN_NS = 1_000_000_000
STREAMS = ("Groundtruth", "Odometry", "Measurement")


def read_lines(source, name):
    """All lines of NAME.dat or NAME.dat.gz with their line ends."""
    packed = source / (name + ".dat.gz")
    data = gzip.decompress(packed.read_bytes()) if packed.exists() else None
    if data is None:
        data = (source / (name + ".dat")).read_bytes()
    return data.decode("ascii").splitlines(keepends=True)


def is_row(line):
    return line.strip() != "" and not line.lstrip().startswith("#")


def stamp_ns(text):
    """Exact nanoseconds of a decimal number of seconds; no floating point on the way."""
    sign = -1 if text.startswith("-") else 1
    whole, _, fraction = text.lstrip("-").partition(".")
    if not whole.isdigit() or len(fraction) > 9 or not (fraction or "0").isdigit():
        raise SystemExit(f"`{text}` is not a number of seconds with at most 9 decimals")
    return sign * (int(whole) * 10**9 + int(fraction.ljust(9, "0")))


def line_stamp_ns(line):
    return stamp_ns(line.split()[0])


def cut(lines, origin_ns, start_ns, end_ns, hold_last):
    """The header and the rows of the stretch with its margin, in their order."""
    kept, last_before = [], None
    first, last = start_ns - MARGIN_NS, end_ns + MARGIN_NS
    header = [line for line in lines if not is_row(line)]
    for line in filter(is_row, lines):
        t_ns = line_stamp_ns(line) - origin_ns
        if t_ns < first:
            last_before = line
        elif t_ns <= last:
            kept.append(line)
    if hold_last and last_before is not None:
        kept.insert(0, last_before)
    return header + kept


def write_packed(path, lines):
    with open(path, "wb") as raw:
        with gzip.GzipFile(filename="", mode="wb", compresslevel=9, fileobj=raw, mtime=0) as out:
            out.write("".join(lines).encode("ascii"))
    return hashlib.sha256(path.read_bytes()).hexdigest()


def seconds_text(ns):
    sign = "-" if ns < 0 else ""
    return f"{sign}{abs(ns) // 10**9}.{abs(ns) % 10**9:09d}"


def main(arguments):
    if len(arguments) != 4:
        raise SystemExit(__doc__)
    source, output = pathlib.Path(arguments[0]), pathlib.Path(arguments[3])
    start_ns, end_ns = stamp_ns(arguments[1]), stamp_ns(arguments[2])
    if end_ns <= start_ns:
        raise SystemExit("END_S must be later than START_S")
    robots = sorted({int(path.name[5:].split("_")[0])
                     for path in source.glob("Robot*_Groundtruth.dat*")})
    files = {f"Robot{robot}_{stream}": read_lines(source, f"Robot{robot}_{stream}")
             for robot in robots for stream in STREAMS}
    origin_ns = min(line_stamp_ns(line) for lines in files.values()
                    for line in filter(is_row, lines))
    output.mkdir(parents=True, exist_ok=True)
    digests = {}
    for name in ("Barcodes", "Landmark_Groundtruth"):
        digests[name] = write_packed(output / f"{name}.dat.gz", read_lines(source, name))
    for name, lines in files.items():
        rows = cut(lines, origin_ns, start_ns, end_ns, not name.endswith("_Measurement"))
        digests[name] = write_packed(output / f"{name}.dat.gz", rows)
    text = ["# Cut by tools/cut_utias.py. Times are seconds; start and end count from the origin.\n",
            f"origin_s: {seconds_text(origin_ns)}\n",
            f"start_s: {seconds_text(start_ns)}\n",
            f"end_s: {seconds_text(end_ns)}\n"]
    text += [f"sha256: {digests[name]} {name}.dat.gz\n" for name in sorted(digests)]
    (output / "stretch.txt").write_text("".join(text), encoding="ascii")


if __name__ == "__main__":
    main(sys.argv[1:])
