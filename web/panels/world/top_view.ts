// SPDX-License-Identifier: Apache-2.0
import type {Placed} from '../../model/pose_history';
import type {RunModel} from '../../model/run_model';
import type {Palette, Selection} from '../../panel_api';
import {RobotFlag, type PoseFrame} from '../../protocol/frames';
import type {Robot} from '../../protocol/messages';
import {BodyLayer} from './body_layer';
import type {Camera} from './camera';
import {drawContactTags} from './contact_tags';
import {Density} from './density';
import {drawGrid, drawScale, drawTicks} from './grid_layer';
import {LabelPlacer} from './labels';
import type {Layers} from './layers';
import {bodyLabels, namesFit, robotLabels} from './name_layer';
import type {OrderLayer} from './orders/order_layer';
import {drawPlates, teamsOf, type Team} from './plates';
import {bytesOf, rampBytes, rampColour} from './ramp';
import {drawReadings} from './reading_layer';
import {drawMap} from './draw_map';
import {RobotLayer} from './robot_layer';
import {Surface} from './surface';
import {kTailParts, type Swarm, type Tone} from './swarm';
import {Tint} from './tint';
import {drawTrail, kTrail_s, trailFrames} from './trail_layer';
import {drawShadows} from './shadow_layer';
import {drawTruth} from './truth_layer';
import {drawVariances} from './variance_layer';

/** Below this many pixels per metre, or beyond this number of robots in the picture, simulated ones
 * are arrowheads. */
const kFar_px = 30;
const kMany = 400;
/** Tails of more robots have fewer parts. */
const kManyTails = 3000;
const kFarTrail_s = 4;
const kCrowd = 200;
const kCount_ms = 250;
/** Share of the colour of an arrowhead inside it; the rest is floor. */
const kInside = 0.22;

/** Who is in a picture, and how. */
interface Cast {
  far: boolean;
  /** Drawn one by one. */
  whole: number[];
  /** Drawn as arrowheads. */
  swarm: number[];
}

/** Draws the world from above. Keeps what does not change from picture to picture. */
export class TopView {
  readonly bodies: BodyLayer;
  readonly robots: RobotLayer;
  readonly tint = new Tint();
  private readonly density = new Density();
  private surface: Surface | null = null;
  private counted: {at_ms: number; robots: readonly Robot[]; teams: Team[]} = {
    at_ms: -Infinity,
    robots: [],
    teams: [],
  };

  constructor(
    private readonly model: RunModel,
    private readonly palette: Palette,
    private readonly selection: Selection,
  ) {
    this.bodies = new BodyLayer(palette);
    this.robots = new RobotLayer(palette, selection);
  }

  /** The roster, the bodies or the theme changed. */
  refresh(): void {
    const {robots, bodies} = this.model;
    this.palette.assign(robots);
    this.robots.refresh(robots);
    this.tint.refresh(robots);
    this.bodies.refresh(bodies.values());
    this.surface = new Surface(bodies.values(), robots, this.palette);
  }

  /** Floor, grid, crowd, bodies and the map that is shown over them: what stands still as long as
   * the camera does. */
  drawBase(ctx: CanvasRenderingContext2D, camera: Camera, placed: Placed, layers: Layers): void {
    ctx.fillStyle = this.palette.token('floor');
    ctx.fillRect(0, 0, camera.width, camera.height);
    if (layers.grid) drawGrid(ctx, camera, this.palette);
    if (this.crowded(camera, placed, layers))
      this.density.draw(ctx, camera, placed, this.palette.token('text-2'));
    this.bodies.draw(ctx, camera, layers);
    const {overlay} = this.model.maps;
    const grid = overlay === null ? null : this.model.maps.of(overlay.key);
    if (overlay !== null && grid !== null)
      drawMap(ctx, camera, grid, this.palette, overlay.opacity);
    if (layers.grid) drawTicks(ctx, camera, this.palette);
    drawScale(ctx, camera, this.palette);
  }

  crowded(camera: Camera, placed: Placed, layers: Layers): boolean {
    return layers.density && camera.scale < kFar_px && placed.count > kCrowd;
  }

  /** Robots and what they read, their orders, and names over all lines. With `swarm`, far robots go
   * there; it is empty where none is far. */
  drawLife(
    ctx: CanvasRenderingContext2D,
    camera: Camera,
    placed: Placed,
    truth: Placed,
    layers: Layers,
    orders: OrderLayer,
    swarm: Swarm | null,
  ): void {
    const {model, palette, selection} = this;
    if (this.surface !== null) this.surface.placed = placed;
    const cast = this.cast(camera, placed, layers, swarm !== null);
    if (swarm !== null) this.fillSwarm(swarm, camera, placed, layers, cast.swarm);
    const frames = trailFrames(model.poses.past, placed, kTrail_s);
    if (layers.trails && frames.length > 1) {
      for (const slot of cast.whole)
        drawTrail(ctx, camera, placed, frames, slot, model.robots[slot], palette);
    }
    drawReadings(
      ctx,
      camera,
      model,
      selection,
      palette,
      placed,
      layers,
      this.surface,
      camera.scale >= kFar_px,
    );
    if (layers.uncertainty) drawVariances(ctx, camera, model, selection, palette, placed);
    if (layers.shadows && !layers.hidden.includes('real'))
      drawShadows(ctx, camera, model, selection, palette, placed, this.robots);
    const speeds = model.poses.newest?.speed;
    for (const slot of cast.whole) {
      const robot = model.robots[slot];
      const share =
        robot.kind === 'real' || layers.colourBy === 'kind'
          ? null
          : this.tint.share(layers.colourBy, slot, placed, speeds);
      this.robots.draw(
        ctx,
        camera,
        placed,
        slot,
        robot,
        share === null ? null : rampColour(share, palette.theme),
      );
    }
    if (truth.count > 0)
      drawTruth(ctx, camera, cast.whole, selection, palette, placed, truth, this.robots);
    orders.draw(ctx, camera, placed);
    this.drawNames(ctx, camera, placed, layers, cast);
  }

  /** Who is seen from this camera; all of them one by one without `arrows`. */
  private cast(camera: Camera, placed: Placed, layers: Layers, arrows: boolean): Cast {
    const seen: number[] = [];
    const margin = 40;
    for (let slot = 0; slot < placed.count; ++slot) {
      if ((placed.flags[slot] & RobotFlag.known) === 0 || !shown(this.model.robots[slot], layers))
        continue;
      const x = camera.toScreenX(placed.x[slot]);
      const y = camera.toScreenY(placed.y[slot]);
      if (x > -margin && y > -margin && x < camera.width + margin && y < camera.height + margin)
        seen.push(slot);
    }
    const far = camera.scale < kFar_px || seen.length > kMany;
    if (!far || !arrows) return {far, whole: seen, swarm: []};
    const cast: Cast = {far, whole: [], swarm: []};
    for (const slot of seen)
      (this.outstanding(this.model.robots[slot], slot, placed) ? cast.whole : cast.swarm).push(
        slot,
      );
    // A stopped swarm is a swarm: thousands drawn one by one would stop the page as well.
    if (cast.whole.length > kMany) {
      cast.swarm.push(...cast.whole.filter((slot) => !this.marked(slot)));
      cast.whole = cast.whole.filter((slot) => this.marked(slot));
    }
    return cast;
  }

  private marked(slot: number): boolean {
    const robot = this.model.robots[slot];
    return (
      robot.kind === 'real' ||
      robot.word !== '' ||
      slot === this.selection.primary ||
      this.selection.hovered === slot
    );
  }

  /** Real, selected, stale, stopped and marked robots are drawn whole from any distance. */
  private outstanding(robot: Robot, slot: number, placed: Placed): boolean {
    return (
      robot.kind === 'real' ||
      robot.word !== '' ||
      this.selection.has(slot) ||
      this.selection.hovered === slot ||
      (placed.flags[slot] & (RobotFlag.stale | RobotFlag.stopped)) !== 0
    );
  }

  private fillSwarm(
    swarm: Swarm,
    camera: Camera,
    placed: Placed,
    layers: Layers,
    slots: readonly number[],
  ): void {
    const {palette, model} = this;
    const floor = bytesOf(palette.token('floor'));
    const mix = (tone: Tone, share: number): Tone =>
      [0, 1, 2].map((k) => Math.round(floor[k] + share * (tone[k] - floor[k]))) as unknown as Tone;
    const plain = bytesOf(palette.token('sim-ink'));
    const inside = mix(bytesOf(palette.token('sim')), kInside);
    const stop = bytesOf(palette.token('stop-fill'));
    const stopInside = mix(stop, 0.5);
    const speeds = model.poses.newest?.speed;
    swarm.begin(slots.length, camera);
    const frames = layers.trails ? this.tailFrames(placed, slots.length) : [];
    const points = new Float32Array(2 * (kTailParts + 1));
    // Written out, since it is done for each of many thousands, and for each picture.
    const {scale} = camera;
    const ox = camera.width / 2 - camera.x * scale;
    const oy = camera.height / 2 + camera.y * scale;
    const byKind = layers.colourBy === 'kind';
    for (const slot of slots) {
      const x = ox + scale * placed.x[slot];
      const y = oy - scale * placed.y[slot];
      const r = Math.min(Math.max(this.robots.radius(slot) * scale, 4), 14);
      const share = byKind ? null : this.tint.share(layers.colourBy, slot, placed, speeds);
      const stopped = (placed.flags[slot] & RobotFlag.stopped) !== 0;
      const edge = stopped ? stop : share === null ? plain : rampBytes(share, palette.theme);
      if (frames.length > 0) {
        let at = 0;
        for (const frame of frames) {
          points[at++] = ox + scale * frame.x[slot];
          points[at++] = oy - scale * frame.y[slot];
        }
        points[at++] = x;
        points[at++] = y;
        // What the arrowhead nearly hides is not drawn.
        if ((points[0] - x) ** 2 + (points[1] - y) ** 2 > 4 * r * r)
          swarm.addTail(points, at / 2, edge);
      }
      swarm.add(
        x,
        y,
        -placed.yaw[slot],
        r,
        edge,
        stopped ? stopInside : share === null ? inside : mix(edge, 0.5),
      );
    }
  }

  /** Counted a few times a second: a crowd moves slowly. */
  private teams(placed: Placed): Team[] {
    const now_ms = performance.now();
    if (now_ms - this.counted.at_ms > kCount_ms || this.counted.robots !== this.model.robots) {
      this.counted = {
        at_ms: now_ms,
        robots: this.model.robots,
        teams: teamsOf(this.model.robots, placed, this.model.poses.newest?.speed),
      };
    }
    return this.counted.teams;
  }

  /** A few moments of the last seconds, oldest first. */
  private tailFrames(placed: Placed, robots: number): PoseFrame[] {
    const all = trailFrames(this.model.poses.past, placed, kFarTrail_s);
    const parts = robots > kManyTails ? 2 : kTailParts;
    const step = Math.max(1, Math.floor(all.length / parts));
    return all.filter((_, i) => i % step === 0).slice(0, parts);
  }

  private drawNames(
    ctx: CanvasRenderingContext2D,
    camera: Camera,
    placed: Placed,
    layers: Layers,
    cast: Cast,
  ): void {
    const {model, palette, selection} = this;
    const placer = new LabelPlacer(camera.width, camera.height);
    const hovered = selection.hovered;
    if (!layers.names && (hovered === null || !cast.whole.includes(hovered))) return;
    const near = namesFit(camera, placed.count);
    const named = cast.whole.filter(
      (slot) => near || this.outstanding(model.robots[slot], slot, placed),
    );
    const labels = robotLabels(
      model.robots,
      named,
      camera,
      placed,
      (slot) => this.robots.radius(slot),
      selection,
      palette,
      placer,
    );
    if (!layers.names)
      return placer.draw(
        ctx,
        labels.filter((label) => label.always),
        palette.token('floor'),
      );
    if (cast.far && cast.swarm.length > 0)
      drawPlates(ctx, camera, this.teams(placed), palette, placer);
    if (!cast.far) drawContactTags(ctx, camera, model.events, placed, palette, placer);
    labels.push(
      ...bodyLabels(this.bodies.groups, camera, layers, near && !cast.far, palette, placer),
    );
    placer.draw(ctx, labels, palette.token('floor'));
  }
}

function shown(robot: Robot, layers: Layers): boolean {
  return !layers.hidden.includes(robot.kind);
}
