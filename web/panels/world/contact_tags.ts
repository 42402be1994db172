// SPDX-License-Identifier: Apache-2.0
import {clockText} from '../../ui/clock';
import type {Placed} from '../../model/pose_history';
import type {Palette} from '../../panel_api';
import {RobotFlag} from '../../protocol/frames';
import type {Event} from '../../protocol/messages';
import type {Camera} from './camera';
import {kFont, type LabelPlacer} from './labels';

const kMostTags = 6;
/** An event may arrive a little later than the pose in which robots part. */
const kSlack_s = 0.3;
const kHeight = 20;

/** The contacts at this moment, each with a robot that is in it. */
export function contactsNow(
  events: readonly Event[],
  placed: Placed,
): {event: Event; slot: number}[] {
  const found: {event: Event; slot: number}[] = [];
  for (const event of events) {
    if (found.length >= kMostTags) break;
    if (
      !event.kind.includes('contact') ||
      event.t > placed.time_s ||
      event.until < placed.time_s - kSlack_s
    )
      continue;
    const slot = event.slots.find(
      (one) => one < placed.count && (placed.flags[one] & RobotFlag.known) !== 0,
    );
    if (slot !== undefined) found.push({event, slot});
  }
  return found;
}

/** Amber: since when robots touch. */
export function drawContactTags(
  ctx: CanvasRenderingContext2D,
  camera: Camera,
  events: readonly Event[],
  placed: Placed,
  palette: Palette,
  placer: LabelPlacer,
): void {
  const ink = palette.token('warn');
  ctx.font = `500 11px ${kFont}`;
  ctx.textAlign = 'center';
  ctx.textBaseline = 'middle';
  for (const {event, slot} of contactsNow(events, placed)) {
    const text = `contact since ${clockText(event.t)} s`;
    const half = ctx.measureText(text).width / 2 + 8;
    const [x0, y0] = [camera.toScreenX(placed.x[slot]), camera.toScreenY(placed.y[slot])];
    const offset = [
      [-half - 10, 34],
      [half + 10, -34],
      [-half - 10, -34],
      [half + 10, 34],
    ].find(([dx, dy]) => placer.isFree(x0 + dx, y0 + dy, half, kHeight / 2));
    const [x, y] = [x0 + (offset?.[0] ?? 0), y0 + (offset?.[1] ?? 44)];
    ctx.strokeStyle = ink;
    ctx.lineWidth = 1;
    ctx.beginPath();
    ctx.moveTo(x0, y0);
    ctx.lineTo(x, y);
    ctx.stroke();
    ctx.fillStyle = palette.token('bg-1');
    ctx.beginPath();
    ctx.roundRect(x - half, y - kHeight / 2, 2 * half, kHeight, 4);
    ctx.fill();
    ctx.stroke();
    ctx.fillStyle = ink;
    ctx.fillText(text, x, y + 0.5);
    placer.block(x, y, half, kHeight / 2);
  }
}
