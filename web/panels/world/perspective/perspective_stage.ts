// SPDX-License-Identifier: Apache-2.0
import {
  AmbientLight,
  BasicShadowMap,
  Color,
  ColorManagement,
  DirectionalLight,
  Fog,
  LinearSRGBColorSpace,
  PCFSoftShadowMap,
  Scene,
  WebGLRenderer,
} from 'three';
import {RobotFlag} from '../../../protocol/frames';
import {boundsOfAll, boundsOfBodies, union, type BodyBounds} from '../bounds';
import type {Bounds} from '../camera';
import {hasCard} from '../graphics_card';
import {radiusOf} from '../outlines';
import {bytesOf, rampBytes} from '../ramp';
import {shownReadings} from '../reading_layer';
import {drawBox, slotsIn, type SelectionBox} from '../selection_box';
import type {Extent, Fitted, Stage, StageContext} from '../stage';
import {Surface} from '../surface';
import type {Tone} from '../swarm';
import {Tint} from '../tint';
import {writeDoubts} from './doubt_marks';
import {FlatLayer} from './flat_layer';
import {Floor} from './floor';
import {writeRings, writeScans, writeTrails} from './floor_marks';
import {GlassRobots} from './glass_robots';
import {MapPlane} from './map_plane';
import {Orbit} from './orbit';
import {OrbitGestures} from './orbit_gestures';
import {Overlay} from './overlay';
import {topOf} from './prism';
import {SolidRobots} from './solid_robots';
import {StandingBodies} from './standing_bodies';

const kShadow_px = 1024;
/** Pixels of the picture to a pixel of the screen where the processor draws them. */
const kRough = 0.7;
const kFine = 1.6;
const kStill_ms = 300;
const kFinger_px = 22;
/** From so far away a single robot is looked at. */
const kClose_m = 4;
const kMouse_px = 10;

// Colours are those of the tokens, mixed as a 2-D canvas mixes them.
ColorManagement.enabled = false;

/** The world in perspective: one scene of the same data that the top view draws. */
export class PerspectiveStage implements Stage {
  readonly element = document.createElement('div');
  // Without a graphics card the processor draws, and smoothing would slow it down further.
  private readonly renderer = new WebGLRenderer({
    antialias: hasCard(),
    preserveDrawingBuffer: false,
  });
  private readonly over = document.createElement('canvas');
  private readonly scene = new Scene();
  private readonly orbit = new Orbit();
  private readonly sun = new DirectionalLight('#ffffff', 2.2);
  private readonly floor = new Floor();
  private readonly maps = new MapPlane();
  private readonly bodies = new StandingBodies();
  private readonly solid = new SolidRobots();
  private readonly glass = new GlassRobots();
  private readonly scans = new FlatLayer(0.006, 1);
  private readonly trails = new FlatLayer(0.009, 1);
  private readonly rings = new FlatLayer(0.012, 2);
  private readonly doubts = new FlatLayer(0.0105, 2);
  private readonly overlay: Overlay;
  private readonly gestures: OrbitGestures;
  private readonly tint = new Tint();
  private surface: Surface | null = null;
  private radii: number[] = [];
  private ratio = 0;
  private sharpen = 0;
  private tinted = '';
  private floorKey = '';
  private boxes: BodyBounds = {walls: null, others: null};
  /** What the picture was fitted to last. */
  private fittedTo: Bounds | null = null;

  constructor(private readonly context: StageContext) {
    this.element.className = 'stage-3d';
    this.element.append(this.renderer.domElement, this.over);
    this.renderer.outputColorSpace = LinearSRGBColorSpace;
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = hasCard() ? PCFSoftShadowMap : BasicShadowMap;
    this.sun.castShadow = true;
    this.sun.shadow.mapSize.set(kShadow_px, kShadow_px);
    this.sun.shadow.bias = -0.001;
    this.scene.add(
      new AmbientLight('#ffffff', 1.5),
      this.sun,
      this.sun.target,
      this.floor.group,
      this.maps.group,
      this.bodies.group,
      this.solid.group,
      this.glass.group,
      this.scans.mesh,
      this.trails.mesh,
      this.doubts.mesh,
      this.rings.mesh,
    );
    this.overlay = new Overlay(context, this.orbit);
    this.gestures = new OrbitGestures(this.element, context, this.orbit, this);
  }

  refresh(): void {
    const {model, palette} = this.context;
    palette.assign(model.robots);
    this.radii = model.robots.map((robot) => radiusOf(robot.shapes));
    this.tint.refresh(model.robots);
    this.surface = new Surface(model.bodies.values(), model.robots, palette);
    this.boxes = boundsOfBodies(model.bodies.values());
    this.bodies.refresh(model.bodies.values(), palette);
    this.solid.refresh(model.robots, palette);
    this.glass.refresh(model.robots);
    this.overlay?.refresh();
    this.tinted = this.floorKey = '';
  }

  resize(width: number, height: number): void {
    this.setRatio(hasCard() ? devicePixelRatio : kRough);
    this.renderer.setSize(width, height, false);
    this.over.width = Math.round(width * devicePixelRatio);
    this.over.height = Math.round(height * devicePixelRatio);
    this.orbit.resize(width, height);
    this.bodies.resize(width, height);
  }

  private setRatio(ratio: number): void {
    if (ratio === this.ratio) return;
    this.ratio = ratio;
    this.renderer.setPixelRatio(ratio);
    this.bodies.setRatio(ratio);
  }

  /** Without a graphics card what moves is drawn roughly, and what stands is drawn once more,
   * finely. */
  private chooseRatio(moves: boolean): void {
    if (hasCard() || (!moves && this.ratio === kFine)) return;
    if (moves) {
      this.setRatio(kRough);
      clearTimeout(this.sharpen);
      this.sharpen = 0;
    }
    // Pictures of a run that is held continue, and must not put it off.
    if (this.sharpen !== 0) return;
    this.sharpen = window.setTimeout(() => {
      this.sharpen = 0;
      this.setRatio(kFine);
      this.context.redraw();
    }, kStill_ms);
  }

  paint(now_ms: number): boolean {
    const {context, orbit} = this;
    const {placed, selection, model} = context;
    const layers = context.layers();
    const primary = selection.primary;
    if (selection.following && primary !== null && primary < placed.count)
      [orbit.eye.x, orbit.eye.y] = [placed.x[primary], placed.y[primary]];
    const going = orbit.advance(now_ms);
    this.chooseRatio(going || model.poses.moving(now_ms));
    const shown = (slot: number) => !layers.hidden.includes(model.robots[slot].kind);
    this.setFloor();
    this.floor.show(layers.grid);
    this.maps.update(model.maps, this.context.palette);
    this.bodies.show(layers);
    this.solid.update(placed, shown);
    this.glass.update(placed, shown);
    this.setTint();
    if (this.surface !== null) this.surface.placed = placed;
    const readings = shownReadings(model, selection, placed, layers);
    writeScans(this.scans, context, readings);
    writeTrails(this.trails, context, model.poses, (slot) => layers.trails && shown(slot));
    writeDoubts(this.doubts, context, orbit);
    writeRings(this.rings, context, (slot) => this.radii[slot] ?? 0.2);
    this.renderer.render(this.scene, orbit.camera);
    const ctx = this.over.getContext('2d');
    if (ctx !== null) {
      ctx.setTransform(devicePixelRatio, 0, 0, devicePixelRatio, 0, 0);
      ctx.clearRect(0, 0, orbit.width, orbit.height);
      this.overlay.draw(ctx, readings, this.surface, shown);
      if (this.gestures.box !== null) drawBox(ctx, this.context.palette, this.gestures.box);
    }
    return going;
  }

  /** Floor, fog and sun fit the world; made anew when that grows or the theme changes. */
  private setFloor(): void {
    const bounds = this.bounds('room');
    if (bounds === null) return;
    const {palette} = this.context;
    const round = (value: number) => Math.round(value / 10);
    // In steps of 10 m, or the floor would be made anew with each step of the outermost robot.
    const key = [
      round(bounds.x0),
      round(bounds.y0),
      round(bounds.x1),
      round(bounds.y1),
      palette.theme,
    ].join();
    const size = Math.max(bounds.x1 - bounds.x0, bounds.y1 - bounds.y0, 4);
    const fog = this.scene.fog as Fog | null;
    if (fog !== null) {
      fog.near = this.orbit.eye.distance + 0.6 * size;
      fog.far = this.orbit.eye.distance + 3 * size;
    }
    if (key === this.floorKey) return;
    this.floorKey = key;
    this.floor.refresh(bounds, palette);
    this.scene.background = new Color(palette.token('floor-far'));
    this.scene.fog = new Fog(
      palette.token('floor-far'),
      this.orbit.eye.distance + 0.6 * size,
      this.orbit.eye.distance + 3 * size,
    );
    const [x, y] = [(bounds.x0 + bounds.x1) / 2, (bounds.y0 + bounds.y1) / 2];
    this.sun.target.position.set(x, y, 0);
    this.sun.position.set(x - 0.55 * size, y - 0.1 * size, 0.9 * size);
    const reach = 0.75 * size;
    Object.assign(this.sun.shadow.camera, {
      left: -reach,
      right: reach,
      top: reach,
      bottom: -reach,
      near: 0.05 * size,
      far: 3 * size,
    });
    this.sun.shadow.camera.updateProjectionMatrix();
  }

  /** Colours of glass robots change only by the layer menu, and with what they are coloured by. */
  private setTint(): void {
    const {palette, model, placed} = this.context;
    const by = this.context.layers().colourBy;
    const ghost = (slot: number) =>
      slot < placed.count && (placed.flags[slot] & RobotFlag.stale) !== 0;
    let ghosts = 0;
    // A sum that differs for each set of ghosts.
    for (let slot = 0; slot < placed.count; ++slot)
      if (ghost(slot)) ghosts = (31 * ghosts + slot + 1) % 1e9;
    const fixed = `${by} ${palette.theme} ${ghosts}`;
    // Colours by a value that changes are renewed four times a second of the run, not in each
    // frame.
    const key =
      by === 'kind' || by === 'team' ? fixed : `${fixed} ${Math.floor(placed.time_s * 4)}`;
    if (key === this.tinted) return;
    this.tinted = key;
    const speeds = model.poses.newest?.speed;
    this.glass.tint((slot): Tone => {
      const share = by === 'kind' ? null : this.tint.share(by, slot, placed, speeds);
      return share === null ? bytesOf(palette.hue(slot).ink) : rampBytes(share, palette.theme);
    }, ghost);
  }

  fit(animate: boolean, what: Extent): Fitted {
    const bounds = what === 'more' ? union(this.bounds('room'), this.fittedTo) : this.bounds(what);
    if (bounds === null) return 'nothing';
    this.fittedTo = bounds;
    const {placed, selection} = this.context;
    const primary = selection.primary;
    const {x, y, distance} = this.orbit.eye;
    const goal = this.orbit.fitted(bounds);
    const there =
      Math.hypot(goal.x - x, goal.y - y) < 1e-6 && Math.abs(goal.distance / distance - 1) < 1e-6;
    const close = what === 'closer' && there && primary !== null && primary < placed.count;
    this.orbit.go(
      close ? {...goal, x: placed.x[primary], y: placed.y[primary], distance: kClose_m} : goal,
      performance.now(),
      animate,
    );
    return close ? 'selection' : 'all';
  }

  private bounds(what: Extent): Bounds | null {
    return boundsOfAll(
      this.context.placed,
      (slot) => this.radii[slot] ?? 0,
      this.boxes,
      what !== 'room',
    );
  }

  slotAt(px: number, py: number): number | null {
    const {placed, model} = this.context;
    const touch = matchMedia('(pointer: coarse)').matches ? kFinger_px : kMouse_px;
    let best: number | null = null;
    let least = Infinity;
    for (let slot = 0; slot < placed.count; ++slot) {
      if ((placed.flags[slot] & RobotFlag.known) === 0) continue;
      const at = this.orbit.project(
        placed.x[slot],
        placed.y[slot],
        0.4 * topOf(model.robots[slot].shapes),
      );
      if (at === null) continue;
      const reach = Math.max(this.radii[slot] * this.orbit.pixelsPerMetre(at.distance), touch);
      if (Math.hypot(at.x - px, at.y - py) > reach || at.distance > least) continue;
      least = at.distance;
      best = slot;
    }
    return best;
  }

  slotsIn(box: SelectionBox): number[] {
    const {placed} = this.context;
    return slotsIn(box, placed, (slot) => {
      const at = this.orbit.project(placed.x[slot], placed.y[slot], 0);
      return at === null ? null : [at.x, at.y];
    });
  }

  screenOf(slot: number): [number, number] {
    const {placed} = this.context;
    const at = this.orbit.project(placed.x[slot], placed.y[slot], 0);
    return at === null ? [-1, -1] : [at.x, at.y];
  }

  viewpoint(): string {
    const {x, y, distance, yaw, pitch} = this.orbit.eye;
    return ['3d', ...[x, y, distance, yaw, pitch].map((value) => value.toFixed(3))].join(',');
  }

  lookFrom(text: string): void {
    const [x, y, distance, yaw, pitch] = text.split(',').slice(1).map(Number);
    if ([x, y, distance, yaw, pitch].every(Number.isFinite) && distance > 0)
      this.orbit.go({x, y, distance, yaw, pitch}, performance.now(), false);
  }

  nudge(dx: number, dy: number): void {
    this.orbit.pan(-dx, -dy);
    this.context.selection.follow(false);
    this.context.moved();
    this.context.redraw();
  }

  zoomBy(factor: number): void {
    this.orbit.zoom(factor);
    this.context.moved();
    this.context.redraw();
  }

  turn(dx: number, dy: number): void {
    this.orbit.rotate(-dx, -dy);
    this.context.moved();
    this.context.redraw();
  }

  drop(): boolean {
    return this.gestures.drop();
  }

  snapshot(): HTMLCanvasElement {
    const picture = document.createElement('canvas');
    [picture.width, picture.height] = [this.over.width, this.over.height];
    // preserveDrawingBuffer is off, so the picture of WebGL can only be read right after it was
    // painted, in the same task.
    this.paint(performance.now());
    const ctx = picture.getContext('2d');
    ctx?.drawImage(this.renderer.domElement, 0, 0, picture.width, picture.height);
    ctx?.drawImage(this.over, 0, 0);
    return picture;
  }

  dispose(): void {
    clearTimeout(this.sharpen);
    this.element.remove();
    this.maps.clear();
    this.renderer.dispose();
  }
}
