// SPDX-License-Identifier: Apache-2.0
import type {Palette, Selection} from '../../panel_api';
import type {Placed} from '../../model/pose_history';
import type {RunModel} from '../../model/run_model';
import {RobotFlag} from '../../protocol/frames';
import type {Body, Robot} from '../../protocol/messages';
import type {Camera} from './camera';
import {LabelPlacer, kFont, type Label} from './labels';
import type {Kind, Layers} from './layers';
import {addShape, isDisc, outlinePath, radiusOf} from './outlines';
import {drawHits, drawScan, drawSightings, drawnSensors, mountOf, withAlpha} from './scan_layer';
import {Surface} from './surface';
import {roundStep, tickText} from './ticks';

/** Below this many pixels per metre, or beyond so many robots, simulated ones are arrowheads. */
const kFar_px = 30;
const kNearNames_px = 60;
const kMany = 400;
const kTrail_s = 10;
const kFarTrail_s = 4;
const kOldest_s = 5;

interface Outline {
  path: Path2D;
  radius: number;
  disc: boolean;
}

/** Draws the world from above. Keeps what does not change from picture to picture. */
export class TopView {
  private outlines: Outline[] = [];
  private groups = new Map<string, {path: Path2D; bodies: Body[]}>();
  private surface: Surface | null = null;
  private hatch: CanvasPattern | null = null;

  constructor(
    private readonly model: RunModel,
    private readonly palette: Palette,
    private readonly selection: Selection,
  ) {}

  /** The roster, the bodies or the theme changed. */
  refresh(): void {
    this.palette.assign(this.model.robots);
    this.outlines = this.model.robots.map((robot) => ({
      path: outlinePath(robot.shapes),
      radius: radiusOf(robot.shapes),
      disc: isDisc(robot.shapes),
    }));
    this.groups.clear();
    for (const body of this.model.bodies.values()) {
      let group = this.groups.get(body.kind);
      if (group === undefined) this.groups.set(body.kind, (group = {path: new Path2D(), bodies: []}));
      group.bodies.push(body);
      for (const shape of body.shapes) addShape(group.path, shape, body.pose);
    }
    this.surface = new Surface(this.model.bodies.values(), this.model.robots, this.palette);
    this.hatch = null;
  }

  radius(slot: number): number {
    return this.outlines[slot]?.radius ?? 0.2;
  }

  draw(ctx: CanvasRenderingContext2D, camera: Camera, placed: Placed, layers: Layers): void {
    const {width, height} = camera;
    ctx.fillStyle = this.palette.token('floor');
    ctx.fillRect(0, 0, width, height);
    if (layers.grid) this.drawGrid(ctx, camera);
    const far = camera.scale < kFar_px || placed.count > kMany;
    if (this.surface !== null) this.surface.placed = placed;
    this.drawBodies(ctx, camera, layers);
    if (layers.trails) this.drawTrails(ctx, camera, placed, layers, far);
    this.drawReadings(ctx, camera, placed, layers);
    this.drawRobots(ctx, camera, placed, layers, far);
    if (layers.names) this.drawNames(ctx, camera, placed, layers, far);
    if (layers.grid) this.drawTicks(ctx, camera);
    this.drawScale(ctx, camera);
  }

  private shown(robot: Robot, layers: Layers): boolean {
    return !layers.hidden.includes(robot.kind === 'real' ? 'real' : 'simulated');
  }

  private drawGrid(ctx: CanvasRenderingContext2D, camera: Camera): void {
    const step = roundStep(64 / camera.scale);
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
    lines(step / 2, this.palette.token('grid-1'));
    lines(step, this.palette.token('grid-2'));
  }

  private drawTicks(ctx: CanvasRenderingContext2D, camera: Camera): void {
    const step = roundStep(64 / camera.scale);
    const [x0, y1] = camera.toWorld(0, 0);
    const [x1, y0] = camera.toWorld(camera.width, camera.height);
    ctx.font = `400 10px ${kFont}`;
    ctx.fillStyle = this.palette.token('text-3');
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

  private drawScale(ctx: CanvasRenderingContext2D, camera: Camera): void {
    const step = roundStep(50 / camera.scale);
    const length = step * camera.scale;
    const x1 = camera.width - 14;
    const y = camera.height - 14;
    ctx.strokeStyle = this.palette.token('text-2');
    ctx.lineWidth = 1;
    ctx.beginPath();
    ctx.moveTo(x1 - length + 0.5, y - 5.5);
    ctx.lineTo(x1 - length + 0.5, y + 0.5);
    ctx.lineTo(x1 + 0.5, y + 0.5);
    ctx.lineTo(x1 + 0.5, y - 5.5);
    ctx.stroke();
    ctx.font = `400 11px ${kFont}`;
    ctx.fillStyle = this.palette.token('text-2');
    ctx.textAlign = 'right';
    ctx.textBaseline = 'bottom';
    ctx.fillText(step >= 1 ? `${step} m` : `${Math.round(step * 1000) / 10} cm`, x1 - length - 6, y + 4);
  }

  /** Draws in metres; lines are then given in pixels divided by the scale. */
  private inWorld(ctx: CanvasRenderingContext2D, camera: Camera, draw: () => void): void {
    ctx.save();
    ctx.translate(camera.width / 2 - camera.x * camera.scale, camera.height / 2 + camera.y * camera.scale);
    ctx.scale(camera.scale, -camera.scale);
    draw();
    ctx.restore();
  }

  private drawBodies(ctx: CanvasRenderingContext2D, camera: Camera, layers: Layers): void {
    const token = (name: string) => this.palette.token(name);
    for (const kind of ['wall', 'landmark'] as const) {
      const group = this.groups.get(kind);
      if (group === undefined || layers.hidden.includes(kind)) continue;
      this.inWorld(ctx, camera, () => {
        ctx.fillStyle = token(kind);
        ctx.fill(group.path);
        if (kind === 'wall') return;
        // A tube stays visible from far away.
        const grow_px = 5 - 0.1 * camera.scale;
        if (grow_px <= 0) return;
        ctx.strokeStyle = token(kind);
        ctx.lineWidth = grow_px / camera.scale;
        ctx.stroke(group.path);
      });
    }
    const group = this.groups.get('virtual');
    if (group === undefined || layers.hidden.includes('virtual')) return;
    ctx.save();
    this.inWorld(ctx, camera, () => {
      ctx.fillStyle = token('virtual-fill');
      ctx.fill(group.path);
      ctx.strokeStyle = token('virtual-line');
      ctx.lineWidth = 1.5 / camera.scale;
      ctx.stroke(group.path);
      ctx.clip(group.path);
    });
    ctx.restore();
    this.drawHatch(ctx, camera, group.path);
  }

  private drawHatch(ctx: CanvasRenderingContext2D, camera: Camera, path: Path2D): void {
    this.hatch ??= makeHatch(ctx, this.palette.token('virtual-line'));
    if (this.hatch === null) return;
    ctx.save();
    this.inWorld(ctx, camera, () => {
      // The pattern counts in pixels of the screen, so it is given the inverse of the camera.
      this.hatch?.setTransform(new DOMMatrix().scale(1 / camera.scale, -1 / camera.scale));
      ctx.fillStyle = this.hatch ?? '';
      ctx.fill(path);
    });
    ctx.restore();
  }

  private drawTrails(
    ctx: CanvasRenderingContext2D, camera: Camera, placed: Placed, layers: Layers, far: boolean,
  ): void {
    const past = this.model.poses.past;
    if (past.length < 2) return;
    const length_s = far ? kFarTrail_s : kTrail_s;
    const from = past.findIndex((frame) => frame.time_s >= placed.time_s - length_s);
    if (from < 0) return;
    const frames = past.slice(from).filter((frame) => frame.x.length === placed.count && frame.time_s <= placed.time_s);
    const bands = far ? 1 : 5;
    this.model.robots.forEach((robot, slot) => {
      if (!this.shown(robot, layers)) return;
      const real = robot.kind === 'real';
      ctx.strokeStyle = this.palette.token(`${this.palette.hueName(slot)}-ink`);
      ctx.lineWidth = real ? 2.25 : 1.25;
      ctx.lineCap = 'round';
      ctx.lineJoin = 'round';
      for (let band = 0; band < bands; ++band) {
        const a = Math.floor((band * frames.length) / bands);
        const b = Math.min(Math.floor(((band + 1) * frames.length) / bands), frames.length - 1);
        ctx.globalAlpha = (real ? 0.7 : 0.5) * ((band + 1) / bands) ** 1.5;
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
        if (pen && band === bands - 1) ctx.lineTo(camera.toScreenX(placed.x[slot]), camera.toScreenY(placed.y[slot]));
        ctx.stroke();
      }
    });
    ctx.globalAlpha = 1;
  }

  private drawReadings(ctx: CanvasRenderingContext2D, camera: Camera, placed: Placed, layers: Layers): void {
    if (layers.scans === 'off') return;
    const primary = this.selection.primary;
    this.model.robots.forEach((robot, slot) => {
      if (!this.shown(robot, layers) || (placed.flags[slot] & RobotFlag.known) === 0) return;
      if ((placed.flags[slot] & RobotFlag.stale) !== 0) return;
      const strong = slot === primary;
      if (!strong && (layers.scans === 'selected' || robot.kind !== 'real')) return;
      const ink = this.palette.hue(slot).ink;
      for (const index of drawnSensors(robot)) {
        const sensor = robot.sensors[index];
        const reading = this.model.readings.of(slot, index);
        if (reading === null) continue;
        const age_s = placed.time_s - reading.stamp_s;
        const fresh = age_s <= Math.max(1, 3 * sensor.period_s);
        // What is old is faint where it is looked at, and gone elsewhere.
        if (!fresh && (!strong || age_s > kOldest_s)) continue;
        const mount = mountOf(placed, slot, sensor);
        if (sensor.kind === 'sightings') {
          if (layers.sightings) drawSightings(ctx, camera, mount, reading, ink);
          continue;
        }
        drawScan(ctx, camera, mount, sensor, reading, strong ? this.palette.hue(slot).fill : ink, strong && fresh);
        if (fresh && layers.hits && this.surface !== null && camera.scale >= kFar_px) {
          drawHits(ctx, camera, mount, sensor, reading, slot, this.surface, this.palette);
        }
      }
    });
  }

  private drawRobots(
    ctx: CanvasRenderingContext2D, camera: Camera, placed: Placed, layers: Layers, far: boolean,
  ): void {
    if (far) this.drawArrowheads(ctx, camera, placed, layers);
    this.model.robots.forEach((robot, slot) => {
      if (!this.shown(robot, layers) || (placed.flags[slot] & RobotFlag.known) === 0) return;
      if (far && !this.outstanding(robot, slot, placed)) return;
      this.drawRobot(ctx, camera, placed, slot, robot);
    });
  }

  /** Real, selected, stale, stopped and marked robots are drawn whole from any distance. */
  private outstanding(robot: Robot, slot: number, placed: Placed): boolean {
    return (
      robot.kind === 'real' || robot.word !== '' || this.selection.has(slot) || this.selection.hovered === slot ||
      (placed.flags[slot] & (RobotFlag.stale | RobotFlag.stopped)) !== 0
    );
  }

  private drawArrowheads(ctx: CanvasRenderingContext2D, camera: Camera, placed: Placed, layers: Layers): void {
    ctx.beginPath();
    this.model.robots.forEach((robot, slot) => {
      if (!this.shown(robot, layers) || (placed.flags[slot] & RobotFlag.known) === 0) return;
      if (this.outstanding(robot, slot, placed)) return;
      const x = camera.toScreenX(placed.x[slot]);
      const y = camera.toScreenY(placed.y[slot]);
      if (x < -20 || y < -20 || x > camera.width + 20 || y > camera.height + 20) return;
      const r = Math.min(Math.max(this.outlines[slot].radius * camera.scale, 4), 14);
      const c = Math.cos(placed.yaw[slot]);
      const s = -Math.sin(placed.yaw[slot]);
      ctx.moveTo(x + r * c, y + r * s);
      ctx.lineTo(x - 0.8 * r * c - 0.65 * r * s, y - 0.8 * r * s + 0.65 * r * c);
      ctx.lineTo(x - 0.45 * r * c, y - 0.45 * r * s);
      ctx.lineTo(x - 0.8 * r * c + 0.65 * r * s, y - 0.8 * r * s - 0.65 * r * c);
      ctx.closePath();
    });
    ctx.fillStyle = withAlpha(this.palette.token('sim'), 0.22);
    ctx.fill();
    ctx.strokeStyle = this.palette.token('sim-ink');
    ctx.lineWidth = 1;
    ctx.stroke();
  }

  private drawRobot(
    ctx: CanvasRenderingContext2D, camera: Camera, placed: Placed, slot: number, robot: Robot,
  ): void {
    const outline = this.outlines[slot];
    const flags = placed.flags[slot];
    const x = camera.toScreenX(placed.x[slot]);
    const y = camera.toScreenY(placed.y[slot]);
    // A robot that matters keeps a width of 15 pixels.
    const grow = Math.max(1, 7.5 / Math.max(outline.radius * camera.scale, 1e-6));
    const scale = camera.scale * grow;
    const r = outline.radius * scale;
    const hue = this.palette.hue(slot);
    const stale = (flags & RobotFlag.stale) !== 0;
    if (this.selection.has(slot)) this.drawRing(ctx, x, y, r + 5, true);
    else if (this.selection.hovered === slot) this.drawRing(ctx, x, y, r + 4, false);
    ctx.save();
    ctx.translate(x, y);
    ctx.rotate(-placed.yaw[slot]);
    ctx.save();
    ctx.scale(scale, -scale);
    ctx.lineWidth = 1.5 / scale;
    if (stale) ctx.setLineDash([3 / scale, 3 / scale]);
    if (robot.kind === 'real' && !stale) {
      ctx.fillStyle = hue.fill;
      ctx.fill(outline.path);
      ctx.lineWidth = 1.25 / scale;
      ctx.strokeStyle = this.palette.theme === 'light' ? hue.ink : hue.fill;
    } else {
      const name = this.palette.hueName(slot);
      ctx.fillStyle = stale ? 'transparent' : this.palette.token(`${name}-fill`) || this.palette.token('floor');
      ctx.fill(outline.path);
      ctx.strokeStyle = hue.ink;
    }
    ctx.stroke(outline.path);
    ctx.restore();
    this.drawHeading(ctx, r, robot, stale ? null : hue.ink);
    ctx.restore();
    if (stale) this.drawReach(ctx, x, y, r);
    if ((flags & RobotFlag.stopped) !== 0) this.drawStopped(ctx, x + 0.75 * r, y - 0.75 * r);
  }

  private drawHeading(ctx: CanvasRenderingContext2D, r: number, robot: Robot, ink: string | null): void {
    if (ink === null) return;
    ctx.beginPath();
    if (robot.kind === 'real') {
      ctx.moveTo(0, 0);
      ctx.arc(0, 0, 0.92 * r, -0.42, 0.42);
      ctx.closePath();
      ctx.fillStyle = '#ffffff';
      ctx.fill();
      return;
    }
    ctx.moveTo(0, 0);
    ctx.lineTo(0.9 * r, 0);
    ctx.strokeStyle = ink;
    ctx.lineWidth = 1.5;
    ctx.stroke();
  }

  private drawRing(ctx: CanvasRenderingContext2D, x: number, y: number, r: number, selected: boolean): void {
    const intent = this.palette.token('intent');
    ctx.beginPath();
    ctx.arc(x, y, r, 0, 2 * Math.PI);
    if (selected) {
      ctx.strokeStyle = withAlpha(intent, 0.22);
      ctx.lineWidth = 9;
      ctx.stroke();
    }
    ctx.strokeStyle = selected ? intent : this.palette.token('text-3');
    ctx.lineWidth = selected ? 2 : 1;
    ctx.stroke();
  }

  private drawReach(ctx: CanvasRenderingContext2D, x: number, y: number, r: number): void {
    ctx.save();
    ctx.setLineDash([2, 4]);
    ctx.strokeStyle = this.palette.token('stale-ink');
    ctx.beginPath();
    ctx.arc(x, y, r + 12, 0, 2 * Math.PI);
    ctx.stroke();
    ctx.restore();
  }

  private drawStopped(ctx: CanvasRenderingContext2D, x: number, y: number): void {
    ctx.fillStyle = this.palette.token('stop-fill');
    ctx.beginPath();
    for (let i = 0; i < 8; ++i) {
      const a = (Math.PI / 4) * (i + 0.5);
      ctx.lineTo(x + 7 * Math.cos(a), y + 7 * Math.sin(a));
    }
    ctx.closePath();
    ctx.fill();
    ctx.fillStyle = '#ffffff';
    ctx.fillRect(x - 3.5, y - 1, 7, 2);
  }

  private drawNames(
    ctx: CanvasRenderingContext2D, camera: Camera, placed: Placed, layers: Layers, far: boolean,
  ): void {
    const placer = new LabelPlacer(camera.width, camera.height);
    const labels: Label[] = [];
    const primary = this.selection.primary;
    const near = camera.scale >= kNearNames_px || placed.count <= 40;
    this.model.robots.forEach((robot, slot) => {
      const flags = placed.flags[slot];
      if (!this.shown(robot, layers) || (flags & RobotFlag.known) === 0) return;
      const x = camera.toScreenX(placed.x[slot]);
      const y = camera.toScreenY(placed.y[slot]);
      const r = Math.max(this.outlines[slot].radius * camera.scale, 5);
      if (!far) placer.block(x, y, 0.8 * r);
      const stands = this.outstanding(robot, slot, placed);
      if (!stands && (far || !near)) return;
      const stale = (flags & RobotFlag.stale) !== 0;
      const marked = robot.kind === 'real' || robot.word !== '';
      labels.push({
        text: robot.name,
        x,
        y,
        gap: r + (this.selection.has(slot) ? 9 : 4),
        colour: marked ? this.palette.hue(slot).ink : this.palette.token('sim-ink'),
        weight: marked ? 600 : 400,
        rank: slot === primary ? 0 : robot.kind === 'real' ? 1 : robot.word !== '' ? 2 : stale ? 3 : 5,
      });
    });
    for (const [kind, group] of this.groups) {
      if (layers.hidden.includes(kind as Kind) || kind === 'wall') continue;
      if (kind === 'landmark' && !near) continue;
      for (const body of group.bodies) {
        const r = radiusOf(body.shapes) * camera.scale;
        const virtual = kind === 'virtual';
        labels.push({
          text: virtual ? body.name : shortName(body.name),
          x: camera.toScreenX(body.pose[0]),
          y: camera.toScreenY(body.pose[1]),
          gap: virtual ? r * 0.75 : Math.max(r, 4) + 3,
          colour: this.palette.token(virtual ? 'virtual-ink' : 'landmark-ink'),
          weight: 500,
          rank: virtual ? 4 : 6,
          below: virtual,
        });
        if (!virtual) placer.block(labels[labels.length - 1].x, labels[labels.length - 1].y, 4);
      }
    }
    placer.draw(ctx, labels, this.palette.token('floor'));
  }
}

/** `tube-14` is `14` where there are many of them. */
function shortName(name: string): string {
  return /-(\d+)$/.exec(name)?.[1] ?? name;
}

/** Lines at 45 degrees every 7 pixels. */
function makeHatch(ctx: CanvasRenderingContext2D, colour: string): CanvasPattern | null {
  const size = 10;
  const tile = document.createElement('canvas');
  tile.width = tile.height = size;
  const pen = tile.getContext('2d');
  if (pen === null) return null;
  pen.strokeStyle = colour;
  pen.lineWidth = 1.1;
  pen.globalAlpha = 0.75;
  pen.beginPath();
  for (const shift of [-size, 0, size]) {
    pen.moveTo(shift - 1, size + 1);
    pen.lineTo(shift + size + 1, -1);
  }
  pen.stroke();
  return ctx.createPattern(tile, 'repeat');
}
