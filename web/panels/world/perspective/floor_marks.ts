// SPDX-License-Identifier: Apache-2.0
import type {PoseHistory} from '../../../model/pose_history';
import {RobotFlag, type PoseFrame} from '../../../protocol/frames';
import {bytesOf} from '../ramp';
import type {Shown} from '../reading_layer';
import {bearingsOf, mountOf} from '../scan_layer';
import type {StageContext} from '../stage';
import type {Tone} from '../swarm';
import {kTrail_s, trailFrames} from '../trail_layer';
import type {FlatLayer} from './flat_layer';

const kRealTrail_m = 0.026;
const kSimTrail_m = 0.014;
const kManyTrails = 300;
const kShortTrail_s = 3;
const kConeSteps = 6;
const kFaint = Math.round(255 * 0.07);

/** Where robots have been, fading towards the past. */
export function writeTrails(
  layer: FlatLayer,
  context: StageContext,
  history: PoseHistory,
  shown: (slot: number) => boolean,
): void {
  const {model, placed, palette} = context;
  layer.begin();
  const many = model.robots.length > kManyTrails;
  const all = trailFrames(history.past, placed, many ? kShortTrail_s : kTrail_s);
  const frames = many ? all.filter((_, i) => i % 5 === 0) : all;
  if (frames.length > 0) {
    model.robots.forEach((robot, slot) => {
      if (!shown(slot)) return;
      const real = robot.kind === 'real';
      const tone = bytesOf(palette.hue(slot).ink);
      writeTrail(
        layer,
        frames,
        slot,
        [placed.x[slot], placed.y[slot]],
        real ? kRealTrail_m : kSimTrail_m,
        tone,
        real ? 180 : 150,
      );
    });
  }
  layer.end();
}

function writeTrail(
  layer: FlatLayer,
  frames: readonly PoseFrame[],
  slot: number,
  now: [number, number],
  width: number,
  tone: Tone,
  strongest: number,
): void {
  const fade = (i: number) => Math.round(strongest * (i / frames.length) ** 1.5);
  frames.forEach((frame, i) => {
    if ((frame.flags[slot] & RobotFlag.known) === 0) return;
    const next = frames[i + 1];
    const [x, y] = next === undefined ? now : [next.x[slot], next.y[slot]];
    layer.line(frame.x[slot], frame.y[slot], x, y, width, tone, fade(i), fade(i + 1));
  });
}

/** Areas that range sensors see, up to what they hit. */
export function writeScans(
  layer: FlatLayer,
  context: StageContext,
  readings: readonly Shown[],
): void {
  layer.begin();
  for (const one of readings) if (one.sensor.kind === 'ranges') writeScan(layer, context, one);
  layer.end();
}

function writeScan(
  layer: FlatLayer,
  context: StageContext,
  {slot, sensor, reading, strong, fresh}: Shown,
): void {
  const {placed, palette} = context;
  const mount = mountOf(placed, slot, sensor);
  const hue = palette.hue(slot);
  const bold = strong && fresh;
  const tone = bytesOf(bold ? hue.fill : hue.ink);
  const max = sensor.range?.[1] ?? 4;
  const bearings = bearingsOf(sensor, reading.rows);
  const half = (sensor.cone ?? 0) / 2;
  const alpha = (r: number) => (bold ? Math.round(255 * (0.5 - 0.36 * (r / max))) : kFaint);
  const at = (bearing: number, value: number): [number, number, number] => {
    const r = Math.max(Math.min(value, max), 0);
    const a = mount.yaw + bearing;
    return [mount.x + r * Math.cos(a), mount.y + r * Math.sin(a), r];
  };
  const triangle = (a: [number, number, number], b: [number, number, number]) => {
    layer.corner(mount.x, mount.y, tone, alpha(0));
    layer.corner(a[0], a[1], tone, alpha(a[2]));
    layer.corner(b[0], b[1], tone, alpha(b[2]));
    if (bold) layer.line(a[0], a[1], b[0], b[1], 0.012, tone, 190, 190);
  };
  for (let i = 0; i < reading.rows; ++i) {
    if (half > 0) {
      for (let k = 0; k < kConeSteps; ++k) {
        const side = (step: number) =>
          at(bearings[i] - half + (2 * half * step) / kConeSteps, reading.values[i]);
        triangle(side(k), side(k + 1));
      }
    } else if (i + 1 < reading.rows)
      triangle(at(bearings[i], reading.values[i]), at(bearings[i + 1], reading.values[i + 1]));
  }
}

/** Violet about who is selected, thin grey about who is pointed at. */
export function writeRings(
  layer: FlatLayer,
  context: StageContext,
  radius: (slot: number) => number,
): void {
  const {selection, placed, palette} = context;
  layer.begin();
  const intent = bytesOf(palette.token('intent'));
  for (const slot of selection.slots) {
    if (slot >= placed.count) continue;
    const r = radius(slot);
    layer.ring(placed.x[slot], placed.y[slot], 1.02 * r, r * 1.85 + 0.04, intent, 56);
    layer.ring(placed.x[slot], placed.y[slot], r * 1.25 + 0.02, r * 1.25 + 0.045, intent, 255);
  }
  const {hovered} = selection;
  if (hovered !== null && hovered < placed.count && !selection.has(hovered)) {
    const r = radius(hovered) * 1.25;
    layer.ring(
      placed.x[hovered],
      placed.y[hovered],
      r + 0.01,
      r + 0.025,
      bytesOf(palette.token('text-3')),
      255,
    );
  }
  layer.end();
}
