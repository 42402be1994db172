// SPDX-License-Identifier: Apache-2.0
import type {Placed} from '../../model/pose_history';
import type {Palette} from '../../panel_api';
import {RobotFlag} from '../../protocol/frames';
import {withAlpha} from './scan_layer';

/** Drawn with Shift and a drag, from one corner to the other; pixels. */
export type SelectionBox = readonly [number, number, number, number];

/** Robots in the box. `at`: where a robot is on the screen; null: behind the eye. */
export function slotsIn(
  [ax, ay, bx, by]: SelectionBox,
  placed: Placed,
  at: (slot: number) => readonly [number, number] | null,
): number[] {
  const slots: number[] = [];
  for (let slot = 0; slot < placed.count; ++slot) {
    const place = (placed.flags[slot] & RobotFlag.known) === 0 ? null : at(slot);
    if (place === null) continue;
    const [x, y] = place;
    if (
      x >= Math.min(ax, bx) &&
      x <= Math.max(ax, bx) &&
      y >= Math.min(ay, by) &&
      y <= Math.max(ay, by)
    )
      slots.push(slot);
  }
  return slots;
}

export function drawBox(
  ctx: CanvasRenderingContext2D,
  palette: Palette,
  [x0, y0, x1, y1]: SelectionBox,
): void {
  const intent = palette.token('intent');
  ctx.strokeStyle = intent;
  ctx.lineWidth = 1;
  ctx.fillStyle = withAlpha(intent, 0.12);
  ctx.setLineDash([4, 3]);
  ctx.fillRect(x0, y0, x1 - x0, y1 - y0);
  ctx.strokeRect(x0, y0, x1 - x0, y1 - y0);
  ctx.setLineDash([]);
}
