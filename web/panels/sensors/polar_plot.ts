// SPDX-License-Identifier: Apache-2.0
import type {Palette} from '../../panel_api';
import type {Reading} from '../../protocol/frames';
import type {Sensor} from '../../protocol/messages';
import {kFont} from '../world/labels';
import {bearingsOf, drawMark, withAlpha} from '../world/scan_layer';
import type {Met} from '../world/surface';
import {nearestRay} from './nearest';

/** As wide as a number with its unit. */
const kRing_px = 22;

/** Half of the opening that the plot shows, radians: as wide as the sensor sees. */
function halfOpening(bearings: readonly number[], cone: number): number {
  const widest =
    bearings.reduce((most, bearing) => Math.max(most, Math.abs(bearing)), 0) + cone / 2;
  return Math.min(Math.max(widest, 0.35), Math.PI);
}

/** What else a polar plot shows. */
export interface PolarMore {
  /** The real half of a hybrid. */
  real?: Reading | null;
  /** The ray whose course is drawn. */
  beam?: number | null;
  /** How much of the reading is left of its age. */
  strength?: number;
  /** Without texts, and close to the edges: the words stand beside it. */
  small?: boolean;
}

/** Where the plot stands on its canvas: its origin, and the radius of the longest range. */
export function placePolar(
  width: number,
  height: number,
  half: number,
  small: boolean,
): {ox: number; oy: number; radius: number} {
  // What lies behind the sensor needs room below it.
  const below = half > Math.PI / 2 ? Math.max(-Math.cos(half), 0.08) : 0.08;
  const wide = half >= Math.PI / 2 ? 1 : Math.max(Math.sin(half), 0.3);
  const [sides, ends, top] = small ? [4, 8, 3] : [56, 40, 24];
  const radius = Math.max(
    Math.min((width - sides) / (2 * wide), (height - ends) / (1 + below)),
    20,
  );
  return {ox: width / 2, oy: top + radius, radius};
}

/** Draws a range reading with ahead up. `met` says what a ray hit, or null. */
export function drawPolar(
  ctx: CanvasRenderingContext2D,
  width: number,
  height: number,
  sensor: Sensor,
  reading: Reading | null,
  hue: {fill: string; ink: string},
  palette: Palette,
  met: (ray: number) => Met | null,
  more: PolarMore = {},
): void {
  const {real = null, beam = null, strength = 1, small = false} = more;
  const max = sensor.range?.[1] ?? 4;
  const bearings = bearingsOf(sensor, reading?.rows ?? sensor.bearings?.length ?? 0);
  const half = halfOpening(bearings, sensor.cone ?? 0);
  const {ox, oy, radius} = placePolar(width, height, half, small);
  const at = (bearing: number, r: number): [number, number] => [
    ox - r * Math.sin(bearing),
    oy - r * Math.cos(bearing),
  ];
  drawRings(ctx, ox, oy, radius, half, max, palette, small);
  ctx.globalAlpha = strength;
  if (reading !== null && reading.rows > 0) {
    drawArea(ctx, [ox, oy, radius], sensor, reading, bearings, hue, at);
    if (real !== null && real.rows === reading.rows)
      drawHalf(ctx, real, max, radius, bearings, at, palette);
    drawHits(
      ctx,
      reading,
      max,
      (ray) => at(bearings[ray], (reading.values[ray] / max) * radius),
      met,
      palette,
    );
    const nearest = nearestRay(sensor, reading);
    if (nearest !== null)
      drawNearest(
        ctx,
        [ox, oy],
        at(bearings[nearest], (reading.values[nearest] / max) * radius),
        palette,
      );
  }
  ctx.globalAlpha = 1;
  if (beam !== null && bearings[beam] !== undefined)
    drawBeam(ctx, [ox, oy], at(bearings[beam], radius), palette);
  ctx.fillStyle = hue.fill;
  ctx.beginPath();
  ctx.arc(ox, oy, small ? 3.5 : 5, 0, 2 * Math.PI);
  ctx.fill();
  if (small) return;
  ctx.fillStyle = palette.token('text-2');
  ctx.textAlign = 'center';
  ctx.fillText('ahead', ox, 10);
}

/** Up to what each ray hit. */
function drawArea(
  ctx: CanvasRenderingContext2D,
  [ox, oy, radius]: [number, number, number],
  sensor: Sensor,
  reading: Reading,
  bearings: readonly number[],
  hue: {fill: string; ink: string},
  at: (bearing: number, r: number) => [number, number],
): void {
  const max = sensor.range?.[1] ?? 4;
  const cone = sensor.cone ?? 0;
  ctx.beginPath();
  ctx.moveTo(ox, oy);
  for (let i = 0; i < reading.rows; ++i) {
    const r = (Math.max(Math.min(reading.values[i], max), 0) / max) * radius;
    if (cone > 0) {
      const [x0, y0] = at(bearings[i] + cone / 2, r);
      ctx.moveTo(ox, oy);
      ctx.lineTo(x0, y0);
      ctx.arc(
        ox,
        oy,
        r,
        -Math.PI / 2 - bearings[i] - cone / 2,
        -Math.PI / 2 - bearings[i] + cone / 2,
      );
      ctx.closePath();
    } else {
      ctx.lineTo(...at(bearings[i], r));
    }
  }
  ctx.closePath();
  const gradient = ctx.createRadialGradient(ox, oy, 0, ox, oy, radius);
  gradient.addColorStop(0, withAlpha(hue.fill, 0.6));
  gradient.addColorStop(1, withAlpha(hue.fill, 0.16));
  ctx.fillStyle = gradient;
  ctx.fill();
  ctx.strokeStyle = withAlpha(hue.ink, 0.8);
  ctx.lineWidth = 1;
  ctx.stroke();
}

function drawHits(
  ctx: CanvasRenderingContext2D,
  reading: Reading,
  max: number,
  at: (ray: number) => [number, number],
  met: (ray: number) => Met | null,
  palette: Palette,
): void {
  for (let i = 0; i < reading.rows; ++i) {
    if (!(reading.values[i] < max)) continue;
    const hit = met(i);
    ctx.fillStyle = palette.token(hit?.token ?? 'text-2');
    drawMark(ctx, hit?.mark ?? 'disc', ...at(i), 1.8);
  }
}

/** What the sentence beside the plot is about. */
function drawNearest(
  ctx: CanvasRenderingContext2D,
  from: [number, number],
  to: [number, number],
  palette: Palette,
): void {
  ctx.strokeStyle = palette.token('text-1');
  ctx.lineWidth = 1.25;
  ctx.setLineDash([1.5, 3]);
  ctx.beginPath();
  ctx.moveTo(...from);
  ctx.lineTo(...to);
  ctx.stroke();
  ctx.setLineDash([]);
  ctx.beginPath();
  ctx.arc(...to, 5.5, 0, 2 * Math.PI);
  ctx.stroke();
}

/** The beam that the person looks at. */
function drawBeam(
  ctx: CanvasRenderingContext2D,
  from: [number, number],
  to: [number, number],
  palette: Palette,
): void {
  ctx.strokeStyle = palette.token('intent');
  ctx.lineWidth = 1.25;
  ctx.setLineDash([4, 3]);
  ctx.beginPath();
  ctx.moveTo(...from);
  ctx.lineTo(...to);
  ctx.stroke();
  ctx.setLineDash([]);
}

/** What the real half of a hybrid measured: a thin line below its result. */
function drawHalf(
  ctx: CanvasRenderingContext2D,
  real: Reading,
  max: number,
  radius: number,
  bearings: readonly number[],
  at: (bearing: number, r: number) => [number, number],
  palette: Palette,
): void {
  ctx.strokeStyle = palette.token('wall-ink');
  ctx.lineWidth = 1.25;
  ctx.beginPath();
  let pen = false;
  for (let i = 0; i < real.rows; ++i) {
    if (!(real.values[i] < max)) {
      pen = false;
      continue;
    }
    const [x, y] = at(bearings[i], (real.values[i] / max) * radius);
    if (pen) ctx.lineTo(x, y);
    else ctx.moveTo(x, y);
    pen = true;
  }
  ctx.stroke();
}

/** Metres between two rings whose numbers have room. */
export function ringStep(max: number, radius: number): number {
  const least = max > 12 ? 5 : max > 5 ? 2 : max > 1.5 ? 1 : 0.25;
  const fits = (step: number) => (step / max) * radius >= kRing_px;
  return [0.25, 0.5, 1, 2, 5, 10, 20, 50].find((step) => step >= least && fits(step)) ?? max;
}

function drawRings(
  ctx: CanvasRenderingContext2D,
  ox: number,
  oy: number,
  radius: number,
  half: number,
  max: number,
  palette: Palette,
  small: boolean,
): void {
  const step = ringStep(max, radius);
  const full = half > Math.PI - 0.01;
  ctx.font = `400 10px ${kFont}`;
  ctx.textBaseline = 'middle';
  const begin = full ? 0 : -Math.PI / 2 - half;
  const end = full ? 2 * Math.PI : -Math.PI / 2 + half;
  ctx.strokeStyle = palette.token('line-2');
  ctx.lineWidth = 1;
  for (let r = step; r <= max + 1e-9; r += step) {
    ctx.beginPath();
    ctx.arc(ox, oy, (r / max) * radius, begin, end);
    ctx.stroke();
  }
  ctx.fillStyle = palette.token('text-3');
  ctx.textAlign = 'left';
  for (let r = step; !small && r <= max + 1e-9; r += step) {
    const x = ox + (r / max) * radius * Math.sin(Math.min(half, Math.PI / 2)) + 3;
    const y = oy - (r / max) * radius * Math.cos(Math.min(half, Math.PI / 2));
    ctx.fillText(r === step ? `${r} m` : String(r), x, y + (half >= Math.PI / 2 ? 0 : 6));
  }
  if (full) return;
  ctx.beginPath();
  for (const side of [-1, 1]) {
    ctx.moveTo(ox, oy);
    ctx.lineTo(ox + side * radius * Math.sin(half), oy - radius * Math.cos(half));
    if (small) continue;
    ctx.textAlign = side < 0 ? 'right' : 'left';
    const degrees = Math.round((half * 180) / Math.PI);
    ctx.fillText(
      `${side < 0 ? '' : '−'}${degrees}°`,
      ox + side * (radius * Math.sin(half) + 5),
      oy - radius * Math.cos(half),
    );
  }
  ctx.stroke();
}
