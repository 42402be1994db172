// SPDX-License-Identifier: Apache-2.0
import {describe, expect, it} from 'vitest';
import type {Reading} from '../../protocol/frames';
import type {Sensor} from '../../protocol/messages';
import {nearestRay} from './nearest';
import {placePolar, ringStep} from './polar_plot';

describe('rings of the polar plot', () => {
  it('are at round numbers', () => {
    expect(ringStep(1, 120)).toBe(0.25);
    expect(ringStep(4, 120)).toBe(1);
    expect(ringStep(8, 120)).toBe(2);
    expect(ringStep(30, 200)).toBe(5);
  });

  it('are fewer in a small plot, so that their numbers do not touch', () => {
    expect(ringStep(4, 45)).toBe(2);
    expect(ringStep(30, 60)).toBe(20);
    for (const max of [0.5, 1, 4, 8, 30, 100]) {
      for (const radius of [22, 45, 90, 200])
        expect((ringStep(max, radius) / max) * radius).toBeGreaterThanOrEqual(22);
    }
  });
});

it('a small plot has no room for texts, and reaches close to the edges of its canvas', () => {
  for (const half of [0.5, Math.PI / 2, 2, Math.PI]) {
    const [small, large] = [true, false].map((which) => placePolar(150, 112, half, which));
    expect(small.radius).toBeGreaterThan(large.radius);
    expect(small.oy - small.radius).toBeGreaterThanOrEqual(0);
    expect(small.oy + Math.max(0, -Math.cos(half)) * small.radius).toBeLessThanOrEqual(112);
    expect(small.ox - Math.sin(Math.min(half, Math.PI / 2)) * small.radius).toBeGreaterThanOrEqual(
      0,
    );
  }
});

it('the nearest ray is the shortest that came back', () => {
  const sensor = {range: [0, 4]} as Sensor;
  const reading = (...values: number[]) =>
    ({rows: values.length, fields: 1, values: Float32Array.from(values)}) as Reading;
  expect(nearestRay(sensor, reading(3, 1, 2))).toBe(1);
  expect(nearestRay(sensor, reading(4, 4, Infinity))).toBeNull();
  expect(nearestRay(sensor, reading())).toBeNull();
});
