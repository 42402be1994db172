// SPDX-License-Identifier: Apache-2.0
import {RobotFlag, type PoseFrame} from '../protocol/frames';

/** How far back trails and sparklines reach, seconds of the run. */
export const kHistory_s = 20;
const kSpacing_s = 0.2;
/** A frame that comes so much later than the one before is a jump, not a motion. */
const kJump_s = 1.5;

/** The numbers of frames that are kept for interpolation, and of gaps between them for its
 * delay. */
const kRecent = 4;
const kGaps = 8;
const kFirstGap_ms = 33;

/** The newest frames, for interpolation, and a thinned past, for trails. */
export class PoseHistory {
  newest: PoseFrame | null = null;
  /** Without a jump between them, the newest last. */
  private readonly recent: PoseFrame[] = [];
  private arrived_ms = 0;
  /** The last gaps between frames: of the wall and of the run. */
  private readonly gaps: {wall_ms: number; run_s: number}[] = [];
  private delay_ms = kFirstGap_ms;
  /** Seconds of the run in a millisecond. */
  private rate = 0.001;
  /** Oldest first. */
  readonly past: PoseFrame[] = [];
  /** When the pose of each robot was last no stale one, seconds of the run. */
  private fresh = new Float64Array(0);
  /** The highest speed of each robot while its pose was no stale one, metres per second. */
  private fastest = new Float32Array(0);

  /** Takes a frame that arrived at `now_ms` (performance.now()). The past comes after the moment
   * that it belongs to. `held`: the run stands, and frames come with its steps alone, so the time
   * between them says nothing. */
  add(frame: PoseFrame, now_ms: number, held = false): void {
    const last = this.newest ?? this.past[this.past.length - 1] ?? null;
    const other = last !== null && last.x.length !== frame.x.length;
    if (last !== null && (other || (!frame.past && frame.time_s < last.time_s - 1e-9)))
      this.clear();
    this.note(frame);
    if (frame.past) {
      this.insert(frame);
      return;
    }
    this.keep(frame);
    if (!held && this.newest !== null && frame.time_s - this.newest.time_s < kJump_s) {
      this.measure(now_ms - this.arrived_ms, frame.time_s - this.newest.time_s);
      if (this.recent.length === kRecent) this.recent.shift();
    } else {
      this.recent.length = 0;
    }
    this.recent.push(frame);
    this.newest = frame;
    this.arrived_ms = now_ms;
  }

  /** Pictures are as far behind the newest frame as frames are apart, so that the next one comes
   * when its motion ends. The longest gap does not count: a page that stood still for a moment
   * would show old states long after. */
  private measure(wall_ms: number, run_s: number): void {
    if (this.gaps.length === kGaps) this.gaps.shift();
    this.gaps.push({wall_ms: Math.min(Math.max(wall_ms, 8), 500), run_s});
    const wall = this.gaps.reduce((sum, gap) => sum + gap.wall_ms, 0);
    this.rate = this.gaps.reduce((sum, gap) => sum + gap.run_s, 0) / wall;
    const longest = Math.max(...this.gaps.map((gap) => gap.wall_ms));
    this.delay_ms =
      this.gaps.length < 3 ? wall / this.gaps.length : (wall - longest) / (this.gaps.length - 1);
  }

  clear(): void {
    this.newest = null;
    this.recent.length = 0;
    this.gaps.length = 0;
    this.delay_ms = kFirstGap_ms;
    this.past.length = 0;
    this.fresh = new Float64Array(0);
    this.fastest = new Float32Array(0);
  }

  /** Writes where everybody is at `now_ms` to `out`: between frames that have come, never
   * beyond. */
  interpolate(now_ms: number, out: Placed): void {
    // After a jump the past comes first: its end is shown until the moment itself is there.
    const newest = this.newest ?? this.past[this.past.length - 1] ?? null;
    if (newest === null) {
      out.resize(0);
      return;
    }
    const shown_s =
      newest.time_s - this.rate * Math.max(this.delay_ms - (now_ms - this.arrived_ms), 0);
    let at = this.recent.length - 1;
    while (at > 1 && this.recent[at - 1].time_s > shown_s) --at;
    const to = this.recent[at] ?? newest;
    const from = at > 0 ? this.recent[at - 1] : null;
    const n = newest.x.length;
    out.resize(n);
    out.flags = newest.flags;
    out.fresh = this.fresh;
    out.fastest = this.fastest;
    const span_s = from === null ? 0 : to.time_s - from.time_s;
    const share =
      from === null || span_s <= 0 ? 1 : Math.min(Math.max((shown_s - from.time_s) / span_s, 0), 1);
    out.time_s = from === null ? to.time_s : from.time_s + share * span_s;
    if (from === null || share >= 1) {
      out.x.set(to.x);
      out.y.set(to.y);
      out.yaw.set(to.yaw);
      return;
    }
    for (let i = 0; i < n; ++i) {
      // A robot that was not there before has not come from the origin.
      const blend = (from.flags[i] & 1) !== 0 ? share : 1;
      out.x[i] = from.x[i] + blend * (to.x[i] - from.x[i]);
      out.y[i] = from.y[i] + blend * (to.y[i] - from.y[i]);
      out.yaw[i] = from.yaw[i] + blend * turn(from.yaw[i], to.yaw[i]);
    }
  }

  /** Whether a picture between two frames is still to be drawn. */
  moving(now_ms: number): boolean {
    const [last, newest] = this.recent.slice(-2);
    // Frames of a run that is held are all of one moment.
    return (
      newest !== undefined &&
      newest.time_s > last.time_s &&
      now_ms - this.arrived_ms < this.delay_ms
    );
  }

  private note(frame: PoseFrame): void {
    const n = frame.flags.length;
    if (this.fresh.length !== n) {
      this.fresh = new Float64Array(n).fill(frame.time_s);
      this.fastest = new Float32Array(n);
    }
    for (let i = 0; i < n; ++i) {
      if ((frame.flags[i] & RobotFlag.stale) !== 0) continue;
      this.fresh[i] = Math.max(this.fresh[i], frame.time_s);
      this.fastest[i] = Math.max(this.fastest[i], Math.abs(frame.speed[i]));
    }
  }

  /** Puts a frame of the past in its place, unless there is one already, or it is too old. */
  private insert(frame: PoseFrame): void {
    const now_s = this.newest?.time_s ?? frame.time_s;
    if (frame.time_s > now_s || now_s - frame.time_s > kHistory_s) return;
    let at = this.past.length;
    while (at > 0 && this.past[at - 1].time_s > frame.time_s) --at;
    const near = (other: PoseFrame | undefined) =>
      other !== undefined && Math.abs(other.time_s - frame.time_s) < kSpacing_s - 1e-9;
    if (near(this.past[at - 1]) || near(this.past[at])) return;
    this.past.splice(at, 0, frame);
  }

  private keep(frame: PoseFrame): void {
    const last = this.past[this.past.length - 1];
    if (last !== undefined && frame.time_s - last.time_s < kSpacing_s - 1e-9) return;
    this.past.push(frame);
    while (this.past.length > 0 && frame.time_s - this.past[0].time_s > kHistory_s)
      this.past.shift();
  }
}

/** Places of all robots in one picture; arrays are kept from picture to picture. */
export class Placed {
  time_s = 0;
  x = new Float64Array(0);
  y = new Float64Array(0);
  yaw = new Float32Array(0);
  flags: Uint16Array = new Uint16Array(0);
  fresh = new Float64Array(0);
  fastest = new Float32Array(0);

  /** When the pose of a robot was last no stale one, seconds of the run. */
  freshAt(slot: number): number {
    return Math.min(this.fresh[slot] ?? this.time_s, this.time_s);
  }

  get count(): number {
    return this.x.length;
  }

  resize(n: number): void {
    if (this.x.length === n) return;
    this.x = new Float64Array(n);
    this.y = new Float64Array(n);
    this.yaw = new Float32Array(n);
    this.flags = new Uint16Array(n);
  }
}

/** The shorter way from one heading to another, radians. */
export function turn(from: number, to: number): number {
  const two_pi = 2 * Math.PI;
  const d = (to - from) % two_pi;
  if (d > Math.PI) return d - two_pi;
  return d < -Math.PI ? d + two_pi : d;
}
