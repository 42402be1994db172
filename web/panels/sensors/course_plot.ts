// SPDX-License-Identifier: Apache-2.0
import type {Palette} from '../../panel_api';
import type {CoursePoint} from '../../model/readings';
import {kCourse_s} from '../../model/readings';
import {kFont} from '../world/labels';
import {roundStep, tickText} from '../world/ticks';

/** Draws one field of a sensor over the last seconds. Gaps stand for "no return". */
export function drawCourse(
  ctx: CanvasRenderingContext2D, width: number, height: number, course: readonly CoursePoint[], field: number,
  now_s: number, colour: string, palette: Palette,
): void {
  const values = course.map((point) => point.values[field]).filter((value) => Number.isFinite(value));
  const top = Math.max(...values, 0.1);
  const bottom = Math.min(...values, 0);
  const step = roundStep((top - bottom) / 2.5);
  const low = Math.floor(bottom / step) * step;
  const high = Math.ceil(top / step) * step;
  const left = 34;
  const right = width - 8;
  const x = (t: number) => left + ((t - now_s + kCourse_s) / kCourse_s) * (right - left);
  const y = (value: number) => 6 + ((high - value) / (high - low || 1)) * (height - 26);
  ctx.font = `400 10px ${kFont}`;
  ctx.textBaseline = 'middle';
  ctx.lineWidth = 1;
  for (let value = low; value <= high + 1e-9; value += step) {
    ctx.strokeStyle = palette.token('line-1');
    ctx.beginPath();
    ctx.moveTo(left, Math.round(y(value)) + 0.5);
    ctx.lineTo(right, Math.round(y(value)) + 0.5);
    ctx.stroke();
    ctx.fillStyle = palette.token('text-3');
    ctx.textAlign = 'right';
    ctx.fillText(tickText(value, step), left - 5, y(value));
  }
  ctx.textAlign = 'center';
  for (const back of [15, 10, 5]) ctx.fillText(`−${back} s`, Math.max(x(now_s - back), left + 12), height - 8);
  ctx.textAlign = 'right';
  ctx.fillText('now', right, height - 8);
  ctx.strokeStyle = colour;
  ctx.lineWidth = 1.5;
  ctx.beginPath();
  let pen = false;
  for (const point of course) {
    const value = point.values[field];
    if (!Number.isFinite(value) || point.time_s < now_s - kCourse_s) {
      pen = false;
      continue;
    }
    if (pen) ctx.lineTo(x(point.time_s), y(value));
    else ctx.moveTo(x(point.time_s), y(value));
    pen = true;
  }
  ctx.stroke();
}
