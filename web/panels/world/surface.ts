// SPDX-License-Identifier: Apache-2.0
import type {Placed} from '../../model/pose_history';
import type {Body, Robot, Shape} from '../../protocol/messages';
import type {Palette} from '../../panel_api';
import {radiusOf} from './outlines';
import type {Mark} from './scan_layer';

/** A point of a reading may lie so far beside the body that it met: noise and pictures between
 * steps. */
const kNear_m = 0.12;
const kCell_m = 1;
const kReachStep_m = 4;

/** What a point in the world belongs to. */
export interface Met {
  mark: Mark;
  token: string;
  name: string;
}

interface Thing {
  radius: number;
  shapes: readonly Shape[];
  met: Met;
}

/** All bodies and robots, findable by place. Made anew when bodies change; robots move with
 * `placed`. */
export class Surface {
  readonly cells = new Map<string, {body: Body; thing: Thing}[]>();
  readonly robots: Thing[];

  constructor(bodies: Iterable<Body>, robots: readonly Robot[], palette: Palette) {
    for (const body of bodies) {
      const thing = {radius: radiusOf(body.shapes), shapes: body.shapes, met: metOf(body)};
      for (const key of cellsOf(body.pose[0], body.pose[1], thing.radius + kNear_m)) {
        const cell = this.cells.get(key);
        if (cell === undefined) this.cells.set(key, [{body, thing}]);
        else cell.push({body, thing});
      }
    }
    this.robots = robots.map((robot, slot) => ({
      radius: radiusOf(robot.shapes),
      shapes: robot.shapes,
      met: {
        mark: robot.kind === 'real' ? 'disc' : 'diamond',
        token: `${palette.hueName(slot)}-ink`,
        name: robot.name,
      },
    }));
  }

  placed: Placed | null = null;
  private readonly near = new Map<number, {time_s: number; reach: number; slots: number[]}>();

  /** Robots within `reach` of another one; found once for a picture, since a scan asks for each of
   * its rays. */
  robotsNear(owner: number, reach: number): readonly number[] {
    const {placed} = this;
    if (placed === null || placed.count !== this.robots.length || owner >= placed.count) return [];
    const known = this.near.get(owner);
    if (known !== undefined && known.time_s === placed.time_s && known.reach >= reach)
      return known.slots;
    const slots: number[] = [];
    const [x, y] = [placed.x[owner], placed.y[owner]];
    for (let slot = 0; slot < placed.count; ++slot) {
      const limit = reach + this.robots[slot].radius + kNear_m;
      const [dx, dy] = [placed.x[slot] - x, placed.y[slot] - y];
      if (dx * dx + dy * dy < limit * limit && slot !== owner && (placed.flags[slot] & 1) !== 0)
        slots.push(slot);
    }
    this.near.set(owner, {time_s: placed.time_s, reach, slots});
    return slots;
  }
}

function metOf(body: Body): Met {
  if (body.kind === 'virtual') return {mark: 'square', token: 'virtual-ink', name: body.name};
  return {mark: 'disc', token: body.kind === 'wall' ? 'wall-ink' : 'landmark-ink', name: body.name};
}

function* cellsOf(x: number, y: number, radius: number): Generator<string> {
  for (let i = Math.floor((x - radius) / kCell_m); i <= Math.floor((x + radius) / kCell_m); ++i) {
    for (let j = Math.floor((y - radius) / kCell_m); j <= Math.floor((y + radius) / kCell_m); ++j)
      yield `${i},${j}`;
  }
}

/** The body whose surface is nearest to a point, `owner` left out; null if none is near. */
export function pointSurface(surface: Surface, x: number, y: number, owner: number): Met | null {
  let best = kNear_m;
  let met: Met | null = null;
  const look = (thing: Thing, bx: number, by: number, yaw: number) => {
    if (Math.hypot(x - bx, y - by) > thing.radius + kNear_m) return;
    const c = Math.cos(yaw);
    const s = Math.sin(yaw);
    const lx = c * (x - bx) + s * (y - by);
    const ly = -s * (x - bx) + c * (y - by);
    for (const shape of thing.shapes) {
      const d = distanceTo(shape, lx, ly);
      if (d < best) {
        best = d;
        met = thing.met;
      }
    }
  };
  for (const {body, thing} of surface.cells.get(
    `${Math.floor(x / kCell_m)},${Math.floor(y / kCell_m)}`,
  ) ?? []) {
    look(thing, body.pose[0], body.pose[1], body.pose[2]);
  }
  const {placed} = surface;
  if (placed !== null && owner < placed.count) {
    const reach =
      Math.ceil(Math.hypot(x - placed.x[owner], y - placed.y[owner]) / kReachStep_m) * kReachStep_m;
    for (const slot of surface.robotsNear(owner, reach))
      look(surface.robots[slot], placed.x[slot], placed.y[slot], placed.yaw[slot]);
  }
  return met;
}

/** From a point to the rim of a shape, metres. */
function distanceTo(shape: Shape, x: number, y: number): number {
  if (shape.disc) return Math.abs(Math.hypot(x - shape.disc[0], y - shape.disc[1]) - shape.disc[2]);
  const polygon = shape.polygon ?? [];
  let least = Infinity;
  for (let i = 0; i < polygon.length; ++i) {
    const [ax, ay] = polygon[i];
    const [bx, by] = polygon[(i + 1) % polygon.length];
    const [ex, ey] = [bx - ax, by - ay];
    const along = Math.min(
      Math.max(((x - ax) * ex + (y - ay) * ey) / (ex * ex + ey * ey || 1), 0),
      1,
    );
    least = Math.min(least, Math.hypot(x - ax - along * ex, y - ay - along * ey));
  }
  return least;
}
