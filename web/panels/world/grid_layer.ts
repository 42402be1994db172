// SPDX-License-Identifier: Apache-2.0
import type {Palette} from '../../panel_api';
import type {Camera} from './camera';
import {kFont} from './labels';
import {roundStep, tickText} from './ticks';

const kSpacing_px = 64;
/** Narrower pictures have the legend and the tools over their upper edge: container query of the
 * World View. */
const kNarrow_px = 520;

/** Lines at round distances, with halves between them. */
export function drawGrid(ctx: CanvasRenderingContext2D, camera: Camera, palette: Palette): void {
  const step = roundStep(kSpacing_px / camera.scale);
  const [x0, y1] = camera.toWorld(0, 0);
  const [x1, y0] = camera.toWorld(camera.width, camera.height);
  const lines = (spacing: number, colour: string) => {
    ctx.beginPath();
    for (let i = Math.ceil(x0 / spacing); i * spacing <= x1; ++i) {
      const x = Math.round(camera.toScreenX(i * spacing)) + 0.5;
      ctx.moveTo(x, 0);
      ctx.lineTo(x, camera.height);
    }
    for (let j = Math.ceil(y0 / spacing); j * spacing <= y1; ++j) {
      const y = Math.round(camera.toScreenY(j * spacing)) + 0.5;
      ctx.moveTo(0, y);
      ctx.lineTo(camera.width, y);
    }
    ctx.strokeStyle = colour;
    ctx.lineWidth = 1;
    ctx.stroke();
  };
  lines(step / 2, palette.token('grid-1'));
  lines(step, palette.token('grid-2'));
}

/** Numbers along the top and the left, where they have room. */
export function drawTicks(ctx: CanvasRenderingContext2D, camera: Camera, palette: Palette): void {
  if (camera.width <= kNarrow_px) return;
  const step = roundStep(kSpacing_px / camera.scale);
  const [x0, y1] = camera.toWorld(0, 0);
  const [x1, y0] = camera.toWorld(camera.width, camera.height);
  ctx.font = `400 10px ${kFont}`;
  ctx.fillStyle = palette.token('text-3');
  ctx.textBaseline = 'top';
  ctx.textAlign = 'center';
  for (let i = Math.ceil(x0 / step); i * step <= x1; ++i) {
    const x = camera.toScreenX(i * step);
    if (x > 30) ctx.fillText(tickText(i * step, step), x, 4);
  }
  ctx.textBaseline = 'middle';
  ctx.textAlign = 'left';
  for (let j = Math.ceil(y0 / step); j * step <= y1; ++j) {
    const y = camera.toScreenY(j * step);
    if (y > 24) ctx.fillText(tickText(j * step, step), 5, y);
  }
}

/** A round length at the bottom right. */
export function drawScale(ctx: CanvasRenderingContext2D, camera: Camera, palette: Palette): void {
  const step = roundStep(50 / camera.scale);
  const length = step * camera.scale;
  const x1 = camera.width - 14;
  const y = camera.height - 14;
  ctx.strokeStyle = palette.token('text-2');
  ctx.lineWidth = 1;
  ctx.beginPath();
  ctx.moveTo(x1 - length + 0.5, y - 5.5);
  ctx.lineTo(x1 - length + 0.5, y + 0.5);
  ctx.lineTo(x1 + 0.5, y + 0.5);
  ctx.lineTo(x1 + 0.5, y - 5.5);
  ctx.stroke();
  ctx.font = `400 11px ${kFont}`;
  ctx.fillStyle = palette.token('text-2');
  ctx.textAlign = 'right';
  ctx.textBaseline = 'bottom';
  ctx.fillText(
    step >= 1 ? `${step} m` : `${Math.round(step * 1000) / 10} cm`,
    x1 - length - 6,
    y + 4,
  );
}
