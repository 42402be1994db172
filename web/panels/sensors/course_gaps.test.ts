// SPDX-License-Identifier: Apache-2.0
import {expect, it} from 'vitest';
import {gapsOf, gapsText} from './course_gaps';

/** Times with this spacing. */
const every = (spacing: number, from: number, to: number) =>
  Array.from({length: Math.round((to - from) / spacing) + 1}, (_, i) => from + i * spacing);

it('what was before a panel showed the sensor is a gap, and so is the time while none did', () => {
  expect(gapsOf(every(0.5, -4, 0), -15, 0.5)).toEqual([[-15, -4]]);
  expect(gapsOf([...every(0.5, -15, -9), ...every(0.5, -2, 0)], -15, 0.5)).toEqual([[-9, -2]]);
  expect(gapsOf(every(0.5, -15, -5), -15, 0.5)).toEqual([[-5, 0]]);
  expect(gapsOf([], -15, 0.5)).toEqual([[-15, 0]]);
});

it('before the begin of the run nothing is missing', () => {
  expect(gapsOf(every(0.5, -4, 0), -4, 0.5)).toEqual([]);
  expect(gapsOf([], 0, 0.5)).toEqual([]);
});

it('a slow sensor has no gaps, and neither has a run that goes fast', () => {
  expect(gapsOf(every(2.5, -15, 0), -15, 2.5)).toEqual([]);
  expect(gapsOf(every(3, -15, 0), -15, 0.1)).toEqual([]);
});

it('says when', () => {
  expect(
    gapsText([
      [-15, -4.2],
      [-2, 0],
    ]),
  ).toBe('15 to 4 s ago, 2 to 0 s ago');
});
