// SPDX-License-Identifier: Apache-2.0
import {describe, expect, it} from 'vitest';
import {MotionCutter, type Acceleration} from './motion_cutter';

/** Motions that are cut out of `seconds` of samples at 50 Hz. */
function cut(seconds: number, at: (t: number) => Acceleration): Acceleration[][] {
  const cutter = new MotionCutter();
  cutter.begin();
  const motions: Acceleration[][] = [];
  for (let i = 0; i < seconds * 50; ++i) {
    const motion = cutter.take(i / 50, at(i / 50));
    if (motion !== null) motions.push(motion);
  }
  return motions;
}
const between = (t: number, from: number, to: number): Acceleration =>
  t >= from && t < to ? [5 * Math.sin(9 * t), 3, 0] : [0.1, 0, 0];

describe('motions of a phone', () => {
  it('begin when the hand moves and end when it rests', () => {
    const motions = cut(4, (t) => between(t, 1, 2));
    expect(motions.length).toBe(1);
    expect(Math.abs(motions[0].length - 50)).toBeLessThan(4);
    expect(cut(8, (t) => (t < 4 ? between(t, 1, 2) : between(t, 5, 6))).length).toBe(2);
  });

  it('are not a twitch, and not a hand that never rests', () => {
    expect(cut(3, (t) => between(t, 1, 1.1))).toEqual([]);
    expect(cut(6.1, () => [4, 0, 0])).toEqual([]);
    expect(cut(5, () => [0.5, 0.5, 0])).toEqual([]);
  });

  it('are free of gravity also where the sensor cannot tell', () => {
    const cutter = new MotionCutter();
    cutter.begin();
    expect(cutter.withoutGravity([0, 0, 9.8], 0.02)).toEqual([0, 0, 0]);
    const [x, , z] = cutter.withoutGravity([4, 0, 9.8], 0.02);
    expect(x).toBeGreaterThan(3.8);
    expect(Math.abs(z)).toBeLessThan(0.01);
  });
});
