// SPDX-License-Identifier: Apache-2.0
import {expect, it} from 'vitest';
import type {Host} from '../../protocol/messages';
import {Rates, shortTime} from './rates';

const kHost: Host = {
  name: 'host-1',
  machine: 'lab',
  state: 'here',
  real: 1,
  simulated: 2,
  step: 10,
  steps_per_s: 100,
  delay_s: null,
  cpu: null,
  lost: 0,
};

it('times are short', () => {
  expect(shortTime(0.000278)).toBe('278 µs');
  expect(shortTime(0.0041)).toBe('4.1 ms');
  expect(shortTime(2.93)).toBe('2.9 s');
});

it('the newest rate is at the right, the highest at the top', () => {
  const rates = new Rates();
  rates.add([kHost]);
  rates.add([{...kHost, steps_per_s: 50}]);
  const points = rates.points('host-1', 40, 12).split(' ');
  expect(points).toHaveLength(2);
  expect(points[1]).toBe('40.0,6.0');
  expect(points[0].endsWith(',1.0')).toBe(true);
});
