// SPDX-License-Identifier: Apache-2.0
import {kHolds_s, type AskedVelocity} from '../../model/asked';
import {turn} from '../../model/pose_history';
import {RobotFlag, type PoseFrame} from '../../protocol/frames';

/** How far back the plot reaches, seconds of the run. */
export const kTrace_s = 30;
const kSpacing_s = 0.2;

/** How a robot was driven at a moment. */
export interface DrivenVelocity {
  t: number;
  v: number;
  /** From the headings of two pictures; null: there is no earlier one. */
  w: number | null;
}

/** How the robot that is looked at was driven, from the pictures that came. */
export class SpeedTrace {
  readonly points: DrivenVelocity[] = [];
  private slot: number | null = null;
  private yaw = 0;

  /** Takes the newest picture; of another robot it begins with the past that the page has. */
  take(slot: number, newest: PoseFrame, past: readonly PoseFrame[]): void {
    const last = this.points[this.points.length - 1];
    if (slot !== this.slot || (last !== undefined && newest.time_s < last.t)) {
      this.slot = slot;
      this.points.length = 0;
      for (const frame of past) this.add(frame, slot);
    }
    this.add(newest, slot);
    while (this.points.length > 0 && this.points[0].t < newest.time_s - kTrace_s)
      this.points.shift();
  }

  private add(frame: PoseFrame, slot: number): void {
    if (slot >= frame.speed.length || (frame.flags[slot] & RobotFlag.known) === 0) return;
    const last = this.points[this.points.length - 1];
    const dt = last === undefined ? Infinity : frame.time_s - last.t;
    if (dt < kSpacing_s - 1e-9) return;
    // Over a gap the robot may have turned more than once.
    this.points.push({
      t: frame.time_s,
      v: frame.speed[slot],
      w: dt > 5 * kSpacing_s ? null : turn(this.yaw, frame.yaw[slot]) / dt,
    });
    this.yaw = frame.yaw[slot];
  }
}

/** Lines of what was asked, as it held: each velocity until the next, and no longer than it holds
 * by itself. */
export function askedLines(
  asked: readonly AskedVelocity[],
  of: 'v' | 'w',
  now_s: number,
): [number, number][][] {
  const lines: [number, number][][] = [];
  let line: [number, number][] = [];
  asked.forEach((point, i) => {
    const next = asked[i + 1]?.t ?? Infinity;
    const end = Math.min(next, point.t + kHolds_s, now_s);
    if (end < point.t || point.t < now_s - kTrace_s) return;
    line.push([point.t, point[of]], [end, point[of]]);
    if (next > point.t + kHolds_s) {
      lines.push(line);
      line = [];
    }
  });
  return line.length > 0 ? [...lines, line] : lines;
}
