// SPDX-License-Identifier: Apache-2.0
import {expect, it} from 'vitest';
import {lengthOf, outlineOf, thinned} from './outline';

it('makes a box between two corners, whichever was first', () => {
  expect(
    outlineOf('box', [
      [3, 4],
      [1, 1],
    ]),
  ).toEqual({
    pose: [2, 2.5, 0],
    polygon: [
      [-1, -1.5],
      [1, -1.5],
      [1, 1.5],
      [-1, 1.5],
    ],
  });
});

it('makes a disc from its middle to its rim', () => {
  expect(
    outlineOf('disc', [
      [1, 1],
      [1, 1.5],
    ]),
  ).toEqual({pose: [1, 1, 0], radius: 0.5});
});

it('gives a polygon its corners counter-clockwise', () => {
  const made = outlineOf('polygon', [
    [0, 0],
    [0, 3],
    [3, 0],
  ]);
  expect(made?.pose).toEqual([1, 1, 0]);
  expect(made?.polygon).toEqual([
    [2, -1],
    [-1, 2],
    [-1, -1],
  ]);
});

it('takes slips of the hand for nothing', () => {
  expect(
    outlineOf('box', [
      [0, 0],
      [0.01, 1],
    ]),
  ).toBeNull();
  expect(
    outlineOf('disc', [
      [0, 0],
      [0.01, 0],
    ]),
  ).toBeNull();
  expect(
    outlineOf('polygon', [
      [0, 0],
      [1, 1],
      [2, 2],
    ]),
  ).toBeNull();
});

it('thins a line that was drawn by hand', () => {
  const points = thinned(Array.from({length: 200}, (_, i): [number, number] => [i * 0.01, 0]));
  expect(points.length).toBeLessThan(30);
  expect(lengthOf(points)).toBeCloseTo(1.92, 1);
});
