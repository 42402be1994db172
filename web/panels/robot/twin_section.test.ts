// SPDX-License-Identifier: Apache-2.0
import {expect, test} from 'vitest';
import {differenceText, nextDrivers} from './twin_section';

const state = (simulated: boolean, made: number) => ({
  simulated,
  under_way: false,
  made,
  refused: 0,
  last: '',
});

test('a robot with real and simulated drivers is handed over to those that do not serve', () => {
  expect(nextDrivers(true, state(true, 0))).toBe('real');
  expect(nextDrivers(true, state(false, 1))).toBe('simulated');
});

test('two sets of one kind have the names of their places', () => {
  expect(nextDrivers(false, state(true, 0))).toBe('twin');
  expect(nextDrivers(false, state(true, 1))).toBe('first');
});

test('differences have their unit', () => {
  expect(differenceText(0.0123, 'm')).toBe('0.012 m');
  expect(differenceText(0.25, 'share')).toBe('25.0 %');
});
