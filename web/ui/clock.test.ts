// SPDX-License-Identifier: Apache-2.0
import {expect, it} from 'vitest';
import {bigClock, clockText, shortClock, tickClock} from './clock';

it('minutes become hours', () => {
  expect([0, 17.5, 59.999, 3599.99, 3723, 100_000].map(bigClock)).toEqual([
    '00:00.00',
    '00:17.50',
    '01:00.00',
    '59:59.99',
    '1:02:03',
    '27:46:40',
  ]);
  expect([17.5, 3723.9].map(shortClock)).toEqual(['00:17', '1:02:03']);
  expect([0, 30, 90, 7200].map(tickClock)).toEqual(['0', '30 s', '1:30', '2:00:00']);
  expect(clockText(3723)).toBe('1:02:03');
});
