// SPDX-License-Identifier: Apache-2.0
import {expect, it} from 'vitest';
import {Readings} from '../../model/readings';
import type {Field, Sensor} from '../../protocol/messages';
import {beamText, courseFieldsOf} from './course_fields';

const sensor = (more: Partial<Sensor>): Sensor => ({
  name: 's',
  kind: 'values',
  origin: 'real',
  driver: '',
  mount: [0, 0, 0],
  z: 0,
  period_s: 0,
  fields: [],
  ...more,
});

const kEnds: Record<string, string> = {m: '_m', rad: '_rad', 'm/s': '_mps'};
const field = (label: string, unit: string): Field => ({
  name: label + (kEnds[unit] ?? ''),
  label,
  unit,
  format: 'float32',
});

/** What each field of a sensor has been in readings of these rows. */
function courses(of: Sensor, beam: number, ...readings: number[][][]): Record<string, number[]> {
  const model = new Readings();
  readings.forEach((rows, i) =>
    model.add({
      slot: 0,
      sensor: 0,
      part: 0,
      past: false,
      stamp_s: i,
      time_s: i,
      rows: rows.length,
      fields: of.fields.length,
      values: Float32Array.from(rows.flat()),
    }),
  );
  return Object.fromEntries(
    courseFieldsOf(of, beam).map((field) => [
      `${field.label} ${field.unit}`.trim(),
      model.course(0, 0).map((point) => Math.round(100 * field.of(point)) / 100),
    ]),
  );
}

it('a camera has the course of the nearest range, its bearing, and how many it sees', () => {
  const camera = sensor({
    kind: 'sightings',
    list: true,
    fields: [field('code', ''), field('range', 'm'), field('bearing', 'rad')],
  });
  expect(
    courses(
      camera,
      0,
      [
        [7, 3, 0.1],
        [9, 2, -Math.PI / 2],
      ],
      [],
      [[7, 4, 0]],
    ),
  ).toEqual({'nearest range m': [2, NaN, 4], 'bearing °': [-90, NaN, 0], count: [2, 0, 1]});
});

it('ranges have the nearest and a chosen beam; no return is a gap', () => {
  const laser = sensor({
    kind: 'ranges',
    fields: [field('range', 'm')],
    range: [0, 5],
    bearings: [-0.5, 0, 0.5],
  });
  expect(courses(laser, 2, [[3], [1], [2]], [[5], [Infinity], [5]])).toEqual({
    'nearest m': [1, NaN],
    'beam m': [2, NaN],
  });
  expect(
    courseFieldsOf(sensor({kind: 'ranges', fields: [field('range', 'm')], bearings: [0]})).map(
      ({label}) => label,
    ),
  ).toEqual(['nearest']);
});

it('other sensors have each of their fields', () => {
  expect(
    courses(sensor({fields: [field('v', 'm/s'), field('on', '')]}), 0, [[0.5, 1]], [[0.25, 0]]),
  ).toEqual({
    'v m/s': [0.5, 0.25],
    on: [1, 0],
  });
});

it('a beam is named by its direction', () => {
  expect([0, 0.2, -1].map(beamText)).toEqual(['ahead', '11.5° left', '57.3° right']);
});
