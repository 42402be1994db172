// SPDX-License-Identifier: Apache-2.0
import type {Pose, Shape} from '../../../protocol/messages';

/** Triangles and edges of upright prisms, as numbers. Metres. */
export interface Solid {
  /** Three corners of three numbers for each triangle. */
  faces: number[];
  /** Two ends of three numbers for each edge. */
  edges: number[];
}

/** Corners of the outline of a shape, against the clock. */
export function outlineOf(shape: Shape, sides: number): [number, number][] {
  if (shape.disc) {
    const [x, y, r] = shape.disc;
    return Array.from({length: sides}, (_, i) => {
      const a = (2 * Math.PI * i) / sides;
      return [x + r * Math.cos(a), y + r * Math.sin(a)];
    });
  }
  const polygon = shape.polygon ?? [];
  let area = 0;
  polygon.forEach(([x, y], i) => {
    const [nx, ny] = polygon[(i + 1) % polygon.length];
    area += x * ny - nx * y;
  });
  return area >= 0 ? polygon : [...polygon].reverse();
}

/** Adds a prism that stands at `pose`. Edges of discs are their rims and four lines between
 * them. */
export function addPrism(solid: Solid, shape: Shape, sides: number, pose: Pose = [0, 0, 0]): void {
  const c = Math.cos(pose[2]);
  const s = Math.sin(pose[2]);
  const rim = outlineOf(shape, sides).map(([x, y]): [number, number] => [
    pose[0] + c * x - s * y,
    pose[1] + s * x + c * y,
  ]);
  const [low, high] = shape.z;
  const every = shape.disc ? Math.max(1, Math.floor(sides / 4)) : 1;
  for (let i = 0; i < rim.length; ++i) {
    const [ax, ay] = rim[i];
    const [bx, by] = rim[(i + 1) % rim.length];
    solid.faces.push(
      ax,
      ay,
      low,
      bx,
      by,
      low,
      bx,
      by,
      high,
      ax,
      ay,
      low,
      bx,
      by,
      high,
      ax,
      ay,
      high,
    );
    if (i > 0 && i < rim.length - 1)
      solid.faces.push(rim[0][0], rim[0][1], high, ax, ay, high, bx, by, high);
    solid.edges.push(ax, ay, low, bx, by, low, ax, ay, high, bx, by, high);
    if (i % every === 0) solid.edges.push(ax, ay, low, ax, ay, high);
  }
}

/** The highest point of shapes. */
export function topOf(shapes: readonly Shape[]): number {
  return shapes.reduce((top, shape) => Math.max(top, shape.z[1]), 0);
}
