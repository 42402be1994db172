// SPDX-License-Identifier: Apache-2.0
import {expect, it} from 'vitest';
import {arrowsAlong} from './arrows';

it('arrows point along the line and stand about its middle', () => {
  const arrows = arrowsAlong(
    [
      [0, 0],
      [100, 0],
      [100, 100],
    ],
    60,
    20,
  );
  expect(arrows).toHaveLength(2);
  expect(arrows[0]).toEqual({x: 70, y: 0, angle: 0});
  expect(arrows[1].x).toBe(100);
  expect(arrows[1].y).toBeCloseTo(30);
  expect(arrows[1].angle).toBeCloseTo(Math.PI / 2);
});

it('a short line has none, and points upon each other do no harm', () => {
  expect(
    arrowsAlong(
      [
        [0, 0],
        [90, 0],
      ],
      60,
      20,
    ),
  ).toEqual([]);
  expect(arrowsAlong([[5, 5]], 60, 20)).toEqual([]);
  expect(arrowsAlong([], 60, 20)).toEqual([]);
  expect(
    arrowsAlong(
      [
        [0, 0],
        [0, 0],
        [120, 0],
        [120, 0],
      ],
      60,
      20,
    ),
  ).toEqual([{x: 60, y: 0, angle: 0}]);
});
