// SPDX-License-Identifier: Apache-2.0
import {afterEach, beforeEach, expect, it, vi} from 'vitest';
import {SilenceWatch} from './silence';

beforeEach(() => vi.useFakeTimers());
afterEach(() => vi.useRealTimers());

/** A watch, and how often it found silence. */
function watched(): {watch: SilenceWatch; silences: () => number} {
  let count = 0;
  return {watch: new SilenceWatch(() => ++count), silences: () => count};
}

it('finds silence once, after the limit and the chance of what is waiting', () => {
  const {watch, silences} = watched();
  watch.heard(3000);
  vi.advanceTimersByTime(3400);
  expect(silences()).toBe(0);
  vi.advanceTimersByTime(200);
  expect(silences()).toBe(1);
  vi.advanceTimersByTime(60_000);
  expect(silences()).toBe(1);
});

it('finds none while messages come, however few', () => {
  const {watch, silences} = watched();
  for (let i = 0; i < 20; ++i) {
    watch.heard(3000);
    vi.advanceTimersByTime(2900);
  }
  expect(silences()).toBe(0);
  vi.advanceTimersByTime(700);
  expect(silences()).toBe(1);
});

it('takes no silence for granted before what waits was taken', () => {
  const {watch, silences} = watched();
  watch.heard(3000);
  // The page stood still; its timer runs before the message that came meanwhile.
  vi.advanceTimersByTime(3100);
  watch.heard(3000);
  vi.advanceTimersByTime(3300);
  expect(silences()).toBe(0);
});

it('obeys a shorter limit at once, and an end', () => {
  const {watch, silences} = watched();
  watch.heard(15_000);
  watch.heard(3000);
  vi.advanceTimersByTime(3600);
  expect(silences()).toBe(1);
  watch.heard(3000);
  watch.end();
  vi.advanceTimersByTime(60_000);
  expect(silences()).toBe(1);
});
