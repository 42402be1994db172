// SPDX-License-Identifier: Apache-2.0
import {expect, it} from 'vitest';
import {spanOf, ticksOf} from './course_plot';

it('a plot begins at zero, or below it where values do, and ends at a round number', () => {
  expect(spanOf(1.2, 3.4)).toEqual([0, 4]);
  expect(spanOf(-40, 12)).toEqual([-50, 50]);
  expect(spanOf(-3, -1)).toEqual([-4, 0]);
  expect(spanOf(null, null)[1]).toBeCloseTo(0.1);
});

it('ticks are round and have room for their numbers', () => {
  expect(ticksOf(0, 4, 110)).toEqual([0, 2, 4]);
  expect(ticksOf(0, 30, 60)).toEqual([0, 20]);
  expect(ticksOf(-50, 50, 150).length).toBeLessThan(7);
});
