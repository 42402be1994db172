// SPDX-License-Identifier: Apache-2.0
import {expect, it} from 'vitest';
import {addPrism, outlineOf, topOf, type Solid} from './prism';

it('a box has two triangles for each side and two on top, and twelve edges', () => {
  const solid: Solid = {faces: [], edges: []};
  addPrism(
    solid,
    {
      polygon: [
        [0, 0],
        [2, 0],
        [2, 1],
        [0, 1],
      ],
      z: [0, 0.5],
    },
    8,
    [10, 0, 0],
  );
  expect(solid.faces.length / 9).toBe(4 * 2 + 2);
  expect(solid.edges.length / 6).toBe(12);
  expect(Math.min(...solid.faces.filter((_, i) => i % 3 === 0))).toBe(10);
});

it('an outline goes against the clock whichever way it was given', () => {
  expect(
    outlineOf(
      {
        polygon: [
          [0, 0],
          [0, 1],
          [1, 0],
        ],
        z: [0, 1],
      },
      8,
    ),
  ).toEqual([
    [1, 0],
    [0, 1],
    [0, 0],
  ]);
});

it('the top is the highest of all shapes', () => {
  expect(
    topOf([
      {disc: [0, 0, 1], z: [0, 0.1]},
      {disc: [0, 0, 0.1], z: [0.1, 0.6]},
    ]),
  ).toBe(0.6);
});
