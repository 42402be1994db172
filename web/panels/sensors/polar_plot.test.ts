// SPDX-License-Identifier: Apache-2.0
import {describe, expect, it} from 'vitest';
import {ringStep} from './polar_plot';

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
      for (const radius of [22, 45, 90, 200]) expect((ringStep(max, radius) / max) * radius).toBeGreaterThanOrEqual(22);
    }
  });
});
