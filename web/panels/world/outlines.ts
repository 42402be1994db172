// SPDX-License-Identifier: Apache-2.0
import type {Pose, Shape} from '../../protocol/messages';

/** Radius about the origin that holds all shapes, metres. */
export function radiusOf(shapes: readonly Shape[]): number {
  let radius = 0;
  for (const shape of shapes) {
    if (shape.disc) radius = Math.max(radius, Math.hypot(shape.disc[0], shape.disc[1]) + shape.disc[2]);
    for (const [x, y] of shape.polygon ?? []) radius = Math.max(radius, Math.hypot(x, y));
  }
  return radius;
}

/** Of a body of several prisms the ones that show from above: the widest at each place come last. */
export function outlinePath(shapes: readonly Shape[]): Path2D {
  const path = new Path2D();
  for (const shape of shapes) addShape(path, shape, [0, 0, 0]);
  return path;
}

/** Adds a shape that stands at `pose` to a path, metres. */
export function addShape(path: Path2D, shape: Shape, pose: Pose): void {
  const c = Math.cos(pose[2]);
  const s = Math.sin(pose[2]);
  const at = (x: number, y: number): [number, number] => [pose[0] + c * x - s * y, pose[1] + s * x + c * y];
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
