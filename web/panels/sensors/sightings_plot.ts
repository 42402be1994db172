// SPDX-License-Identifier: Apache-2.0
import {sightingsOf, type Sighting} from '../../model/sightings';
import type {Palette, PanelContext} from '../../panel_api';
import type {Reading} from '../../protocol/frames';
import type {Sensor} from '../../protocol/messages';
import {strengthOf} from '../reading_age';
import {kFont, LabelPlacer, type Label} from '../world/labels';
import {shortName} from '../world/name_layer';
import {roundStep} from '../world/ticks';

/** What carries a code. */
export interface Named {
  name: string;
  colour: string;
}

const kLeast_rad = 0.3;
const kMargin = {left: 34, right: 14, top: 10, bottom: 22};

/** How many codes are in both readings; `sensor`: the camera or its twin. */
export function pairsOf(sensor: Sensor, saw: Reading | null, expected: Reading | null): number {
  const codes = new Set(sightingsOf(sensor, saw).map((one) => one.code));
  return sightingsOf(sensor, expected).filter((one) => codes.has(one.code)).length;
}

/** Range over bearing: discs were seen, squares are expected, a line joins a pair. What is old at
 * `now_s` is faint and hollow. */
export function drawSightingsPlot(
  ctx: CanvasRenderingContext2D,
  width: number,
  height: number,
  sensor: Sensor,
  reading: Reading | null,
  twin: Reading | null,
  named: (code: number) => Named,
  palette: Palette,
  now_s: number,
): void {
  const [ofCamera, ofTwin] = sensor.origin === 'virtual' ? [twin, reading] : [reading, twin];
  const [saw, expected] = [sightingsOf(sensor, ofCamera), sightingsOf(sensor, ofTwin)];
  const strength = (of: Reading | null) =>
    of === null ? 1 : strengthOf(now_s - of.stamp_s, sensor.period_s);
  const [strengthOfSaw, strengthOfExpected] = [strength(ofCamera), strength(ofTwin)];
  const all = [...saw, ...expected];
  const half = Math.max(kLeast_rad, ...all.map((one) => Math.abs(one.bearing_rad))) * 1.12;
  const far = Math.max(1, ...all.map((one) => one.range_m)) * 1.1;
  const x = (bearing: number) =>
    kMargin.left + ((half - bearing) / (2 * half)) * (width - kMargin.left - kMargin.right);
  const y = (range: number) =>
    height - kMargin.bottom - (range / far) * (height - kMargin.top - kMargin.bottom);
  drawAxes(ctx, width, half, far, x, y, palette);
  const seen = new Map(saw.map((one) => [one.code, one]));
  const placer = new LabelPlacer(width, height);
  const labels: Label[] = [];
  const label = (one: Sighting, rank: number, fresh: boolean) => {
    const {name, colour: own} = named(one.code);
    const colour = fresh ? own : palette.token('text-3');
    placer.block(x(one.bearing_rad), y(one.range_m), 4);
    labels.push({
      text: name,
      x: x(one.bearing_rad),
      y: y(one.range_m),
      gap: 6,
      colour,
      weight: 400,
      rank,
    });
  };
  ctx.globalAlpha = strengthOfExpected;
  for (const one of expected) {
    const [px, py] = [x(one.bearing_rad), y(one.range_m)];
    const pair = seen.get(one.code);
    ctx.strokeStyle = palette.token('virtual-ink');
    ctx.lineWidth = 1.25;
    if (pair !== undefined) {
      ctx.beginPath();
      ctx.moveTo(px, py);
      ctx.lineTo(x(pair.bearing_rad), y(pair.range_m));
      ctx.stroke();
    }
    ctx.strokeRect(px - 3.5, py - 3.5, 7, 7);
    label(one, 1, strengthOfExpected === 1);
  }
  const twinned = new Set(expected.map((one) => one.code));
  ctx.globalAlpha = strengthOfSaw;
  for (const one of saw) {
    ctx.fillStyle = ctx.strokeStyle = named(one.code).colour;
    ctx.beginPath();
    ctx.arc(x(one.bearing_rad), y(one.range_m), 3, 0, 2 * Math.PI);
    // What is not current loses its fill.
    if (strengthOfSaw === 1) ctx.fill();
    else ctx.stroke();
    if (!twinned.has(one.code)) label(one, 0, strengthOfSaw === 1);
  }
  ctx.globalAlpha = 1;
  placer.draw(ctx, labels, palette.token('bg-1'));
}

function drawAxes(
  ctx: CanvasRenderingContext2D,
  width: number,
  half: number,
  far: number,
  x: (bearing: number) => number,
  y: (range: number) => number,
  palette: Palette,
): void {
  ctx.font = `400 10px ${kFont}`;
  ctx.lineWidth = 1;
  ctx.strokeStyle = palette.token('line-1');
  ctx.fillStyle = palette.token('text-3');
  ctx.textBaseline = 'middle';
  ctx.textAlign = 'right';
  const step = roundStep(far / 4);
  for (let range = 0; range <= far; range += step) {
    ctx.beginPath();
    ctx.moveTo(kMargin.left, Math.round(y(range)) + 0.5);
    ctx.lineTo(width - kMargin.right, Math.round(y(range)) + 0.5);
    ctx.stroke();
    ctx.fillText(
      range === 0 ? '0 m' : String(Number(range.toFixed(2))),
      kMargin.left - 5,
      y(range),
    );
  }
  ctx.textAlign = 'center';
  const degrees = roundStep((half * 180) / Math.PI / 2.2);
  for (let k = -4; k <= 4; ++k) {
    const bearing = (k * degrees * Math.PI) / 180;
    if (Math.abs(bearing) > half) continue;
    ctx.beginPath();
    ctx.moveTo(Math.round(x(bearing)) + 0.5, y(far));
    ctx.lineTo(Math.round(x(bearing)) + 0.5, y(0));
    ctx.stroke();
    ctx.fillText(`${k * degrees}°`.replace('-', '−'), x(bearing), y(0) + 12);
  }
}

/** The robot or tube that carries a barcode. */
export function namedBy(
  {model, palette}: Pick<PanelContext, 'model' | 'palette'>,
  code: number,
): Named {
  const slot = model.robots.findIndex((robot) => robot.barcode === code);
  if (slot >= 0) return {name: model.robots[slot].name, colour: palette.hue(slot).ink};
  for (const body of model.bodies.values()) {
    if (body.barcode === code)
      return {name: shortName(body.name), colour: palette.token('landmark-ink')};
  }
  return {name: `code ${code}`, colour: palette.token('text-3')};
}
