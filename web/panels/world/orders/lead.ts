// SPDX-License-Identifier: Apache-2.0
import type {Point} from '../../../protocol/messages';

/** So far ahead it is shown where the stick leads, seconds. */
export const kLead_s = 2;
const kSteps = 16;

/** Where a robot at `x`, `y`, `yaw` goes with a velocity that stays: forward `v`, m/s, and `w` to
 * the left, rad/s. */
export function leadOf(x: number, y: number, yaw: number, v: number, w: number): Point[] {
  return Array.from({length: kSteps + 1}, (_, i): Point => {
    const t = (kLead_s * i) / kSteps;
    // Along a straight line the arc has no middle.
    if (Math.abs(w) < 1e-6) return [x + v * t * Math.cos(yaw), y + v * t * Math.sin(yaw)];
    const r = v / w;
    return [
      x + r * (Math.sin(yaw + w * t) - Math.sin(yaw)),
      y - r * (Math.cos(yaw + w * t) - Math.cos(yaw)),
    ];
  });
}
