// SPDX-License-Identifier: Apache-2.0
import type {Point} from '../../../protocol/messages';

export type OutlineKind = 'box' | 'disc' | 'polygon';

/** An outline about its pose: a disc or a polygon. */
export interface Outline {
  pose: [number, number, number];
  radius?: number;
  polygon?: Point[];
}

/** Smaller things are slips of the hand. */
const kLeast_m = 0.04;
/** Points of a path that a person draws. */
const kMostPoints = 400;
const kThin_m = 0.08;

/** What was drawn between two corners, from the middle to the rim, or from corner to corner; null:
 * too small. */
export function outlineOf(kind: OutlineKind, points: readonly Point[]): Outline | null {
  if (points.length < 2) return null;
  const [a, b] = points;
  if (kind === 'disc') {
    const radius = Math.hypot(b[0] - a[0], b[1] - a[1]);
    return radius < kLeast_m ? null : {pose: [a[0], a[1], 0], radius};
  }
  if (kind === 'box') {
    const [w, h] = [Math.abs(b[0] - a[0]) / 2, Math.abs(b[1] - a[1]) / 2];
    if (Math.min(w, h) < kLeast_m / 2) return null;
    return {
      pose: [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, 0],
      polygon: [
        [-w, -h],
        [w, -h],
        [w, h],
        [-w, h],
      ],
    };
  }
  if (points.length < 3) return null;
  const area = signedArea(points);
  if (Math.abs(area) < kLeast_m * kLeast_m) return null;
  const cx = points.reduce((sum, [x]) => sum + x, 0) / points.length;
  const cy = points.reduce((sum, [, y]) => sum + y, 0) / points.length;
  const polygon = points.map(([x, y]): Point => [x - cx, y - cy]);
  return {pose: [cx, cy, 0], polygon: area > 0 ? polygon : polygon.reverse()};
}

function signedArea(points: readonly Point[]): number {
  return points.reduce((sum, [x, y], i) => {
    const [nx, ny] = points[(i + 1) % points.length];
    return sum + (x * ny - nx * y) / 2;
  }, 0);
}

export function outlineText({radius, polygon}: Outline): string {
  if (radius !== undefined) return `disc, radius ${radius.toFixed(2)} m`;
  if (polygon?.length !== 4) return `${polygon?.length ?? 0} corners`;
  const [width, height] = [polygon[1][0] - polygon[0][0], polygon[2][1] - polygon[1][1]];
  return `${width.toFixed(2)} x ${height.toFixed(2)} m`;
}

/** Without points that are nearer to the one before than a hand can mean. */
export function thinned(points: readonly Point[]): Point[] {
  const kept: Point[] = [];
  for (const point of points) {
    const last = kept[kept.length - 1];
    if (last === undefined || Math.hypot(point[0] - last[0], point[1] - last[1]) >= kThin_m)
      kept.push(point);
  }
  return kept.slice(0, kMostPoints);
}

export function lengthOf(points: readonly Point[]): number {
  let length = 0;
  for (let i = 1; i < points.length; ++i)
    length += Math.hypot(points[i][0] - points[i - 1][0], points[i][1] - points[i - 1][1]);
  return length;
}
