// SPDX-License-Identifier: Apache-2.0
import {expect, it} from 'vitest';
import {isCurrent, strengthOf} from './reading_age';

it('is full while a reading is current: a second, or three periods of a slow sensor', () => {
  expect([0, 1, 1.01].map((age_s) => isCurrent(age_s, 0.1))).toEqual([true, true, false]);
  expect([3, 5.9, 6.1].map((age_s) => isCurrent(age_s, 2))).toEqual([true, true, false]);
  expect(strengthOf(0.9, 0)).toBe(1);
});

it('drops when it is not, falls with the age and never vanishes', () => {
  const strengths = [1.1, 2, 3, 4, 60].map((age_s) => strengthOf(age_s, 0.1));
  expect(strengths[0]).toBeLessThan(0.75);
  strengths.forEach(
    (strength, i) => i > 0 && expect(strength).toBeLessThanOrEqual(strengths[i - 1]),
  );
  expect(strengths[4]).toBe(0.25);
});
