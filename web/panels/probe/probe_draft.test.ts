// SPDX-License-Identifier: Apache-2.0
import {expect, it} from 'vitest';
import type {Sensor, VirtualSensor} from '../../protocol/messages';
import {ProbeDraft} from './probe_draft';

const rays = {
  key: 'rays',
  kind: 'integer' as const,
  unit: '',
  doc: '',
  range: [1, 1000] as [number, number],
  value: 180,
};
const zones = {key: 'zones_m', kind: 'numbers' as const, unit: 'm', doc: ''};
const laser: VirtualSensor = {
  name: 'virtual_laser',
  summary: '',
  kind: 'ranges',
  parameters: [rays, zones],
};
const sensor = (name: string) => ({name}) as Sensor;

it('says only what differs from the defaults, under a name that the robot has not', () => {
  const draft = new ProbeDraft();
  expect(draft.request(2, {sensors: []}, laser)).toEqual({
    slot: 2,
    name: 'virtual_laser',
    driver: 'virtual_laser',
    mount: [0, 0, 0],
    z: 0.1,
    params: {},
  });
  draft.set(laser, rays, 3);
  draft.set(laser, zones, [1, 2]);
  draft.mount.yaw_deg = 90;
  const request = draft.request(
    0,
    {sensors: [sensor('virtual_laser'), sensor('virtual_laser_2')]},
    laser,
  );
  expect(request).toMatchObject({name: 'virtual_laser_3', params: {rays: 3, zones_m: [1, 2]}});
  expect(request.mount[2]).toBeCloseTo(Math.PI / 2);
  draft.set(laser, rays, 180);
  draft.set(laser, zones, []);
  expect(draft.request(0, {sensors: []}, laser).params).toEqual({});
});
