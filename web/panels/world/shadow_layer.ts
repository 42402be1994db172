// SPDX-License-Identifier: Apache-2.0
import type {Placed} from '../../model/pose_history';
import type {RunModel} from '../../model/run_model';
import type {Palette, Selection} from '../../panel_api';
import {RobotFlag} from '../../protocol/frames';
import type {Camera} from './camera';
import {kFont} from './labels';
import {radiusOf} from './outlines';
import type {RobotLayer} from './robot_layer';

/** The simulated twin of a real robot, drawn where it is. */
export interface Ghost {
  slot: number;
  x: number;
  y: number;
  yaw: number;
  /** Between the origins, metres. */
  gap_m: number;
}

/** So far apart on the screen, twin and robot are joined by a line that has the gap. */
export const kApart_px = 10;

/** The shadows of robots that are real now. The server sends its offset from its robot, so it moves
 * with that. */
export function ghostsOf(model: RunModel, placed: Placed): Ghost[] {
  const ghosts: Ghost[] = [];
  for (const [slot, {shadow}] of model.drives) {
    if (shadow?.offset === undefined || !shadow.running) continue;
    if (slot >= placed.count || (placed.flags[slot] & RobotFlag.known) === 0) continue;
    const [x, y, yaw] = shadow.offset;
    ghosts.push({
      slot,
      x: placed.x[slot] + x,
      y: placed.y[slot] + y,
      yaw: placed.yaw[slot] + yaw,
      gap_m: Math.hypot(x, y),
    });
  }
  return ghosts;
}

/** Centimetres below a metre, so that no digit stands for less than what is measured. */
export function gapText(gap_m: number): string {
  return gap_m < 1 ? `${(100 * gap_m).toFixed(1)} cm` : `${gap_m.toFixed(2)} m`;
}

/** Dashed and empty, joined to its robot by a line with the gap. */
export function drawShadows(
  ctx: CanvasRenderingContext2D,
  camera: Camera,
  model: RunModel,
  selection: Selection,
  palette: Palette,
  placed: Placed,
  robots: RobotLayer,
): void {
  for (const ghost of ghostsOf(model, placed)) {
    const {ink} = palette.hue(ghost.slot);
    const [x, y] = [camera.toScreenX(ghost.x), camera.toScreenY(ghost.y)];
    const [rx, ry] = [
      camera.toScreenX(placed.x[ghost.slot]),
      camera.toScreenY(placed.y[ghost.slot]),
    ];
    const r = radiusOf(model.robots[ghost.slot].shapes) * camera.scale;
    ctx.save();
    ctx.strokeStyle = ink;
    ctx.lineWidth = 1.25;
    ctx.setLineDash([4, 3]);
    robots.strokeOutline(ctx, ghost.slot, x, y, ghost.yaw, camera.scale);
    ctx.beginPath();
    ctx.moveTo(x, y);
    ctx.lineTo(x + 0.9 * r * Math.cos(ghost.yaw), y - 0.9 * r * Math.sin(ghost.yaw));
    ctx.stroke();
    const apart = Math.hypot(x - rx, y - ry);
    ctx.setLineDash([]);
    if (apart >= kApart_px) {
      ctx.beginPath();
      ctx.moveTo(rx, ry);
      ctx.lineTo(x, y);
      ctx.stroke();
    }
    if (apart >= kApart_px || selection.has(ghost.slot))
      drawGap(
        ctx,
        gapText(ghost.gap_m),
        (x + rx) / 2,
        Math.max(y, ry) + r + 6,
        ink,
        palette.token('floor'),
      );
    ctx.restore();
  }
}

/** A measure, under a place of the screen. */
export function drawGap(
  ctx: CanvasRenderingContext2D,
  text: string,
  x: number,
  y: number,
  ink: string,
  floor: string,
): void {
  ctx.font = `500 11px ${kFont}`;
  ctx.textAlign = 'center';
  ctx.textBaseline = 'top';
  ctx.lineWidth = 3;
  ctx.strokeStyle = floor;
  ctx.strokeText(text, x, y);
  ctx.fillStyle = ink;
  ctx.fillText(text, x, y);
}
