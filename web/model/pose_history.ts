// SPDX-License-Identifier: Apache-2.0
import {RobotFlag, type PoseFrame} from '../protocol/frames';

/** How far back trails and sparklines reach, seconds of the run. */
export const kHistory_s = 20;
const kSpacing_s = 0.2;
/** A frame that comes so much later than the one before is a jump, not a motion. */
const kJump_s = 1.5;

/** The newest two frames, for interpolation, and a thinned past, for trails. */
export class PoseHistory {
  newest: PoseFrame | null = null;
  private before: PoseFrame | null = null;
  private arrived_ms = 0;
  private interval_ms = 33;
  /** Oldest first. */
  readonly past: PoseFrame[] = [];
  /** When the pose of each robot was last no stale one, seconds of the run. */
  private fresh = new Float64Array(0);

  /** Takes a frame that arrived at `now_ms` (performance.now()). The past comes after the moment that it belongs to. */
  add(frame: PoseFrame, now_ms: number): void {
    const last = this.newest ?? this.past[this.past.length - 1] ?? null;
    const other = last !== null && (last.revision !== frame.revision || last.x.length !== frame.x.length);
    if (last !== null && (other || (!frame.past && frame.time_s < last.time_s - 1e-9))) this.clear();
    this.note(frame);
    if (frame.past) {
      this.insert(frame);
      return;
    }
    this.keep(frame);
    if (this.newest !== null && frame.time_s - this.newest.time_s < kJump_s) {
      const gap = Math.min(Math.max(now_ms - this.arrived_ms, 8), 500);
      this.interval_ms += 0.2 * (gap - this.interval_ms);
      this.before = this.newest;
    } else {
      this.before = null;
    }
    this.newest = frame;
    this.arrived_ms = now_ms;
  }

  clear(): void {
    this.newest = null;
    this.before = null;
    this.past.length = 0;
    this.fresh = new Float64Array(0);
  }

  /** Writes where everybody is at `now_ms` to `out`: between the newest two frames, never beyond. */
  interpolate(now_ms: number, out: Placed): void {
    // After a jump the past comes first: its end is shown until the moment itself is there.
    const to = this.newest ?? this.past[this.past.length - 1] ?? null;
    if (to === null) {
      out.resize(0);
      return;
    }
    const n = to.x.length;
    out.resize(n);
    out.flags = to.flags;
    out.fresh = this.fresh;
    const from = this.before;
    const share = from === null ? 1 : Math.min((now_ms - this.arrived_ms) / this.interval_ms, 1);
    out.time_s = from === null ? to.time_s : from.time_s + share * (to.time_s - from.time_s);
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
    return this.before !== null && now_ms - this.arrived_ms < this.interval_ms;
  }

  private note(frame: PoseFrame): void {
    const n = frame.flags.length;
    if (this.fresh.length !== n) this.fresh = new Float64Array(n).fill(frame.time_s);
    for (let i = 0; i < n; ++i) if ((frame.flags[i] & RobotFlag.stale) === 0) this.fresh[i] = Math.max(this.fresh[i], frame.time_s);
  }

  /** Puts a frame of the past in its place, unless there is one already, or it is too old. */
  private insert(frame: PoseFrame): void {
    const now_s = this.newest?.time_s ?? frame.time_s;
    if (frame.time_s > now_s || now_s - frame.time_s > kHistory_s) return;
    let at = this.past.length;
    while (at > 0 && this.past[at - 1].time_s > frame.time_s) --at;
    const near = (other: PoseFrame | undefined) => other !== undefined && Math.abs(other.time_s - frame.time_s) < kSpacing_s - 1e-9;
    if (near(this.past[at - 1]) || near(this.past[at])) return;
    this.past.splice(at, 0, frame);
  }

  private keep(frame: PoseFrame): void {
    const last = this.past[this.past.length - 1];
    if (last !== undefined && frame.time_s - last.time_s < kSpacing_s - 1e-9) return;
    this.past.push(frame);
    while (this.past.length > 0 && frame.time_s - this.past[0].time_s > kHistory_s) this.past.shift();
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
