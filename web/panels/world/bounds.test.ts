// SPDX-License-Identifier: Apache-2.0
import {expect, it} from 'vitest';
import {Placed} from '../../model/pose_history';
import {RobotFlag} from '../../protocol/frames';
import type {Body} from '../../protocol/messages';
import {AutoFit} from './auto_fit';
import {boundsOfAll, boundsOfBodies} from './bounds';
import type {Extent, Fitted, Stage} from './stage';

function placed(...places: [number, number][]): Placed {
  const all = new Placed();
  all.resize(places.length);
  places.forEach(([x, y], slot) => {
    all.x[slot] = x;
    all.y[slot] = y;
    all.flags[slot] = RobotFlag.known;
  });
  return all;
}

const wall = (x: number, y: number, w: number, h: number): Body =>
  ({
    id: 0,
    name: '',
    kind: 'wall',
    pose: [x, y, 0],
    shapes: [
      {
        polygon: [
          [0, 0],
          [w, 0],
          [w, h],
          [0, h],
        ],
      },
    ],
  }) as unknown as Body;
const room = (size: number) => boundsOfBodies([wall(0, 0, size, 0.1), wall(0, size, size, 0.1)]);
const radius = () => 0.1;

it('everything has its walls, whatever corner they are placed by', () => {
  const robots = placed([1, 1], [3, 2]);
  expect(boundsOfAll(robots, radius, room(40), true)).toEqual({
    x0: 0,
    y0: 0,
    x1: 40,
    y1: expect.closeTo(40.1),
  });
});

it('the walls of a room belong to its robots, those of a building do not', () => {
  const robots = placed([1, 1], [4, 3]);
  expect(boundsOfAll(robots, radius, room(5), false)).toMatchObject({x0: 0, y0: 0, x1: 5, y1: 5.1});
  expect(boundsOfAll(robots, radius, room(40), false)?.x1).toBeLessThan(5);
  expect(boundsOfAll(placed(), radius, room(40), false)?.x1).toBe(40);
});

/** A stage of 100 pixels by 100 that shows one metre per pixel, and what it was asked to fit. */
function stage(robots: Placed) {
  const fits: [boolean, Extent][] = [];
  const element = {clientWidth: 100, clientHeight: 100} as HTMLElement;
  const fake = {
    element,
    screenOf: (slot: number) => [robots.x[slot], robots.y[slot]],
    fit: (animate: boolean, what: Extent): Fitted =>
      fits.push([animate, what]) > 5 ? 'selection' : 'all',
  };
  return {stage: fake as unknown as Stage, fits};
}

it('an untouched picture follows robots that leave it; a moved one stays until asked', () => {
  const robots = placed([10, 10], [20, 90]);
  const {stage: shown, fits} = stage(robots);
  const fit = new AutoFit();
  fit.look(shown, robots, 0, true);
  fit.look(shown, robots, 1000, true);
  expect(fits).toEqual([[false, 'room']]);
  robots.y[1] = 101;
  // Not in each picture.
  fit.look(shown, robots, 1100, true);
  expect(fits.length).toBe(1);
  fit.look(shown, robots, 2000, true);
  expect(fits[1]).toEqual([true, 'more']);
  fit.move();
  fit.look(shown, robots, 3000, true);
  expect(fits.length).toBe(2);
  fit.ask(shown, false);
  fit.again();
  fit.look(shown, robots, 4000, true);
  expect(fits.slice(2)).toEqual([
    [false, 'closer'],
    [false, 'all'],
    [true, 'more'],
  ]);
  // The selection alone was asked for.
  fit.ask(shown, true);
  fit.look(shown, robots, 5000, true);
  expect(fits.length).toBe(6);
});
