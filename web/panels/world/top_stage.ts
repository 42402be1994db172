// SPDX-License-Identifier: Apache-2.0
import type {WorldLayer} from '../../panel_api';
import {RobotFlag} from '../../protocol/frames';
import {boundsOfAll, boundsOfBodies, boundsOfRobots, union, type BodyBounds} from './bounds';
import {Camera, type Bounds} from './camera';
import {Lens} from './lens';
import {Measure} from './measure';
import {Minimap, mostAreOutside} from './minimap';
import {bodyAt, OrderHands} from './orders/order_hands';
import {kLead_s} from './orders/lead';
import {OrderLayer} from './orders/order_layer';
import type {Extent, Fitted, Stage, StageContext} from './stage';
import {makeSwarm} from './make_swarm';
import {TopGestures} from './top_gestures';
import {TopView} from './top_view';
import {drawBox, slotsIn, type SelectionBox} from './selection_box';

const kDensity_ms = 500;
const kMinimapBelow_px = 30;
const kMinimapFrom = 40;
const kFinger_px = 22;
const kMouse_px = 8;
/** Height of what names the driven robot, at the top of the picture. */
const kChip_px = 56;

/** The world from above: three canvases, of which only those are drawn whose content has
 * changed. */
export class TopStage implements Stage {
  readonly element = document.createElement('div');
  readonly camera = new Camera();
  readonly measure = new Measure();
  readonly lens = new Lens();
  private readonly view: TopView;
  private readonly base = document.createElement('canvas');
  private readonly over = document.createElement('canvas');
  private readonly swarm = makeSwarm();
  private readonly minimap = new Minimap();
  private readonly gestures: TopGestures;
  private readonly orderLayer: OrderLayer;
  readonly orders: OrderHands;
  private baseKey = '';
  private revision = 0;
  private bodies: BodyBounds = {walls: null, others: null};
  /** What the picture was fitted to last. */
  private fittedTo: Bounds | null = null;

  constructor(private readonly context: StageContext) {
    this.view = new TopView(context.model, context.palette, context.selection);
    this.element.className = 'stage-top';
    this.element.append(this.base, this.swarm.canvas, this.over);
    this.orders = new OrderHands(context, context.desk, this.camera, (x, y) => this.slotAt(x, y));
    this.orderLayer = new OrderLayer(context, context.desk);
    this.gestures = new TopGestures(this.element, context, this);
    this.refresh();
  }

  get tint(): TopView['tint'] {
    return this.view.tint;
  }

  refresh(): void {
    this.view.refresh();
    this.bodies = boundsOfBodies(this.context.model.bodies.values());
    ++this.revision;
  }

  resize(width: number, height: number): void {
    this.camera.width = width;
    this.camera.height = height;
    for (const canvas of [this.base, this.over]) {
      canvas.width = Math.round(width * devicePixelRatio);
      canvas.height = Math.round(height * devicePixelRatio);
    }
    this.baseKey = '';
  }

  paint(now_ms: number): boolean {
    const {camera, context} = this;
    const {placed, selection} = context;
    const primary = selection.primary;
    if (selection.following && primary !== null && primary < placed.count) {
      // Each frame anew, and without easing: a robot that is followed stands still in the picture.
      [camera.x, camera.y] = camera.middleFor(placed.x[primary], placed.y[primary]);
    }
    const going = camera.advance(now_ms);
    this.paintBase(now_ms);
    const ctx = this.over.getContext('2d');
    if (ctx === null) return going;
    ctx.setTransform(devicePixelRatio, 0, 0, devicePixelRatio, 0, 0);
    ctx.clearRect(0, 0, camera.width, camera.height);
    this.swarm.begin(0, camera);
    this.view.drawLife(
      ctx,
      camera,
      placed,
      context.truth,
      context.layers(),
      this.orderLayer,
      this.swarm,
    );
    this.showSwarm();
    for (const layer of context.worldLayers) this.drawForeign(ctx, layer);
    this.paintMinimap(ctx);
    this.lens.draw(ctx, camera, context.palette, (other) => {
      this.view.drawBase(ctx, other, placed, context.layers());
      this.view.drawLife(
        ctx,
        other,
        placed,
        context.truth,
        context.layers(),
        this.orderLayer,
        null,
      );
    });
    if (this.gestures.box !== null) drawBox(ctx, this.context.palette, this.gestures.box);
    this.measure.draw(ctx, camera, context.palette);
    return going;
  }

  /** What a component draws. Its error is shown where its panel is, and the picture continues. */
  private drawForeign(ctx: CanvasRenderingContext2D, layer: WorldLayer): void {
    ctx.save();
    try {
      layer(ctx, (x, y) => this.screenAt(x, y));
    } catch (error) {
      // It would throw in every frame.
      this.context.worldLayers.delete(layer);
      reportError(error);
    }
    ctx.restore();
  }

  private showSwarm(): void {
    const hidden = this.swarm.empty;
    if (this.swarm.canvas.hidden !== hidden) this.swarm.canvas.hidden = hidden;
    if (!hidden) this.swarm.draw();
  }

  /** Floor and bodies are drawn anew only when they or the camera changed; a crowd twice a
   * second. */
  private paintBase(now_ms: number): void {
    const {camera, context} = this;
    const layers = context.layers();
    const crowd = this.view.crowded(camera, context.placed, layers)
      ? Math.floor(now_ms / kDensity_ms)
      : 0;
    const key = [
      camera.x,
      camera.y,
      camera.scale,
      camera.width,
      camera.height,
      this.revision,
      crowd,
      layers.grid,
      layers.hidden.join(),
      context.model.maps.overlay === null ? '' : context.model.maps.revision,
    ].join(' ');
    if (key === this.baseKey) return;
    this.baseKey = key;
    // Opaque: the browser need not blend the canvas with what is behind it.
    const ctx = this.base.getContext('2d', {alpha: false});
    if (ctx === null) return;
    ctx.setTransform(devicePixelRatio, 0, 0, devicePixelRatio, 0, 0);
    this.view.drawBase(ctx, camera, context.placed, layers);
  }

  private paintMinimap(ctx: CanvasRenderingContext2D): void {
    const {camera, context} = this;
    const {placed} = context;
    const bounds = this.bounds('room');
    const wanted =
      context.layers().minimap &&
      placed.count >= kMinimapFrom &&
      camera.width > 520 &&
      bounds !== null &&
      (camera.scale < kMinimapBelow_px || mostAreOutside(camera, placed));
    if (wanted && bounds !== null)
      this.minimap.draw(ctx, camera, placed, context.model.robots, bounds, context.palette);
    else this.minimap.hide();
  }

  fit(animate: boolean, what: Extent): Fitted {
    const {camera} = this;
    const bounds = what === 'more' ? union(this.bounds('room'), this.fittedTo) : this.bounds(what);
    if (bounds === null) return 'nothing';
    this.fittedTo = bounds;
    const goal = camera.fitted(bounds);
    const there =
      Math.abs(goal.x - camera.x) + Math.abs(goal.y - camera.y) < 1e-6 &&
      Math.abs(goal.scale / camera.scale - 1) < 1e-6;
    const selected =
      what === 'closer' && there
        ? boundsOfRobots(this.context.placed, this.radius, this.context.selection.slots)
        : null;
    camera.go(selected === null ? goal : camera.fitted(selected, 120), performance.now(), animate);
    return selected === null ? 'all' : 'selection';
  }

  /** Keeps the lower `stick_px` of a picture of this size free of the robot that is followed, and
   * of where it is in two seconds. */
  cover(stick_px: number, full_mps: number, width: number, height: number): void {
    const {camera} = this;
    camera.covered.bottom = stick_px;
    camera.covered.top = stick_px > 0 ? kChip_px : 0;
    if (stick_px === 0) return;
    const room_px = Math.min(width, height - stick_px - kChip_px) / 2;
    camera.scale = Math.min(Math.max(room_px / Math.max(1.2, kLead_s * full_mps + 0.4), 20), 120);
  }

  private readonly radius = (slot: number) => this.view.robots.radius(slot);

  private bounds(what: Extent): Bounds | null {
    return boundsOfAll(this.context.placed, this.radius, this.bodies, what !== 'room');
  }

  slotAt(px: number, py: number): number | null {
    const {placed} = this.context;
    // A finger covers more than the robot that it means.
    const touch = matchMedia('(pointer: coarse)').matches ? kFinger_px : kMouse_px;
    let best: number | null = null;
    let least = Infinity;
    for (let slot = 0; slot < placed.count; ++slot) {
      if ((placed.flags[slot] & RobotFlag.known) === 0) continue;
      const [x, y] = this.screenOf(slot);
      const d = Math.hypot(x - px, y - py);
      if (d <= Math.max(this.view.robots.radius(slot) * this.camera.scale, touch) && d < least) {
        least = d;
        best = slot;
      }
    }
    return best;
  }

  pickBody(px: number, py: number): boolean {
    const {model, desk} = this.context;
    const id =
      model.live && model.may('edit') && this.slotAt(px, py) === null
        ? bodyAt(model.bodies.values(), ...this.camera.toWorld(px, py))
        : null;
    if (id === null && desk.body === null) return false;
    desk.pickBody(id);
    return id !== null;
  }

  menu(px: number, py: number): void {
    this.context.menu(px, py);
  }

  screenAt(x: number, y: number): [number, number] {
    return [this.camera.toScreenX(x), this.camera.toScreenY(y)];
  }

  slotsIn(box: SelectionBox): number[] {
    return slotsIn(box, this.context.placed, (slot) => this.screenOf(slot));
  }

  jump(px: number, py: number): boolean {
    const place = this.minimap.at(this.camera, px, py);
    if (place === null) return false;
    this.camera.go({x: place[0], y: place[1], scale: this.camera.scale}, performance.now(), false);
    this.context.selection.follow(false);
    this.context.moved();
    this.context.redraw();
    return true;
  }

  pointed(px: number, py: number): void {
    this.lens.at = [px, py];
    if (this.lens.on) this.context.redraw();
  }

  screenOf(slot: number): [number, number] {
    const {placed} = this.context;
    return [this.camera.toScreenX(placed.x[slot]), this.camera.toScreenY(placed.y[slot])];
  }

  viewpoint(): string {
    return [
      'top',
      this.camera.x.toFixed(3),
      this.camera.y.toFixed(3),
      this.camera.scale.toFixed(2),
    ].join(',');
  }

  lookFrom(text: string): void {
    const [x, y, scale] = text.split(',').slice(1).map(Number);
    if (Number.isFinite(x) && Number.isFinite(y) && scale > 0)
      this.camera.go({x, y, scale}, performance.now(), false);
  }

  nudge(dx: number, dy: number): void {
    const {camera, measure} = this;
    if (measure.on) {
      measure.nudge(dx / camera.scale, -dy / camera.scale, this.measureFrom());
      this.context.redraw();
      return;
    }
    camera.pan(-dx, -dy);
    this.context.selection.follow(false);
    this.looked();
  }

  zoomBy(factor: number): void {
    this.camera.zoom(factor, this.camera.width / 2, this.camera.height / 2);
    this.looked();
  }

  mark(): boolean {
    if (!this.measure.on) return false;
    this.measure.goOn(this.measureFrom());
    this.context.redraw();
    return true;
  }

  /** Keys moved the camera: the lens is where the person looks, in the middle. */
  private looked(): void {
    this.lens.toMiddle();
    this.context.moved();
    this.context.redraw();
  }

  /** A measure at the keyboard begins at the selected robot, or in the middle. */
  private measureFrom(): [number, number] {
    const {selection, placed} = this.context;
    const slot = selection.primary;
    return slot !== null && slot < placed.count
      ? [placed.x[slot], placed.y[slot]]
      : [this.camera.x, this.camera.y];
  }

  drop(): boolean {
    if (this.measure.on) {
      this.measure.toggle();
      return true;
    }
    return this.gestures.drop();
  }

  snapshot(): HTMLCanvasElement {
    const picture = document.createElement('canvas');
    [picture.width, picture.height] = [this.over.width, this.over.height];
    const ctx = picture.getContext('2d');
    // WebGL keeps its picture until the end of this task only, so it is drawn anew and copied at
    // once.
    this.paint(performance.now());
    ctx?.drawImage(this.base, 0, 0);
    if (!this.swarm.empty) ctx?.drawImage(this.swarm.canvas, 0, 0);
    ctx?.drawImage(this.over, 0, 0);
    return picture;
  }

  dispose(): void {
    this.element.remove();
    this.swarm.dispose();
  }
}
