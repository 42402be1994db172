// SPDX-License-Identifier: Apache-2.0
import {expect, it} from 'vitest';
import type {Reading} from '../protocol/frames';
import {Readings} from './readings';

const reading = (sensor: number, stamp_s: number) =>
  ({
    slot: 0,
    sensor,
    part: 0,
    stamp_s,
    rows: 1,
    fields: 1,
    values: new Float32Array([stamp_s]),
  }) as Reading;

it('fills the course with what was read before the moment, which stays what it is', () => {
  const readings = new Readings();
  readings.add(reading(0, 20));
  for (const stamp_s of [19.6, 19.8, 20, 20.2]) readings.add({...reading(0, stamp_s), past: true});
  expect(readings.course(0, 0).map(({time_s}) => time_s)).toEqual([19.6, 19.8, 20]);
  expect(readings.of(0, 0)?.stamp_s).toBe(20);
  readings.add({...reading(1, 5), past: true});
  expect(readings.of(0, 1)).toBeNull();
});

it('keeps the readings of the moment that it jumps back to', () => {
  const readings = new Readings();
  readings.add(reading(0, 28));
  readings.add(reading(1, 12.4));
  readings.forgetAfter(12.5);
  expect(readings.of(0, 0)).toBeNull();
  expect(readings.course(0, 0)).toEqual([]);
  expect(readings.of(0, 1)?.stamp_s).toBe(12.4);
});
