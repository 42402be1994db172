// SPDX-License-Identifier: Apache-2.0
import {expect, it} from 'vitest';
import type {Palette} from '../../panel_api';
import type {Reading} from '../../protocol/frames';
import type {Field, Robot, Sensor} from '../../protocol/messages';
import {sightingsOf} from '../../model/sightings';
import {drawSightingsPlot, pairsOf} from './sightings_plot';
import {twinOf} from './twin';

function reading(...rows: [number, number, number][]): Reading {
  return {
    slot: 0,
    sensor: 0,
    part: 0,
    past: false,
    stamp_s: 0,
    time_s: 0,
    rows: rows.length,
    fields: 3,
    values: Float32Array.from(rows.flat()),
  };
}

const fields: Field[] = [
  {name: 'code', label: 'code', unit: '', format: 'int32'},
  {name: 'range_m', label: 'range', unit: 'm', format: 'float32'},
  {name: 'bearing_rad', label: 'bearing', unit: 'rad', format: 'float32'},
];
const camera: Sensor = {
  name: 'camera',
  kind: 'sightings',
  list: true,
  origin: 'real',
  driver: '',
  mount: [0, 0, 0],
  z: 0,
  period_s: 0.1,
  fields,
};

it('pairs what was seen with what was expected by its code', () => {
  const saw = reading([7, 1, 0], [9, 2, 0.5]);
  expect(sightingsOf(camera, saw)[1]).toEqual({code: 9, range_m: 2, bearing_rad: 0.5});
  expect(pairsOf(camera, saw, reading([9, 2.1, 0.5], [11, 3, 0]))).toBe(1);
  expect(pairsOf(camera, null, saw)).toBe(0);
});

it('finds the twin of a camera, both ways', () => {
  const sensor = (name: string, kind: Sensor['kind'], origin: Sensor['origin']): Sensor => ({
    name,
    kind,
    origin,
    driver: '',
    mount: [0, 0, 0],
    z: 0,
    period_s: 0,
    fields: [],
  });
  const robot: Robot = {
    name: 'a',
    team: '',
    kind: 'real',
    word: '',
    recorded: false,
    program: '',
    drivers: [],
    shapes: [],
    sensors: [
      sensor('laser', 'ranges', 'virtual'),
      sensor('camera', 'sightings', 'real'),
      sensor('twin', 'sightings', 'virtual'),
    ],
  };
  expect([0, 1, 2].map((index) => twinOf(robot, index))).toEqual([null, 2, 1]);
});

it('draws what was seen long ago hollow and faint, and what is current full', () => {
  const palette = {token: (name: string) => name} as unknown as Palette;
  const marks = (now_s: number) => {
    const drawn: [string, number][] = [];
    let arc = false;
    const ctx = new Proxy({globalAlpha: 1} as Record<string, unknown>, {
      get: (known, name) => {
        const does = () => {
          if (name === 'beginPath') arc = false;
          if (name === 'arc') arc = true;
          if (arc && (name === 'fill' || name === 'stroke'))
            drawn.push([name, known['globalAlpha'] as number]);
          return {width: 20};
        };
        return name in known ? known[name as string] : does;
      },
    });
    drawSightingsPlot(
      ctx as unknown as CanvasRenderingContext2D,
      300,
      200,
      camera,
      reading([7, 1, 0]),
      null,
      () => ({name: 'a', colour: 'red'}),
      palette,
      now_s,
    );
    return drawn;
  };
  expect(marks(0.5)).toEqual([['fill', 1]]);
  const [[how, strength]] = marks(3);
  expect(how).toBe('stroke');
  expect(strength).toBeLessThan(0.7);
  expect(marks(60)).toEqual([['stroke', 0.25]]);
});
