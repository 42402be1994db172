// SPDX-License-Identifier: Apache-2.0
import {describe, expect, it} from 'vitest';
import type {PoseFrame} from '../protocol/frames';
import {PoseHistory, Placed, turn} from './pose_history';

function frame(time_s: number, x: number, yaw = 0, past = false, flags = 1): PoseFrame {
  return {
    sequence: 0,
    past,
    truth: false,
    time_s,
    step: 0,
    x: Float64Array.of(x),
    y: Float64Array.of(0),
    yaw: Float32Array.of(yaw),
    speed: Float32Array.of(0),
    flags: Uint16Array.of(flags),
  };
}

describe('interpolation', () => {
  it('lies between the newest two frames and never beyond', () => {
    const history = new PoseHistory();
    history.add(frame(1, 0), 1000);
    for (let i = 1; i <= 30; ++i) history.add(frame(1 + 0.1 * i, i), 1000 + 100 * i);
    const placed = new Placed();
    history.interpolate(4000, placed);
    expect(placed.x[0]).toBeCloseTo(29, 1);
    history.interpolate(4050, placed);
    expect(placed.x[0]).toBeGreaterThan(29.3);
    expect(placed.x[0]).toBeLessThan(29.7);
    history.interpolate(9000, placed);
    expect(placed.x[0]).toBe(30);
  });

  it('moves evenly where states of the run come at another beat than frames', () => {
    const history = new PoseHistory();
    const placed = new Placed();
    // A state each 20 ms, of which 30 a second are sent.
    const times = [];
    for (let ms = 0; ms < 3000; ms += 100) times.push(ms, ms + 40, ms + 60);
    let last = Number.NaN;
    for (let now = 0, next = 0; now < 3000; now += 4) {
      for (; next < times.length && times[next] <= now; ++next)
        history.add(frame(times[next] / 1000, times[next]), now);
      history.interpolate(now, placed);
      if (now > 1000) {
        expect(placed.x[0] - last).toBeGreaterThanOrEqual(0);
        expect(placed.x[0] - last).toBeLessThan(9);
        expect(now - placed.x[0]).toBeLessThan(45);
      }
      last = placed.x[0];
    }
  });

  it('is not late for long after a page that stood still', () => {
    const history = new PoseHistory();
    const placed = new Placed();
    let now = 0;
    for (; now < 1000; now += 33) history.add(frame(now / 1000, now), now);
    now += 400;
    for (const end = now + 330; now < end; now += 33) {
      history.add(frame(now / 1000, now), now);
      history.interpolate(now, placed);
      expect(now - placed.x[0]).toBeLessThan(50);
    }
  });
});

describe('interpolation of one robot', () => {
  it('turns the shorter way', () => {
    expect(turn(0.1, 6.2)).toBeCloseTo(-0.183, 2);
    expect(turn(6.2, 0.1)).toBeCloseTo(0.183, 2);
  });

  it('does not slide a robot in from the origin that was not known before', () => {
    const history = new PoseHistory();
    history.add(frame(1, 0, 0, false, 0), 0);
    history.add(frame(1.1, 50), 100);
    const placed = new Placed();
    history.interpolate(101, placed);
    expect(placed.x[0]).toBe(50);
  });
});

describe('the past', () => {
  it('is forgotten when time goes back', () => {
    const history = new PoseHistory();
    for (let i = 0; i < 20; ++i) history.add(frame(i * 0.2, i), i * 100);
    expect(history.past.length).toBe(20);
    history.add(frame(1, 5), 5000);
    expect(history.past.length).toBe(1);
    const placed = new Placed();
    history.interpolate(5001, placed);
    expect(placed.x[0]).toBe(5);
  });

  it('comes after its moment, takes its place in it, and moves nobody', () => {
    const history = new PoseHistory();
    history.add(frame(30, 7), 1000);
    for (const time_s of [9.5, 10.5, 10.7, 29.9, 20, 31])
      history.add(frame(time_s, time_s, 0, true), 1010);
    expect(history.past.map((one) => one.time_s)).toEqual([10.5, 10.7, 20, 30]);
    const placed = new Placed();
    history.interpolate(1020, placed);
    expect(placed.x[0]).toBe(7);
    expect(placed.time_s).toBe(30);
    expect(placed.freshAt(0)).toBe(30);
  });

  it('is thinned and ends after 20 s', () => {
    const history = new PoseHistory();
    for (let i = 0; i < 3000; ++i) history.add(frame(i * 0.01, i), i * 10);
    expect(history.past.length).toBeGreaterThan(95);
    expect(history.past.length).toBeLessThan(105);
  });
});

it('shows a step of a run that is held at once, however long the person thought about it', () => {
  const history = new PoseHistory();
  const placed = new Placed();
  for (let i = 0; i <= 10; ++i) history.add(frame(0.03 * i, i), 33 * i);
  for (let step = 1; step <= 6; ++step) {
    const now = 330 + 900 * step;
    history.add(frame(0.3 + 0.01 * step, 10 + step), now, true);
    history.interpolate(now, placed);
    expect(placed.x[0]).toBe(10 + step);
    expect(history.moving(now)).toBe(false);
  }
  // When it goes on, pictures are as far behind as they were before.
  for (let i = 1; i <= 10; ++i) history.add(frame(0.36 + 0.03 * i, 16 + i), 6000 + 33 * i);
  history.interpolate(6330, placed);
  expect(placed.x[0]).toBeGreaterThan(24.5);
});
