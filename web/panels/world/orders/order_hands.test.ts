// SPDX-License-Identifier: Apache-2.0
import {expect, it} from 'vitest';
import type {Body} from '../../../protocol/messages';
import {bodyAt} from './order_hands';

const box: Body = {
  id: 7,
  name: 'crate',
  kind: 'virtual',
  pose: [2, 1, Math.PI / 2],
  shapes: [
    {
      polygon: [
        [-1, -0.2],
        [1, -0.2],
        [1, 0.2],
        [-1, 0.2],
      ],
      z: [0, 1],
    },
  ],
};
const pond: Body = {
  id: 8,
  name: 'pond',
  kind: 'virtual',
  pose: [-2, 0, 0],
  shapes: [{disc: [0, 0, 0.5], z: [0, 1]}],
};
const wall: Body = {...box, id: 9, kind: 'wall'};

it('finds the virtual obstacle under a point, turned as it stands, and no wall', () => {
  expect(bodyAt([wall, box, pond], 2, 1.9)).toBe(7);
  expect(bodyAt([wall, box, pond], 2.9, 1)).toBeNull();
  expect(bodyAt([box, pond], -2.3, 0.3)).toBe(8);
  expect(bodyAt([wall], 2, 1)).toBeNull();
});
