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
export const kLeastVariance_px = 2;
/** The sector of headings is as long at least. */
const kHeadings_m = 0.4;

/** Where a robot may be by what it says. x and y have the same variance, so its ellipse is
 * round. */
export interface Doubt {
  slot: number;
  radius_m: number;
  /** Half of the sector of headings, radians; 0: too wide to mean anything. */
  half_rad: number;
  /** Of that sector. */
  length_m: number;
}

/** What is known of the selected robots that are somewhere. */
export function doubtsOf(model: RunModel, selection: Selection, placed: Placed): Doubt[] {
  const doubts: Doubt[] = [];
  for (const [slot, variance] of model.variances) {
    if (
      !selection.has(slot) ||
      slot >= placed.count ||
      (placed.flags[slot] & RobotFlag.known) === 0
    )
      continue;
    const radius_m = kSigmas * Math.sqrt(Math.max(variance.xy_m2, 0));
    const half = kSigmas * Math.sqrt(Math.max(variance.yaw_rad2, 0));
    doubts.push({
      slot,
      radius_m,
      half_rad: half < Math.PI ? half : 0,
      length_m: Math.max(radius_m, kHeadings_m),
    });
  }
  return doubts;
}

/** Where selected robots may be by what they say: an ellipse about the reported place, and a sector
 * of headings. */
export function drawVariances(
  ctx: CanvasRenderingContext2D,
  camera: Camera,
  model: RunModel,
  selection: Selection,
  palette: Palette,
  placed: Placed,
): void {
  for (const {slot, radius_m, half_rad, length_m} of doubtsOf(model, selection, placed)) {
    const [x, y] = [camera.toScreenX(placed.x[slot]), camera.toScreenY(placed.y[slot])];
    const radius = radius_m * camera.scale;
    const ink = palette.hue(slot).ink;
    ctx.save();
    ctx.lineWidth = 1;
    ctx.strokeStyle = ink;
    ctx.fillStyle = withAlpha(ink, 0.08);
    if (radius >= kLeastVariance_px) {
      ctx.beginPath();
      ctx.ellipse(x, y, radius, radius, 0, 0, 2 * Math.PI);
      ctx.fill();
      ctx.stroke();
    }
    drawHeadings(ctx, x, y, -placed.yaw[slot], half_rad, length_m * camera.scale);
    ctx.restore();
  }
}

function drawHeadings(
  ctx: CanvasRenderingContext2D,
  x: number,
  y: number,
  heading: number,
  half: number,
  length: number,
): void {
  if (half * length < kLeastVariance_px) return;
  ctx.beginPath();
  ctx.moveTo(x, y);
  ctx.arc(x, y, length, heading - half, heading + half);
  ctx.closePath();
  ctx.fill();
}
