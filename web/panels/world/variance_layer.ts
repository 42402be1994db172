// SPDX-License-Identifier: Apache-2.0
import type {Placed} from '../../model/pose_history';
import type {RunModel} from '../../model/run_model';
import type {Palette, Selection} from '../../panel_api';
import {RobotFlag} from '../../protocol/frames';
import type {Camera} from './camera';
import {withAlpha} from './scan_layer';

/** How many standard deviations are drawn: 86 % of a distribution in the plane are within. */
const kSigmas = 2;
/** A smaller one would hide below the line that shows it. */
const kLeast_px = 2;

/** Where selected robots may be by what they say: an ellipse about the reported place, and a sector of headings. */
export function drawVariances(ctx: CanvasRenderingContext2D, camera: Camera, model: RunModel, selection: Selection, palette: Palette, placed: Placed): void {
  for (const [slot, variance] of model.variances) {
    if (!selection.has(slot) || slot >= placed.count || (placed.flags[slot] & RobotFlag.known) === 0) continue;
    const [x, y] = [camera.toScreenX(placed.x[slot]), camera.toScreenY(placed.y[slot])];
    const radius = kSigmas * Math.sqrt(Math.max(variance.xy_m2, 0)) * camera.scale;
    const ink = palette.hue(slot).ink;
    ctx.save();
    ctx.lineWidth = 1;
    ctx.strokeStyle = ink;
    ctx.fillStyle = withAlpha(ink, 0.08);
    if (radius >= kLeast_px) {
      ctx.beginPath();
      // x and y have the same variance, so the ellipse is round.
      ctx.ellipse(x, y, radius, radius, 0, 0, 2 * Math.PI);
      ctx.fill();
      ctx.stroke();
    }
    drawHeadings(ctx, x, y, -placed.yaw[slot], kSigmas * Math.sqrt(Math.max(variance.yaw_rad2, 0)), Math.max(radius, 0.4 * camera.scale));
    ctx.restore();
  }
}

function drawHeadings(ctx: CanvasRenderingContext2D, x: number, y: number, heading: number, half: number, length: number): void {
  if (half * length < kLeast_px || half >= Math.PI) return;
  ctx.beginPath();
  ctx.moveTo(x, y);
  ctx.arc(x, y, length, heading - half, heading + half);
  ctx.closePath();
  ctx.fill();
}
