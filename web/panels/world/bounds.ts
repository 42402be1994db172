// SPDX-License-Identifier: Apache-2.0
import type {Placed} from '../../model/pose_history';
import {RobotFlag} from '../../protocol/frames';
import type {Body} from '../../protocol/messages';
import type {Bounds} from './camera';
import {boxOf} from './outlines';

/** What is shown around the middle of the robots at least, in radii of the largest. */
const kAround = 14;
/** Walls that make the picture larger than this many times are a building, in which the robots
 * would be specks. */
const kRoom = 2;

function grow(bounds: Bounds, x: number, y: number, rx: number, ry = rx): void {
  bounds.x0 = Math.min(bounds.x0, x - rx);
  bounds.y0 = Math.min(bounds.y0, y - ry);
  bounds.x1 = Math.max(bounds.x1, x + rx);
  bounds.y1 = Math.max(bounds.y1, y + ry);
}

const none = (): Bounds => ({x0: Infinity, y0: Infinity, x1: -Infinity, y1: -Infinity});
const isNone = ({x0, x1}: Bounds) => x0 > x1;

/** What holds both; either may be missing. */
export function union(a: Bounds | null, b: Bounds | null): Bounds | null {
  if (a === null || b === null) return a ?? b;
  return {
    x0: Math.min(a.x0, b.x0),
    y0: Math.min(a.y0, b.y0),
    x1: Math.max(a.x1, b.x1),
    y1: Math.max(a.y1, b.y1),
  };
}

/** What holds these robots; null: none of them has a pose. */
export function boundsOfRobots(
  placed: Placed,
  radius: (slot: number) => number,
  slots: Iterable<number>,
): Bounds | null {
  const bounds = none();
  for (const slot of slots)
    if ((placed.flags[slot] & RobotFlag.known) !== 0)
      grow(bounds, placed.x[slot], placed.y[slot], radius(slot));
  return isNone(bounds) ? null : bounds;
}

/** What holds the bodies of a run, walls apart from the others; null: there are none. */
export interface BodyBounds {
  walls: Bounds | null;
  others: Bounds | null;
}

export function boundsOfBodies(bodies: Iterable<Body>): BodyBounds {
  const [walls, others] = [none(), none()];
  for (const body of bodies) {
    const {x, y, hx, hy} = boxOf(body);
    grow(body.kind === 'wall' ? walls : others, x, y, hx, hy);
  }
  return {walls: isNone(walls) ? null : walls, others: isNone(others) ? null : others};
}

/** What holds all robots and bodies. `every`: with all walls, otherwise with those of a room, not
 * of a building. */
export function boundsOfAll(
  placed: Placed,
  radius: (slot: number) => number,
  bodies: BodyBounds,
  every: boolean,
): Bounds | null {
  let largest = 0;
  for (let slot = 0; slot < placed.count; ++slot) largest = Math.max(largest, radius(slot));
  const robots = boundsOfRobots(placed, radius, Array(placed.count).keys());
  // One robot alone would fill the picture: what is around it belongs to it.
  if (robots !== null)
    grow(robots, (robots.x0 + robots.x1) / 2, (robots.y0 + robots.y1) / 2, kAround * largest);
  const within = union(robots, bodies.others);
  const all = union(within, bodies.walls);
  if (within === null || all === null || every) return all;
  const times = Math.max(
    (all.x1 - all.x0) / (within.x1 - within.x0),
    (all.y1 - all.y0) / (within.y1 - within.y0),
  );
  return times <= kRoom ? all : within;
}
