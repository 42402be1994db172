// SPDX-License-Identifier: Apache-2.0
import type {Body, Point, Shape} from '../../../protocol/messages';

/** Between a robot and what it stands beside. */
const kGap_m = 0.05;
const kStep_m = 0.04;
const kDirections = 64;
/** Farther away is another place. */
const kFarthest_m = 3;

/** The point nearest to `goal` where a disc of this radius is clear of all bodies; null: none
 * within 3 m. `from`: of points that are as near, the one nearest to it, since a robot comes from
 * there. Bodies above or below the robot, from `z[0]` to `z[1]`, are no obstacle. */
export function nearestFree(
  bodies: Iterable<Body>,
  goal: Point,
  radius_m: number,
  z: readonly [number, number],
  from: Point,
): Point | null {
  const solid = [...bodies].map((body) => ({
    ...body,
    shapes: body.shapes.filter((shape) => shape.z[0] < z[1] && shape.z[1] > z[0]),
  }));
  const clear = (point: Point) =>
    solid.every((body) => distanceTo(body, point) >= radius_m + kGap_m);
  if (clear(goal)) return goal;
  for (let r = kStep_m; r <= kFarthest_m; r += kStep_m) {
    const found = around(goal, r).filter(clear);
    if (found.length > 0)
      return found.reduce((best, point) =>
        distance(point, from) < distance(best, from) ? point : best,
      );
  }
  return null;
}

function around([x, y]: Point, r: number): Point[] {
  return Array.from(
    {length: kDirections},
    (_, i): Point => [
      x + r * Math.cos((2 * Math.PI * i) / kDirections),
      y + r * Math.sin((2 * Math.PI * i) / kDirections),
    ],
  );
}

function distance(a: Point, b: Point): number {
  return Math.hypot(a[0] - b[0], a[1] - b[1]);
}

/** From the outline of a body; 0 inside. */
function distanceTo(
  {pose: [x, y, yaw], shapes}: Pick<Body, 'pose' | 'shapes'>,
  point: Point,
): number {
  const [dx, dy, c, s] = [point[0] - x, point[1] - y, Math.cos(yaw), Math.sin(yaw)];
  const here: Point = [c * dx + s * dy, c * dy - s * dx];
  return Math.min(...shapes.map((shape) => distanceToShape(shape, here)));
}

function distanceToShape({disc, polygon}: Shape, point: Point): number {
  if (disc !== undefined)
    return Math.max(0, Math.hypot(point[0] - disc[0], point[1] - disc[1]) - disc[2]);
  if (polygon === undefined) return Infinity;
  let inside = false;
  let nearest = Infinity;
  polygon.forEach((a, i) => {
    const b = polygon[(i + 1) % polygon.length];
    if (
      a[1] > point[1] !== b[1] > point[1] &&
      point[0] < ((b[0] - a[0]) * (point[1] - a[1])) / (b[1] - a[1]) + a[0]
    )
      inside = !inside;
    const [ex, ey] = [b[0] - a[0], b[1] - a[1]];
    const along = Math.min(
      1,
      Math.max(0, ((point[0] - a[0]) * ex + (point[1] - a[1]) * ey) / (ex * ex + ey * ey || 1)),
    );
    nearest = Math.min(
      nearest,
      Math.hypot(point[0] - a[0] - along * ex, point[1] - a[1] - along * ey),
    );
  });
  return inside ? 0 : nearest;
}
