// SPDX-License-Identifier: Apache-2.0
import type {Palette} from '../../panel_api';
import type {Placed} from '../../model/pose_history';
import {RobotFlag, type PoseFrame} from '../../protocol/frames';
import type {Robot} from '../../protocol/messages';
import type {Camera} from './camera';

export const kTrail_s = 10;
const kBands = 5;

/** The frames of the past that make the trails of the picture `placed`. */
export function trailFrames(
  past: readonly PoseFrame[],
  placed: Placed,
  length_s: number,
): PoseFrame[] {
  return past.filter(
    (frame) =>
      frame.time_s >= placed.time_s - length_s &&
      frame.time_s <= placed.time_s &&
      frame.x.length === placed.count,
  );
}

/** Where one robot has been: fading towards the past, in bands of one alpha each. */
export function drawTrail(
  ctx: CanvasRenderingContext2D,
  camera: Camera,
  placed: Placed,
  frames: readonly PoseFrame[],
  slot: number,
  robot: Robot,
  palette: Palette,
): void {
  const real = robot.kind === 'real';
  ctx.strokeStyle = palette.hue(slot).ink;
  ctx.lineWidth = real ? 2.25 : 1.25;
  ctx.lineCap = 'round';
  ctx.lineJoin = 'round';
  for (let band = 0; band < kBands; ++band) {
    const a = Math.floor((band * frames.length) / kBands);
    const b = Math.min(Math.floor(((band + 1) * frames.length) / kBands), frames.length - 1);
    ctx.globalAlpha = (real ? 0.7 : 0.5) * ((band + 1) / kBands) ** 1.5;
    ctx.beginPath();
    let pen = false;
    for (let i = a; i <= b; ++i) {
      const frame = frames[i];
      if (frame === undefined || (frame.flags[slot] & RobotFlag.known) === 0) {
        pen = false;
        continue;
      }
      const x = camera.toScreenX(frame.x[slot]);
      const y = camera.toScreenY(frame.y[slot]);
      if (pen) ctx.lineTo(x, y);
      else ctx.moveTo(x, y);
      pen = true;
    }
    if (pen && band === kBands - 1)
      ctx.lineTo(camera.toScreenX(placed.x[slot]), camera.toScreenY(placed.y[slot]));
    ctx.stroke();
  }
  ctx.globalAlpha = 1;
}
