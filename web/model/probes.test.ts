// SPDX-License-Identifier: Apache-2.0
import {expect, it} from 'vitest';
import type {ProbeRequest, Sensor} from '../protocol/messages';
import {Probes} from './probes';

const asked = (driver: string): ProbeRequest => ({
  slot: 0,
  name: 'p',
  driver,
  mount: [0, 0, 0],
  z: 0,
  params: {},
});
const sensor = (name: string): Sensor => ({
  name,
  kind: 'ranges',
  origin: 'virtual',
  driver: name,
  mount: [0, 0, 0],
  z: 0,
  period_s: 0.1,
  fields: [{name: 'range_m', label: 'range', unit: 'm', format: 'float32'}],
});

it('numbers what the page tries, and knows the sensor behind a number', () => {
  const probes = new Probes();
  const [one, two] = [{}, {}];
  expect(probes.ask(one, asked('virtual_laser'))).toBe(true);
  expect(probes.ask(one, asked('virtual_laser'))).toBe(false);
  probes.ask(two, asked('virtual_sonar'));
  const {request, probes: sent} = probes.next();
  expect(sent.map(({driver}) => driver)).toEqual(['virtual_laser', 'virtual_sonar']);
  probes.take({
    type: 'probes',
    request,
    probes: [
      {slot: 0, sensor: sensor('a'), block: '-'},
      {slot: 0, error: 'no'},
    ],
  });
  expect(probes.indexOf(two)).toBe(0xf001);
  expect(probes.sensor(probes.indexOf(one))?.name).toBe('a');
  expect(probes.of(two)?.error).toBe('no');
});

it('leaves answers to older requests out', () => {
  const probes = new Probes();
  const owner = {};
  probes.ask(owner, asked('virtual_laser'));
  const old = probes.next().request;
  probes.next();
  probes.take({type: 'probes', request: old, probes: [{slot: 0, error: 'old'}]});
  expect(probes.of(owner)).toBeNull();
});
