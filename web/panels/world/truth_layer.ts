// SPDX-License-Identifier: Apache-2.0
import type {Placed} from '../../model/pose_history';
import type {RunModel} from '../../model/run_model';
import type {Palette, Selection} from '../../panel_api';
import {RobotFlag} from '../../protocol/frames';
import type {Camera} from './camera';
import type {Poses} from './layers';
import type {RobotLayer} from './robot_layer';
import {drawGap, gapText, kApart_px} from './shadow_layer';

const kCross_px = 4;

/** Whether the reported and the true pose of a robot are known. */
export function bothKnown(placed: Placed, truth: Placed, slot: number): boolean {
  return (
    slot < truth.count &&
    slot < placed.count &&
    (placed.flags[slot] & truth.flags[slot] & RobotFlag.known) !== 0
  );
}

/** Puts robots whose true pose is known there. */
export function takePlaces(placed: Placed, truth: Placed): void {
  for (let slot = 0; slot < Math.min(placed.count, truth.count); ++slot) {
    if (!bothKnown(placed, truth, slot)) continue;
    placed.x[slot] = truth.x[slot];
    placed.y[slot] = truth.y[slot];
    placed.yaw[slot] = truth.yaw[slot];
  }
}

/** The outline of each robot where it truly is, with a cross, and with the gap to where it is
 * reported to be. */
export function drawTruth(
  ctx: CanvasRenderingContext2D,
  camera: Camera,
  slots: readonly number[],
  selection: Selection,
  palette: Palette,
  placed: Placed,
  truth: Placed,
  robots: RobotLayer,
): void {
  const ink = palette.token('text-1');
  for (const slot of slots) {
    if (!bothKnown(placed, truth, slot)) continue;
    const [x, y] = [camera.toScreenX(truth.x[slot]), camera.toScreenY(truth.y[slot])];
    const [rx, ry] = [camera.toScreenX(placed.x[slot]), camera.toScreenY(placed.y[slot])];
    ctx.save();
    ctx.strokeStyle = ink;
    ctx.lineWidth = 1;
    robots.strokeOutline(ctx, slot, x, y, truth.yaw[slot], camera.scale);
    ctx.restore();
    const apart = drawTrueCross(ctx, palette, [rx, ry], [x, y]);
    if (apart < kApart_px && !selection.has(slot)) continue;
    const gap_m = Math.hypot(truth.x[slot] - placed.x[slot], truth.y[slot] - placed.y[slot]);
    drawGap(
      ctx,
      `true ${gapText(gap_m)}`,
      (x + rx) / 2,
      Math.max(y, ry) + robots.radius(slot) * camera.scale + 6,
      ink,
      palette.token('floor'),
    );
  }
}

/** Places on the screen. Returns how far they are apart, pixels. */
export function drawTrueCross(
  ctx: CanvasRenderingContext2D,
  palette: Palette,
  reported: [number, number],
  at: [number, number],
): number {
  const [x, y] = at;
  const apart = Math.hypot(x - reported[0], y - reported[1]);
  ctx.save();
  ctx.strokeStyle = palette.token('text-1');
  ctx.lineWidth = 1.25;
  ctx.beginPath();
  ctx.moveTo(x - kCross_px, y);
  ctx.lineTo(x + kCross_px, y);
  ctx.moveTo(x, y - kCross_px);
  ctx.lineTo(x, y + kCross_px);
  if (apart >= kApart_px) {
    ctx.moveTo(...reported);
    ctx.lineTo(x, y);
  }
  ctx.stroke();
  ctx.restore();
  return apart;
}

/** True poses as the menu asks for them: in place of those of `placed`, or in `truth` beside
 * them. */
export function placeTruth(
  model: RunModel,
  poses: Poses,
  now_ms: number,
  placed: Placed,
  truth: Placed,
): void {
  truth.resize(0);
  if (poses === 'reported') return;
  model.truth.interpolate(now_ms, truth);
  if (poses === 'both') return;
  takePlaces(placed, truth);
  truth.resize(0);
}
