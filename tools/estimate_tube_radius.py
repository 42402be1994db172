#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Estimates the radius of the UTIAS tubes from which codes the recorded cameras read.

    tools/estimate_tube_radius.py ESTIMATE CHECK [--expect RADIUS_M]

ESTIMATE and CHECK are folders of one recording (data/utias-mrclam6/100-220 and 760-900). The radius
is estimated on the first and checked on the second.

Neither the data nor its description gives the size of a tube. But tubes hide one another, and which
of them a camera still reads depends on their radius r:

1. A case is one robot, at one place (within 2 cm), with one tube inside its field of view (within 30
   degrees to the right and 29 to the left, 1 to 6 m away) and at least one other tube within 0.15 m
   of the line between them. It is *read* if any picture from that place has the code of the tube.
   Places come from the motion capture, interpolated; pictures in gaps above 0.3 s are left out.
2. For a radius r, each case has a widest visible strip of the tube: what no nearer tube covers.
3. Model: a code is read with one probability p if the strip is at least w wide, and by error
   (1 of 100) if it is narrower. p and w are the same for all cases and are fitted with r.
4. For each r the best w and p give its likelihood; all in steps of 1 mm. The estimate is the mean of
   the radii, weighted by it; the interval holds those whose log likelihood is at most 1.92 below
   the best (95 %).

On CHECK the same likelihood is computed; the estimate, to the nearest 5 mm, passes if the best one
there is at most 1.92 better. Last, both folders are searched for sightings that the rule of
`virtual_landmark_camera` hides with this radius: lines to the middle of the tube and to 0.9 of its
radius on both sides.

With --expect, the exit code is 1 if the rounded estimate differs or fails the check.
"""
import argparse
import bisect
import gzip
import math
import pathlib

JOIN_M = 0.02
LONGEST_GAP_S = 0.3
ROBOTS = range(1, 6)
BESIDE_M = 0.15
MISREAD = 0.01
WORTH = 1.92
RADII_MM = range(15, 91)
STRIPS_MM = range(0, 61)
ROUNDED_MM = 5


def rows(path):
    with gzip.open(path, "rt") as lines:
        return [line.split() for line in lines if line.strip() and not line.startswith("#")]


def wrapped(angle):
    return (angle + math.pi) % (2 * math.pi) - math.pi


class Track:
    """The poses of one robot."""

    def __init__(self, path):
        self.poses = sorted(tuple(map(float, row)) for row in rows(path))
        self.stamps = [pose[0] for pose in self.poses]

    def at(self, stamp):
        """(x, y, heading), interpolated; None in gaps and outside."""
        i = bisect.bisect_right(self.stamps, stamp)
        if i in (0, len(self.poses)):
            return None
        a, b = self.poses[i - 1], self.poses[i]
        if b[0] - a[0] > LONGEST_GAP_S:
            return None
        u = (stamp - a[0]) / (b[0] - a[0])
        return a[1] + u * (b[1] - a[1]), a[2] + u * (b[2] - a[2]), a[3] + u * wrapped(b[3] - a[3])


def in_front(place, tube, others, beside_m):
    """Those of `others` that stand between, within `beside_m` of the line."""
    dx, dy = tube[0] - place[0], tube[1] - place[1]
    squared = dx * dx + dy * dy
    found = []
    for other in others:
        ex, ey = other[0] - place[0], other[1] - place[1]
        along = (ex * dx + ey * dy) / squared
        if 0 < along < 1 and abs(ex * dy - ey * dx) < beside_m * math.sqrt(squared):
            found.append(other)
    return found


def strip_m(place, tube, nearer, radius_m):
    """The widest part of the tube that no nearer one covers."""
    dx, dy = tube[0] - place[0], tube[1] - place[1]
    range_m, bearing = math.hypot(dx, dy), math.atan2(dy, dx)
    half = math.asin(radius_m / range_m)
    free = [(-half, half)]
    for other in nearer:
        ex, ey = other[0] - place[0], other[1] - place[1]
        other_m = math.hypot(ex, ey)
        if other_m >= range_m:
            continue
        middle = wrapped(math.atan2(ey, ex) - bearing)
        half = math.asin(min(1.0, radius_m / other_m))
        free = [part for begin, end in free
                for part in ((begin, min(end, middle - half)), (max(begin, middle + half), end))
                if part[1] > part[0]]
    return max((end - begin for begin, end in free), default=0.0) * range_m


def hidden(place, tube, nearer, radius_m):
    """The rule of virtual_landmark_camera."""
    dx, dy = tube[0] - place[0], tube[1] - place[1]
    share = 0.9 * radius_m / math.hypot(dx, dy)
    for side in (0, 1, -1):
        vx, vy = dx - side * share * dy, dy + side * share * dx
        squared = vx * vx + vy * vy
        clear = True
        for other in nearer:
            ex, ey = other[0] - place[0], other[1] - place[1]
            along = min(1.0, max(0.0, (ex * vx + ey * vy) / squared))
            clear = clear and math.hypot(along * vx - ex, along * vy - ey) >= radius_m
        if clear:
            return False
    return True


def log_likelihood(strips, least_m):
    """Of [(width, read)], if a code is read where the strip is at least `least_m` wide; best p."""
    counts = {True: [0, 0], False: [0, 0]}
    for width_m, read in strips:
        counts[width_m >= least_m][int(read)] += 1
    unread, read = counts[False]
    total = unread * math.log(1 - MISREAD) + read * math.log(MISREAD)
    for count in counts[True]:
        if count > 0:
            total += count * math.log(count / sum(counts[True]))
    return total


class Stretch:
    """What the cameras of one folder read, and what stood in front of it."""

    def __init__(self, folder):
        self.cases = []      # [place, tube, nearer, read]
        self.sightings = []  # (place, tube, nearer) of each sighting of a tube
        subjects = {int(code): int(subject) for subject, code in rows(folder / "Barcodes.dat.gz")}
        self.tubes = {int(row[0]): (float(row[1]), float(row[2]))
                      for row in rows(folder / "Landmark_Groundtruth.dat.gz")}
        for robot in ROBOTS:
            track = Track(folder / f"Robot{robot}_Groundtruth.dat.gz")
            pictures = {}
            for stamp, code, _, _ in rows(folder / f"Robot{robot}_Measurement.dat.gz"):
                pictures.setdefault(float(stamp), set()).add(subjects.get(int(code)))
            last = {}
            for stamp in sorted(pictures):
                pose = track.at(stamp)
                if pose is not None:
                    self.take(pose, pictures[stamp], last)

    def take(self, pose, seen, last):
        place = pose[:2]
        for subject, tube in self.tubes.items():
            others = [other for name, other in self.tubes.items() if name != subject]
            dx, dy = tube[0] - pose[0], tube[1] - pose[1]
            bearing_deg = math.degrees(wrapped(math.atan2(dy, dx) - pose[2]))
            read = subject in seen
            if read:
                self.sightings.append((place, tube, in_front(place, tube, others, 0.3)))
            in_field = -30 < bearing_deg < 29 and 1 < math.hypot(dx, dy) < 6
            nearer = in_front(place, tube, others, BESIDE_M)
            if not nearer or not (in_field or read):
                continue
            case = last.get(subject)
            if case and max(abs(case[0][i] - place[i]) for i in (0, 1)) < JOIN_M:
                case[3] = case[3] or read
                continue
            last[subject] = [place, tube, nearer, read]
            self.cases.append(last[subject])

    def profile(self):
        """By radius in mm: (log likelihood, width of the strip in mm), with the best width."""
        best = {}
        for radius in RADII_MM:
            strips = [(strip_m(place, tube, nearer, radius / 1000), read)
                      for place, tube, nearer, read in self.cases]
            # A tube that nothing covers is in view, however wide the strip has to be.
            best[radius] = max((log_likelihood(strips, min(width, 1.96 * radius) / 1000), width)
                               for width in STRIPS_MM)
        return best

    def hidden_count(self, radius_m):
        return sum(hidden(*sighting, radius_m) for sighting in self.sightings)


def highest(profile):
    return max(value for value, _ in profile.values())


def mean_mm(profile):
    weights = {radius: math.exp(value - highest(profile)) for radius, (value, _) in profile.items()}
    return sum(radius * weight for radius, weight in weights.items()) / sum(weights.values())


def main():
    parser = argparse.ArgumentParser(description="Estimates the radius of the UTIAS tubes.")
    parser.add_argument("estimate", type=pathlib.Path)
    parser.add_argument("check", type=pathlib.Path)
    parser.add_argument("--expect", type=float, metavar="RADIUS_M")
    arguments = parser.parse_args()
    stretches = [Stretch(arguments.estimate), Stretch(arguments.check)]
    profiles = [stretch.profile() for stretch in stretches]
    print("radius_mm  log_likelihood strip_mm hidden   log_likelihood strip_mm hidden   (check)")
    for radius in RADII_MM[::ROUNDED_MM]:
        columns = [f"{profile[radius][0]:14.1f} {profile[radius][1]:8d} "
                   f"{stretch.hidden_count(radius / 1000):6d}"
                   for stretch, profile in zip(stretches, profiles)]
        print(f"{radius:9d}  {'   '.join(columns)}")
    first, second = profiles
    inside = [radius for radius in RADII_MM if first[radius][0] >= highest(first) - WORTH]
    best = ROUNDED_MM * round(mean_mm(first) / ROUNDED_MM)
    worse = highest(second) - second[best][0]
    holds = worse <= WORTH
    print(f"estimate: {mean_mm(first) / 1000:.4f} m ({inside[0] / 1000:.3f} to "
          f"{inside[-1] / 1000:.3f}) from {len(stretches[0].cases)} cases, rounded {best / 1000} m")
    print(f"check: {'holds' if holds else 'FAILS'}, {worse:.1f} below the best of "
          f"{len(stretches[1].cases)} cases; hides "
          + " and ".join(f"{stretch.hidden_count(best / 1000)} of {len(stretch.sightings)}"
                         for stretch in stretches) + " sightings of tubes")
    if arguments.expect is not None and (not holds or abs(arguments.expect - best / 1000) > 1e-9):
        raise SystemExit(f"expected {arguments.expect} m")


if __name__ == "__main__":
    main()
