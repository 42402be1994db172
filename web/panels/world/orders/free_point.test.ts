// SPDX-License-Identifier: Apache-2.0
import {expect, it} from 'vitest';
import type {Body, Point} from '../../../protocol/messages';
import {nearestFree} from './free_point';

const wall: Body = {
  id: 1,
  name: 'wall',
  kind: 'wall',
  pose: [2, 0, Math.PI / 2],
  shapes: [
    {
      polygon: [
        [-3, -0.2],
        [3, -0.2],
        [3, 0.2],
        [-3, 0.2],
      ],
      z: [0, 2],
    },
  ],
};
const pillar: Body = {
  id: 2,
  name: 'pillar',
  kind: 'virtual',
  pose: [0, 0, 0],
  shapes: [{disc: [0, 0, 0.5], z: [0, 1]}],
};
const z: [number, number] = [0, 0.3];

it('is before the wall, on the side of the robot, with room for its body', () => {
  const left = nearestFree([wall, pillar], [2, 0.5], 0.2, z, [-2, 0.5]) as Point;
  expect(left[0]).toBeLessThanOrEqual(2 - 0.2 - 0.25 + 1e-9);
  expect(left[0]).toBeGreaterThan(1.4);
  expect(left[1]).toBeCloseTo(0.5, 1);
  const right = nearestFree([wall], [2, 0.5], 0.2, z, [5, 0.5]) as Point;
  expect(right[0]).toBeGreaterThan(2.4);
});

it('is the goal itself where nothing is in the way', () => {
  expect(nearestFree([wall], [0, 0], 0.2, z, [1, 1])).toEqual([0, 0]);
  // Under a table there is room.
  expect(
    nearestFree(
      [{...pillar, shapes: [{disc: [0, 0, 0.5], z: [0.7, 0.8]}]}],
      [0, 0],
      0.2,
      z,
      [1, 1],
    ),
  ).toEqual([0, 0]);
  const beside = nearestFree([pillar], [0.1, 0], 0.2, z, [3, 0]) as Point;
  expect(Math.hypot(...beside)).toBeGreaterThanOrEqual(0.75 - 1e-9);
});

it('is nothing where there is no room', () => {
  expect(
    nearestFree([{...pillar, shapes: [{disc: [0, 0, 9], z: [0, 1]}]}], [0, 0], 0.2, z, [9, 9]),
  ).toBeNull();
});
