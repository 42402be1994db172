// SPDX-License-Identifier: Apache-2.0
import {sightingsOf} from '../../../model/sightings';
import {RobotFlag} from '../../../protocol/frames';
import {bodyState} from '../body_state';
import {kFont, LabelPlacer, type Label} from '../labels';
import {robotLabel, shortName} from '../name_layer';
import {boxOf} from '../outlines';
import type {Shown} from '../reading_layer';
import {drawStopped} from '../robot_layer';
import {bearingsOf, drawMark, mountOf} from '../scan_layer';
import type {StageContext} from '../stage';
import {bothKnown, drawTrueCross} from '../truth_layer';
import {pointSurface, type Surface} from '../surface';
import {GhostOverlay} from './ghost_overlay';
import type {Orbit} from './orbit';
import {topOf} from './prism';

/** Names of simulated robots fade between these distances from the eye, metres. */
const kFadeFrom_m = 10.5;
const kFadeTo_m = 13.5;
const kMostNames = 400;
const kGizmo_px = 74;

/** Names, marks and signs over the picture in perspective; none of them scales. */
export class Overlay {
  private readonly ghosts: GhostOverlay;

  constructor(
    private readonly context: StageContext,
    private readonly orbit: Orbit,
  ) {
    this.ghosts = new GhostOverlay(context, orbit);
  }

  /** The roster changed. */
  refresh(): void {
    this.ghosts.refresh();
  }

  draw(
    ctx: CanvasRenderingContext2D,
    readings: readonly Shown[],
    surface: Surface | null,
    shown: (slot: number) => boolean,
  ): void {
    const layers = this.context.layers();
    for (const one of readings) {
      if (one.sensor.kind === 'sightings') {
        if (layers.sightings) this.drawSightings(ctx, one);
      } else if (one.fresh && layers.hits && surface !== null) this.drawHits(ctx, one, surface);
    }
    this.drawTruth(ctx, shown);
    this.ghosts.draw(ctx, shown);
    const placer = new LabelPlacer(this.orbit.width, this.orbit.height);
    const labels = [...this.robotLabels(ctx, shown), ...this.bodyLabels()];
    placer.draw(
      ctx,
      layers.names ? labels : labels.filter((label) => label.always),
      this.context.palette.token('floor'),
    );
    this.drawGizmo(ctx);
  }

  /** A cross where a robot truly is, joined to where it says it is. */
  private drawTruth(ctx: CanvasRenderingContext2D, shown: (slot: number) => boolean): void {
    const {placed, truth, palette} = this.context;
    for (let slot = 0; slot < Math.min(truth.count, placed.count); ++slot) {
      if (!bothKnown(placed, truth, slot) || !shown(slot)) continue;
      const at = this.orbit.project(truth.x[slot], truth.y[slot], 0);
      const told = this.orbit.project(placed.x[slot], placed.y[slot], 0);
      if (at !== null && told !== null) drawTrueCross(ctx, palette, [told.x, told.y], [at.x, at.y]);
    }
  }

  private robotLabels(ctx: CanvasRenderingContext2D, shown: (slot: number) => boolean): Label[] {
    const {model, placed, selection, palette} = this.context;
    const labels: Label[] = [];
    // Of many robots only those that matter are named.
    const all = model.robots.length <= kMostNames;
    model.robots.forEach((robot, slot) => {
      if (slot >= placed.count || (placed.flags[slot] & RobotFlag.known) === 0 || !shown(slot))
        return;
      const state = bodyState(robot.kind, placed.flags[slot]);
      const marked =
        robot.kind === 'real' ||
        robot.word !== '' ||
        selection.has(slot) ||
        selection.hovered === slot ||
        state !== 'plain';
      const stopped = (placed.flags[slot] & RobotFlag.stopped) !== 0;
      if (!marked && !all) return;
      const top = this.orbit.project(placed.x[slot], placed.y[slot], topOf(robot.shapes));
      if (top === null) return;
      const share = (kFadeTo_m - top.distance) / (kFadeTo_m - kFadeFrom_m);
      const alpha = marked ? 1 : Math.min(Math.max(share, 0), 1);
      if (stopped && alpha > 0) drawStopped(ctx, top.x + 12, top.y - 6, palette);
      if (alpha === 0) return;
      const label = robotLabel(
        robot,
        slot,
        placed.flags[slot],
        top.x,
        top.y - 17,
        0,
        selection,
        palette,
      );
      if (state === 'stale')
        label.text += `  ${(placed.time_s - placed.freshAt(slot)).toFixed(1)} s`;
      if (state === 'unarmed') label.text += '  arm';
      if (state !== 'plain') label.colour = palette.token(state === 'stale' ? 'stale-ink' : 'warn');
      labels.push({...label, gap: 0, below: true, alpha});
    });
    return labels;
  }

  private bodyLabels(): Label[] {
    const {model, palette} = this.context;
    const layers = this.context.layers();
    const labels: Label[] = [];
    for (const body of model.bodies.values()) {
      if (body.kind === 'wall' || layers.hidden.includes(body.kind)) continue;
      const {x, y} = boxOf(body);
      const at = this.orbit.project(x, y, topOf(body.shapes));
      if (at === null) continue;
      const virtual = body.kind === 'virtual';
      const alpha = virtual ? 1 : Math.min(Math.max((1.6 * kFadeTo_m - at.distance) / 3, 0), 1);
      if (alpha === 0) continue;
      labels.push({
        text: virtual ? body.name : shortName(body.name),
        x: at.x,
        y: at.y - (virtual ? 0 : 16),
        gap: 0,
        below: true,
        alpha,
        colour: palette.token(virtual ? 'virtual-ink' : 'landmark-ink'),
        weight: 500,
        rank: virtual ? 4 : 6,
      });
    }
    return labels;
  }

  private drawHits(
    ctx: CanvasRenderingContext2D,
    {slot, sensor, reading}: Shown,
    surface: Surface,
  ): void {
    const {placed, palette} = this.context;
    const mount = mountOf(placed, slot, sensor);
    const bearings = bearingsOf(sensor, reading.rows);
    const max = sensor.range?.[1] ?? Infinity;
    for (let i = 0; i < reading.rows; ++i) {
      const r = reading.values[i];
      if (!(r < max)) continue;
      const x = mount.x + r * Math.cos(mount.yaw + bearings[i]);
      const y = mount.y + r * Math.sin(mount.yaw + bearings[i]);
      const hit = pointSurface(surface, x, y, slot);
      const at = hit === null ? null : this.orbit.project(x, y, Math.min(sensor.z, 0.12));
      if (hit === null || at === null) continue;
      ctx.fillStyle = palette.token(hit.token);
      drawMark(ctx, hit.mark, at.x, at.y, 2.4);
    }
  }

  private drawSightings(
    ctx: CanvasRenderingContext2D,
    {slot, sensor, reading, strength}: Shown,
  ): void {
    const {placed, palette} = this.context;
    const mount = mountOf(placed, slot, sensor);
    const from = this.orbit.project(mount.x, mount.y, sensor.z);
    if (from === null) return;
    ctx.strokeStyle = palette.hue(slot).ink;
    ctx.lineWidth = 1;
    for (const {range_m, bearing_rad} of sightingsOf(sensor, reading)) {
      const a = mount.yaw + bearing_rad;
      const to = this.orbit.project(
        mount.x + range_m * Math.cos(a),
        mount.y + range_m * Math.sin(a),
        sensor.z,
      );
      if (to === null) continue;
      ctx.globalAlpha = 0.6 * strength;
      ctx.beginPath();
      ctx.moveTo(from.x, from.y);
      ctx.lineTo(to.x, to.y);
      ctx.stroke();
      ctx.globalAlpha = strength;
      ctx.beginPath();
      ctx.arc(to.x, to.y, 4, 0, 2 * Math.PI);
      ctx.stroke();
    }
    ctx.globalAlpha = 1;
  }

  /** Where x, y and z point. */
  private drawGizmo(ctx: CanvasRenderingContext2D): void {
    const {palette} = this.context;
    const {orbit} = this;
    if (orbit.width < 520) return;
    const x0 = orbit.width - kGizmo_px - 12;
    const y0 = orbit.height - kGizmo_px - 12;
    ctx.fillStyle = palette.token('bg-1');
    ctx.strokeStyle = palette.token('line-1');
    ctx.lineWidth = 1;
    ctx.beginPath();
    ctx.roundRect(x0 + 0.5, y0 + 0.5, kGizmo_px, kGizmo_px, 6);
    ctx.fill();
    ctx.stroke();
    const {yaw, pitch} = orbit.eye;
    const [ox, oy] = [x0 + kGizmo_px / 2 - 2, y0 + kGizmo_px / 2 + 6];
    const axes: [string, number, number][] = [
      ['x', -Math.sin(yaw), Math.cos(yaw) * Math.sin(pitch)],
      ['y', Math.cos(yaw), Math.sin(yaw) * Math.sin(pitch)],
      ['z', 0, -Math.cos(pitch)],
    ];
    ctx.font = `600 10px ${kFont}`;
    ctx.textAlign = 'center';
    ctx.textBaseline = 'middle';
    for (const [name, dx, dy] of axes) {
      ctx.strokeStyle = palette.token('text-2');
      ctx.beginPath();
      ctx.moveTo(ox, oy);
      ctx.lineTo(ox + 18 * dx, oy + 18 * dy);
      ctx.stroke();
      ctx.fillStyle = palette.token('text-2');
      ctx.fillText(name, ox + 26 * dx, oy + 26 * dy);
    }
  }
}
