// SPDX-License-Identifier: Apache-2.0
import {bytesOf} from '../ramp';
import type {StageContext} from '../stage';
import {doubtsOf, kLeastVariance_px, type Doubt} from '../variance_layer';
import type {FlatLayer} from './flat_layer';
import type {Orbit} from './orbit';

const kSteps = 48;
const kEdge_px = 1.25;
const kFill = Math.round(255 * 0.08);
const kHeadings = Math.round(255 * 0.14);

/** On the floor: where selected robots may be by what they say, and where they may look. */
export function writeDoubts(layer: FlatLayer, context: StageContext, orbit: Orbit): void {
  const {model, placed, palette, selection} = context;
  layer.begin();
  if (context.layers().uncertainty) {
    for (const doubt of doubtsOf(model, selection, placed)) {
      const at = orbit.project(placed.x[doubt.slot], placed.y[doubt.slot], 0);
      if (at === null) continue;
      writeDoubt(
        layer,
        doubt,
        [placed.x[doubt.slot], placed.y[doubt.slot], placed.yaw[doubt.slot]],
        bytesOf(palette.hue(doubt.slot).ink),
        orbit.pixelsPerMetre(at.distance),
      );
    }
  }
  layer.end();
}

function writeDoubt(
  layer: FlatLayer,
  doubt: Doubt,
  [x, y, yaw]: [number, number, number],
  tone: ReturnType<typeof bytesOf>,
  scale: number,
): void {
  const fan = (from: number, to: number, r: number, alpha: number) => {
    for (let i = 0; i < kSteps; ++i) {
      const [a, b] = [i, i + 1].map((k) => from + ((to - from) * k) / kSteps);
      layer.corner(x, y, tone, alpha);
      layer.corner(x + r * Math.cos(a), y + r * Math.sin(a), tone, alpha);
      layer.corner(x + r * Math.cos(b), y + r * Math.sin(b), tone, alpha);
    }
  };
  if (doubt.radius_m * scale >= kLeastVariance_px) {
    fan(0, 2 * Math.PI, doubt.radius_m, kFill);
    // As thick on the screen from any distance.
    layer.ring(x, y, Math.max(doubt.radius_m - kEdge_px / scale, 0), doubt.radius_m, tone, 255);
  }
  if (doubt.half_rad * doubt.length_m * scale >= kLeastVariance_px)
    fan(yaw - doubt.half_rad, yaw + doubt.half_rad, doubt.length_m, kHeadings);
}
