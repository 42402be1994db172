// SPDX-License-Identifier: Apache-2.0
import type {Palette} from '../../panel_api';
import type {Placed} from '../../model/pose_history';
import {sightingsOf} from '../../model/sightings';
import type {Reading} from '../../protocol/frames';
import type {Robot, Sensor} from '../../protocol/messages';
import type {Camera} from './camera';
import {pointSurface, type Surface} from './surface';

/** Where a sensor stands in the world. */
export interface Mount {
  x: number;
  y: number;
  yaw: number;
}

export function mountOf(placed: Placed, slot: number, sensor: Sensor): Mount {
  const yaw = placed.yaw[slot];
  const c = Math.cos(yaw);
  const s = Math.sin(yaw);
  const [mx, my, myaw] = sensor.mount;
  return {
    x: placed.x[slot] + c * mx - s * my,
    y: placed.y[slot] + s * mx + c * my,
    yaw: yaw + myaw,
  };
}

/** The directions of the rays of a sensor, or those of the reading's rows spread over a cone. */
export function bearingsOf(sensor: Sensor, rows: number): number[] {
  const given = sensor.bearings ?? [];
  if (given.length === rows) return given;
  return Array.from({length: rows}, () => 0);
}

/** Draws what a range sensor saw: an area up to what it hit. */
export function drawScan(
  ctx: CanvasRenderingContext2D,
  camera: Camera,
  mount: Mount,
  sensor: Sensor,
  reading: Reading,
  hue: string,
  strong: boolean,
): void {
  const max = sensor.range?.[1] ?? 4;
  const bearings = bearingsOf(sensor, reading.rows);
  const ox = camera.toScreenX(mount.x);
  const oy = camera.toScreenY(mount.y);
  const reach = max * camera.scale;
  const half = (sensor.cone ?? 0) / 2;
  ctx.beginPath();
  if (half > 0) {
    bearings.forEach((bearing, i) => {
      const r = Math.min(reading.values[i], max) * camera.scale;
      const a = -(mount.yaw + bearing);
      ctx.moveTo(ox, oy);
      ctx.arc(ox, oy, Math.max(r, 0), a - half, a + half);
      ctx.closePath();
    });
  } else {
    ctx.moveTo(ox, oy);
    for (let i = 0; i < reading.rows; ++i) {
      const r = Math.max(Math.min(reading.values[i], max), 0) * camera.scale;
      const a = mount.yaw + bearings[i];
      ctx.lineTo(ox + r * Math.cos(a), oy - r * Math.sin(a));
    }
    ctx.closePath();
  }
  ctx.save();
  if (strong) {
    const gradient = ctx.createRadialGradient(ox, oy, 0, ox, oy, Math.max(reach, 1));
    gradient.addColorStop(0, withAlpha(hue, 0.55));
    gradient.addColorStop(0.5, withAlpha(hue, 0.26));
    gradient.addColorStop(1, withAlpha(hue, 0.14));
    ctx.fillStyle = gradient;
    ctx.fill();
    ctx.strokeStyle = withAlpha(hue, 0.75);
    ctx.lineWidth = 1;
    ctx.stroke();
  } else {
    ctx.fillStyle = withAlpha(hue, 0.07);
    ctx.fill();
  }
  ctx.restore();
}

/** Marks what the rays of a sensor met: disc real, diamond simulated, square virtual. */
export function drawHits(
  ctx: CanvasRenderingContext2D,
  camera: Camera,
  mount: Mount,
  sensor: Sensor,
  reading: Reading,
  owner: number,
  surface: Surface,
  palette: Palette,
): void {
  const max = sensor.range?.[1] ?? Infinity;
  const bearings = bearingsOf(sensor, reading.rows);
  for (let i = 0; i < reading.rows; ++i) {
    const r = reading.values[i];
    if (!(r < max)) continue;
    const a = mount.yaw + bearings[i];
    const x = mount.x + r * Math.cos(a);
    const y = mount.y + r * Math.sin(a);
    const hit = pointSurface(surface, x, y, owner);
    if (hit === null) continue;
    const px = camera.toScreenX(x);
    const py = camera.toScreenY(y);
    ctx.fillStyle = palette.token(hit.token);
    drawMark(ctx, hit.mark, px, py, 2.2);
  }
}

/** Lines from a camera to what it read; `strength` is 1 for what is current. */
export function drawSightings(
  ctx: CanvasRenderingContext2D,
  camera: Camera,
  mount: Mount,
  sensor: Sensor,
  reading: Reading,
  hue: string,
  strength: number,
): void {
  ctx.save();
  ctx.strokeStyle = hue;
  ctx.lineWidth = 1;
  for (const {range_m, bearing_rad} of sightingsOf(sensor, reading)) {
    const a = mount.yaw + bearing_rad;
    const x = camera.toScreenX(mount.x + range_m * Math.cos(a));
    const y = camera.toScreenY(mount.y + range_m * Math.sin(a));
    ctx.globalAlpha = 0.7 * strength;
    ctx.beginPath();
    ctx.moveTo(camera.toScreenX(mount.x), camera.toScreenY(mount.y));
    ctx.lineTo(x, y);
    ctx.stroke();
    ctx.globalAlpha = strength;
    ctx.beginPath();
    ctx.arc(x, y, 4, 0, 2 * Math.PI);
    ctx.stroke();
  }
  ctx.restore();
}

export type Mark = 'disc' | 'diamond' | 'square';

export function drawMark(
  ctx: CanvasRenderingContext2D,
  mark: Mark,
  x: number,
  y: number,
  r: number,
): void {
  ctx.beginPath();
  if (mark === 'disc') ctx.arc(x, y, r, 0, 2 * Math.PI);
  else if (mark === 'square') ctx.rect(x - r, y - r, 2 * r, 2 * r);
  else {
    ctx.moveTo(x - 1.3 * r, y);
    ctx.lineTo(x, y - 1.3 * r);
    ctx.lineTo(x + 1.3 * r, y);
    ctx.lineTo(x, y + 1.3 * r);
    ctx.closePath();
  }
  ctx.fill();
}

/** A colour `#rrggbb` with transparency. */
export function withAlpha(colour: string, alpha: number): string {
  if (!/^#[0-9a-f]{6}$/i.test(colour)) return colour;
  const byte = Math.round(alpha * 255);
  return colour + byte.toString(16).padStart(2, '0');
}

/** Sensors of a robot that the World View draws, by their index. The virtual twin of a real camera
 * says what that should see; it is shown beside it in the Sensor Display, not over the world. */
export function drawnSensors(robot: Robot): number[] {
  const sees = (sensor: Sensor) => sensor.kind === 'sightings' && sensor.origin !== 'virtual';
  const hasCamera = robot.sensors.some(sees);
  const drawn: number[] = [];
  robot.sensors.forEach((sensor, i) => {
    const camera = sensor.kind === 'sightings' && (!hasCamera || sees(sensor));
    if (sensor.kind === 'ranges' || camera) drawn.push(i);
  });
  return drawn;
}
