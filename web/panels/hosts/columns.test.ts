// SPDX-License-Identifier: Apache-2.0
import {expect, it} from 'vitest';
import type {Host} from '../../protocol/messages';
import {clockText, kColumns, matches, missedText} from './columns';

const kHost: Host = {
  name: 'host-1',
  machine: 'lab-2',
  state: 'late',
  real: 1,
  simulated: 2,
  step: 10,
  steps_per_s: 100,
  delay_s: 0.000278,
  cpu: 0.47,
  lost: 2,
  age_s: 0.01,
  trip_s: 0.0004,
  clock_s: -0.0031,
  clock_bound_s: 0.0001,
  refused: 0,
  missed_pct: 12.4,
  late_phase: 'drivers',
  memory_mb: 84.2,
  pid: 4711,
};
const shown = (host: Host) =>
  Object.fromEntries(kColumns.map((column) => [column.heading, column.text(host)]));

it('has what rave top shows', () => {
  expect(shown(kHost)).toEqual({
    Age: '10 ms',
    Delay: '278 µs',
    Trip: '400 µs',
    Clock: '−3.10±0.10 ms',
    CPU: '47 %',
    Lost: '2',
    Refused: '0',
    Late: '12 % drivers',
    Memory: '84 MB',
    PID: '4711',
  });
});

it('leaves empty what is not known', () => {
  const {
    age_s,
    trip_s,
    clock_s,
    clock_bound_s,
    refused,
    missed_pct,
    late_phase,
    memory_mb,
    pid,
    ...least
  } = kHost;
  expect(
    Object.values(shown({...least, delay_s: null, cpu: null})).filter((text) => text !== ''),
  ).toEqual(['2']);
});

it('says what deserves a look', () => {
  const tones = Object.fromEntries(
    kColumns.map((column) => [column.heading, column.tone?.(kHost)]),
  );
  expect(tones).toMatchObject({Lost: 'care', Refused: 'zero', Late: 'care'});
  expect(missedText({...kHost, missed_pct: 1.25, late_phase: undefined})).toBe('1.3 %');
});

it('the unit of a clock is that of the larger part', () => {
  expect(clockText(2, 0.1)).toBe('+2.00±0.10 s');
  expect(clockText(0.00002, 0.0000051)).toBe('+20.00±5.10 µs');
  expect(clockText(0.1, undefined)).toBe('');
});

it('filters by all words', () => {
  expect(matches(kHost, 'LAB late')).toBe(true);
  expect(matches(kHost, 'lab here')).toBe(false);
  expect(matches(kHost, '')).toBe(true);
});
