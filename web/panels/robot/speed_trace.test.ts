// SPDX-License-Identifier: Apache-2.0
import {expect, it} from 'vitest';
import {Asked} from '../../model/asked';
import type {PoseFrame} from '../../protocol/frames';
import {SpeedTrace, askedLines} from './speed_trace';

function frame(time_s: number, speed: number, yaw: number, flags = 1): PoseFrame {
  return {
    sequence: 0,
    past: false,
    truth: false,
    time_s,
    step: 0,
    x: new Float64Array(1),
    y: new Float64Array(1),
    yaw: Float32Array.of(yaw),
    speed: Float32Array.of(speed),
    flags: Uint16Array.of(flags),
  };
}

it('turns headings into a rate, over the end of the circle too', () => {
  const trace = new SpeedTrace();
  trace.take(0, frame(1, 0.2, 3.1), []);
  trace.take(0, frame(1.2, 0.3, -3.1), []);
  expect(trace.points.map(({t}) => t)).toEqual([1, 1.2]);
  expect(trace.points[0].w).toBeNull();
  expect(trace.points[1].w).toBeCloseTo((2 * Math.PI - 6.2) / 0.2, 4);
});

it('keeps 30 s at 5 Hz, and begins anew with another robot or an earlier time', () => {
  const trace = new SpeedTrace();
  for (let i = 0; i <= 4000; ++i) trace.take(0, frame(i * 0.01, 0.1, 0), []);
  expect(trace.points.length).toBeLessThanOrEqual(151);
  expect(trace.points.length).toBeGreaterThan(140);
  trace.take(0, frame(5, 0.1, 0), [frame(4, 0.1, 0), frame(4.2, 0.1, 0)]);
  expect(trace.points.map(({t}) => t)).toEqual([4, 4.2, 5]);
  trace.take(1, frame(6, 0.1, 0), []);
  expect(trace.points).toEqual([]);
});

it('leaves out where a robot was not known', () => {
  const trace = new SpeedTrace();
  trace.take(0, frame(1, 0.2, 0, 0), []);
  expect(trace.points).toEqual([]);
});

it('what was asked holds until the next, and 200 ms by itself', () => {
  const asked = new Asked();
  asked.note([3], 0.4, 0, 10);
  asked.note([3], 0.2, 0.5, 10.1);
  asked.note([3], 0, 0, 20);
  expect(askedLines(asked.of(3), 'v', 30)).toEqual([
    [
      [10, 0.4],
      [10.1, 0.4],
      [10.1, 0.2],
      [10.1 + 0.2, 0.2],
    ],
    [
      [20, 0],
      [20 + 0.2, 0],
    ],
  ]);
  expect(askedLines(asked.of(3), 'w', 10.2)[0].at(-1)).toEqual([10.2, 0.5]);
  expect(askedLines(asked.of(4), 'v', 30)).toEqual([]);
});

it('what was asked is kept for 30 s, and not over a time that goes back', () => {
  const asked = new Asked();
  for (let t = 0; t < 100; ++t) asked.note([0], 1, 0, t);
  expect(asked.of(0)).toHaveLength(31);
  asked.note([0], 1, 0, 5);
  expect(asked.of(0)).toEqual([{t: 5, v: 1, w: 0}]);
});
