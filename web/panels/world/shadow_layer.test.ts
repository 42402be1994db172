// SPDX-License-Identifier: Apache-2.0
import {expect, it} from 'vitest';
import type {Placed} from '../../model/pose_history';
import type {RunModel} from '../../model/run_model';
import {gapText, ghostsOf} from './shadow_layer';

const shadow = (more: object) => ({shadow: {running: true, offset: [0.3, -0.4, 1], ...more}});
const model = (drives: [number, object][]) => ({drives: new Map(drives)}) as unknown as RunModel;
const placed = {
  count: 3,
  x: [1, 2, 3],
  y: [0, 0, 0],
  yaw: [0, 0.5, 0],
  flags: [1, 1, 0],
} as unknown as Placed;

it('a ghost stands where its robot is told to be, and off it', () => {
  const ghosts = ghostsOf(model([[1, shadow({})]]), placed);
  expect(ghosts).toHaveLength(1);
  expect(ghosts[0]).toMatchObject({slot: 1, x: 2.3, y: -0.4, yaw: 1.5});
  expect(ghosts[0]?.gap_m).toBeCloseTo(0.5);
});

it('there is none without a comparison, of a simulated robot, or of one that is nowhere', () => {
  expect(
    ghostsOf(
      model([
        [0, shadow({offset: undefined})],
        [1, shadow({running: false})],
        [2, shadow({})],
        [7, shadow({})],
        [0, {}],
      ]),
      placed,
    ),
  ).toEqual([]);
});

it('gaps have the unit that people measure them in', () => {
  expect(gapText(0.0312)).toBe('3.1 cm');
  expect(gapText(1.254)).toBe('1.25 m');
});
