// SPDX-License-Identifier: Apache-2.0
import type {Placed} from '../../model/pose_history';
import type {RunModel} from '../../model/run_model';
import type {Palette, Selection} from '../../panel_api';
import {RobotFlag, type Reading} from '../../protocol/frames';
import type {Sensor} from '../../protocol/messages';
import {isCurrent, kOldest_s, strengthOf} from '../reading_age';
import type {Camera} from './camera';
import type {Layers} from './layers';
import {drawHits, drawScan, drawSightings, drawnSensors, mountOf} from './scan_layer';
import type {Surface} from './surface';

/** The number of robots whose sensors are drawn at a time. */
const kScanned = 12;

/** Slot and index of the sensors that the layers ask for: those of the selection, and of a few real
 * robots. */
export function sensorsToRead(
  model: RunModel,
  selection: Selection,
  layers: Layers,
): [number, number][] {
  if (layers.scans === 'off') return [];
  const wanted = new Set<number>(selection.primary === null ? [] : [selection.primary]);
  if (layers.scans === 'real') {
    model.robots.forEach((robot, slot) => {
      if (robot.kind === 'real' && wanted.size < kScanned) wanted.add(slot);
    });
  }
  return [...wanted].flatMap((slot) => {
    const robot = model.robots[slot];
    return robot === undefined
      ? []
      : drawnSensors(robot).map((sensor): [number, number] => [slot, sensor]);
  });
}

/** A reading that is to be drawn. */
export interface Shown {
  slot: number;
  sensor: Sensor;
  reading: Reading;
  /** Of the selected robot. */
  strong: boolean;
  fresh: boolean;
  /** 1 while it is current, then less with its age. */
  strength: number;
  /** Of a virtual sensor that is tried: no part of the run. */
  tried: boolean;
}

/** The readings that the layers ask for. What is old is faint where it is looked at, and gone
 * elsewhere. */
export function shownReadings(
  model: RunModel,
  selection: Selection,
  placed: Placed,
  layers: Layers,
): Shown[] {
  if (layers.scans === 'off') return [];
  const found: Shown[] = [];
  model.readings.each((slot, index, reading) => {
    const robot = model.robots[slot];
    if (robot === undefined || layers.hidden.includes(robot.kind) || slot >= placed.count) return;
    if ((placed.flags[slot] & (RobotFlag.known | RobotFlag.stale)) !== RobotFlag.known) return;
    const tried = model.probes.sensor(index);
    if (tried !== undefined) {
      if (tried.kind === 'ranges' || tried.kind === 'sightings')
        found.push({
          slot,
          sensor: tried,
          reading,
          strong: true,
          fresh: placed.time_s - reading.stamp_s < 1,
          strength: strengthOf(placed.time_s - reading.stamp_s, 0),
          tried: true,
        });
      return;
    }
    const strong = slot === selection.primary;
    if (!strong && (layers.scans === 'selected' || robot.kind !== 'real')) return;
    if (!drawnSensors(robot).includes(index)) return;
    const sensor = robot.sensors[index];
    const age_s = placed.time_s - reading.stamp_s;
    const fresh = isCurrent(age_s, sensor.period_s);
    if (!fresh && (!strong || age_s > kOldest_s)) return;
    found.push({
      slot,
      sensor,
      reading,
      strong,
      fresh,
      strength: strengthOf(age_s, sensor.period_s),
      tried: false,
    });
  });
  return found.sort((a, b) => Number(a.strong) - Number(b.strong) || a.slot - b.slot);
}

/** Scans, what they hit, and sightings. */
export function drawReadings(
  ctx: CanvasRenderingContext2D,
  camera: Camera,
  model: RunModel,
  selection: Selection,
  palette: Palette,
  placed: Placed,
  layers: Layers,
  surface: Surface | null,
  hits: boolean,
): void {
  for (const {slot, sensor, reading, strong, fresh, strength, tried} of shownReadings(
    model,
    selection,
    placed,
    layers,
  )) {
    const mount = mountOf(placed, slot, sensor);
    const hue = tried
      ? {fill: palette.token('virtual'), ink: palette.token('virtual-ink')}
      : palette.hue(slot);
    if (sensor.kind === 'sightings') {
      if (layers.sightings) drawSightings(ctx, camera, mount, sensor, reading, hue.ink, strength);
      continue;
    }
    if (tried) ctx.setLineDash([4, 3]);
    drawScan(ctx, camera, mount, sensor, reading, strong ? hue.fill : hue.ink, strong && fresh);
    ctx.setLineDash([]);
    if (fresh && hits && layers.hits && surface !== null)
      drawHits(ctx, camera, mount, sensor, reading, slot, surface, palette);
  }
}
