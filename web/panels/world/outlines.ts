// SPDX-License-Identifier: Apache-2.0
import type {Pose, Shape} from '../../protocol/messages';

/** Radius about the origin that holds all shapes, metres. */
export function radiusOf(shapes: readonly Shape[]): number {
  let radius = 0;
  for (const shape of shapes) {
    if (shape.disc)
      radius = Math.max(radius, Math.hypot(shape.disc[0], shape.disc[1]) + shape.disc[2]);
    for (const [x, y] of shape.polygon ?? []) radius = Math.max(radius, Math.hypot(x, y));
  }
  return radius;
}

/** Middle and half lengths along x and y of the box that holds a body, metres in the world. Files
 * may place a body by a corner, so its pose need not be inside. */
export function boxOf({pose, shapes}: {pose: Pose; shapes: readonly Shape[]}): {
  x: number;
  y: number;
  hx: number;
  hy: number;
} {
  let [x0, y0, x1, y1] = [Infinity, Infinity, -Infinity, -Infinity];
  const [c, s] = [Math.cos(pose[2]), Math.sin(pose[2])];
  const add = ([x, y]: readonly [number, number], r = 0) => {
    const [wx, wy] = [pose[0] + c * x - s * y, pose[1] + s * x + c * y];
    [x0, y0, x1, y1] = [
      Math.min(x0, wx - r),
      Math.min(y0, wy - r),
      Math.max(x1, wx + r),
      Math.max(y1, wy + r),
    ];
  };
  for (const {disc, polygon} of shapes) {
    if (disc) add([disc[0], disc[1]], disc[2]);
    for (const corner of polygon ?? []) add(corner);
  }
  if (x0 > x1) add([0, 0]);
  return {x: (x0 + x1) / 2, y: (y0 + y1) / 2, hx: (x1 - x0) / 2, hy: (y1 - y0) / 2};
}

/** Of a body of several prisms the ones that show from above: the widest at each place come
 * last. */
export function outlinePath(shapes: readonly Shape[]): Path2D {
  const path = new Path2D();
  for (const shape of shapes) addShape(path, shape, [0, 0, 0]);
  return path;
}

/** Adds a shape that stands at `pose` to a path, metres. */
export function addShape(path: Path2D, shape: Shape, pose: Pose): void {
  const c = Math.cos(pose[2]);
  const s = Math.sin(pose[2]);
  const at = (x: number, y: number): [number, number] => [
    pose[0] + c * x - s * y,
    pose[1] + s * x + c * y,
  ];
  if (shape.disc) {
    const [x, y] = at(shape.disc[0], shape.disc[1]);
    path.moveTo(x + shape.disc[2], y);
    path.arc(x, y, shape.disc[2], 0, 2 * Math.PI);
  }
  shape.polygon?.forEach(([x, y], i) => {
    const [wx, wy] = at(x, y);
    if (i === 0) path.moveTo(wx, wy);
    else path.lineTo(wx, wy);
  });
  if (shape.polygon) path.closePath();
}

/** Whether all shapes are discs about one centre: then a heading must be drawn to be seen. */
export function isDisc(shapes: readonly Shape[]): boolean {
  return shapes.length > 0 && shapes.every((shape) => shape.disc !== undefined);
}
