// SPDX-License-Identifier: Apache-2.0
import type {Body, Point} from '../../../protocol/messages';
import type {StageContext} from '../stage';
import type {Camera} from '../camera';
import {radiusOf} from '../outlines';
import {handleOf} from './order_layer';
import {wrapped, type OrderDesk} from './order_desk';

/** So far a press may slip and still be a click, pixels. */
const kSlip_px = 6;
/** A goal that is dragged so far has a heading. */
const kHeading_px = 24;
const kHandle_px = 14;
const kClose_px = 12;

type Press =
  | {what: 'path' | 'outline' | 'point'; x: number; y: number}
  | {what: 'carry'; dx: number; dy: number; x: number; y: number}
  | {what: 'turn'; x: number; y: number};

/** Presses that draw: with a tool, from a selected robot, with a pen, or on an obstacle with
 * handles. */
export class OrderHands {
  private press: Press | null = null;

  constructor(
    private readonly context: StageContext,
    private readonly desk: OrderDesk,
    private readonly camera: Camera,
    private readonly slotAt: (x: number, y: number) => number | null,
  ) {}

  get drawing(): boolean {
    return this.press !== null;
  }

  /** True: the press is this one's, and moves no camera. */
  down(event: PointerEvent): boolean {
    if (event.button !== 0 || event.shiftKey) return false;
    const {offsetX: x, offsetY: y} = event;
    this.press = this.pressOf(event, x, y);
    if (this.press === null) return false;
    const point = this.camera.toWorld(x, y);
    if (this.press.what === 'path') this.beginPath(point, x, y);
    if (this.press.what === 'outline')
      this.desk.begin({kind: 'outline', shape: this.desk.shape, points: [point]});
    return true;
  }

  private pressOf(event: PointerEvent, x: number, y: number): Press | null {
    const {desk} = this;
    const {tool} = desk;
    const fingers = event.pointerType === 'touch';
    if (tool === 'select') {
      const handle = this.handlePress(x, y);
      if (handle !== null) return handle;
      const slot = this.slotAt(x, y);
      // A pen draws at once where a finger would pan.
      const pen = event.pointerType === 'pen' && slot === null && desk.slotsFor('path').length > 0;
      return desk.drawsFrom(slot) || pen ? {what: 'path', x, y} : null;
    }
    if (tool === 'path') return {what: 'path', x, y};
    if (tool === 'obstacle' && desk.shape !== 'polygon') return {what: 'outline', x, y};
    // A finger that moves pans; a tap places.
    return fingers ? null : {what: 'point', x, y};
  }

  private handlePress(x: number, y: number): Press | null {
    const {chosen} = this.desk;
    if (chosen === null || !this.context.model.may('edit')) return null;
    const r = radiusOf(chosen.body.shapes) * this.camera.scale + 8;
    const [hx, hy] = handleOf(this.camera, chosen.pose, r);
    if (Math.hypot(x - hx, y - hy) < kHandle_px) return {what: 'turn', x, y};
    const [bx, by] = [this.camera.toScreenX(chosen.pose[0]), this.camera.toScreenY(chosen.pose[1])];
    return Math.hypot(x - bx, y - by) < r ? {what: 'carry', dx: bx - x, dy: by - y, x, y} : null;
  }

  private beginPath(point: Point, x: number, y: number): void {
    const draft = this.desk.draft;
    if (draft?.kind === 'path' && this.desk.tool === 'path') {
      this.desk.extend(point);
      return;
    }
    const slot =
      this.slotAt(x, y) ?? this.desk.slotsFor('path').at(-1) ?? this.desk.slotsFor('goal').at(-1);
    const {placed} = this.context;
    const from: Point =
      slot === undefined || slot === null ? point : [placed.x[slot], placed.y[slot]];
    this.desk.begin({kind: 'path', points: from === point ? [point] : [from, point]});
  }

  move(event: PointerEvent): void {
    const {press, desk, camera} = this;
    if (press === null) return;
    const {offsetX: x, offsetY: y} = event;
    const point = camera.toWorld(x, y);
    if (press.what === 'path' || press.what === 'outline') desk.extend(point);
    else if (press.what === 'carry') {
      const {chosen} = desk;
      if (chosen !== null && Math.hypot(x - press.x, y - press.y) > kSlip_px)
        desk.carry([...camera.toWorld(x + press.dx, y + press.dy), chosen.pose[2]]);
    } else if (press.what === 'turn') {
      const {chosen} = desk;
      if (chosen !== null)
        desk.carry([
          chosen.pose[0],
          chosen.pose[1],
          wrapped(Math.atan2(point[1] - chosen.pose[1], point[0] - chosen.pose[0])),
        ]);
    } else this.point(press.x, press.y, x, y);
  }

  /** A goal or a place, with a heading if it is dragged. */
  private point(fromX: number, fromY: number, x: number, y: number): void {
    const {tool} = this.desk;
    if (tool !== 'goal' && tool !== 'place') return;
    const yaw =
      Math.hypot(x - fromX, y - fromY) > kHeading_px ? Math.atan2(fromY - y, x - fromX) : null;
    this.desk.begin({kind: tool, point: this.camera.toWorld(fromX, fromY), yaw});
  }

  up(event: PointerEvent): void {
    const {press, desk} = this;
    this.press = null;
    if (press === null) return;
    const {offsetX: x, offsetY: y} = event;
    const slipped = Math.hypot(x - press.x, y - press.y) > kSlip_px;
    if (press.what === 'point') this.click(event);
    else if (press.what === 'outline') void (slipped ? desk.send() : desk.drop());
    else if (press.what === 'carry' || press.what === 'turn') void desk.put();
    else if (desk.tool === 'select' && !slipped) {
      // It was a click on a robot after all.
      desk.draft = null;
      const slot = this.slotAt(x, y);
      if (slot !== null) this.context.selection.set([slot]);
      desk.changed.emit();
    }
  }

  cancel(): void {
    if (this.press === null) return;
    this.press = null;
    this.desk.draft = null;
    this.desk.moved = null;
    this.desk.changed.emit();
  }

  /** A click or a tap with a tool; true if it meant something. */
  click(event: PointerEvent): boolean {
    const {desk, camera} = this;
    const {offsetX: x, offsetY: y} = event;
    const point = camera.toWorld(x, y);
    if (desk.tool === 'obstacle' && desk.shape === 'polygon') {
      this.corner(point, x, y);
      return true;
    }
    if (desk.tool !== 'goal' && desk.tool !== 'place') return desk.tool !== 'select';
    // Another robot is a choice, not a goal.
    const slot = this.slotAt(x, y);
    if (slot !== null && !this.context.selection.has(slot)) {
      this.context.selection.set([slot]);
      return true;
    }
    const why = desk.whyNot(desk.tool);
    if (why !== '') {
      desk.say(why, false, point);
      return true;
    }
    if (desk.draft?.kind !== desk.tool) desk.begin({kind: desk.tool, point, yaw: null});
    // What a finger or a pen has set is looked at before it is sent.
    if (event.pointerType === 'mouse') void desk.send();
    return true;
  }

  private corner(point: Point, x: number, y: number): void {
    const {desk, camera} = this;
    const draft = desk.draft;
    if (draft?.kind !== 'outline') {
      desk.begin({kind: 'outline', shape: 'polygon', points: [point]});
      return;
    }
    const [fx, fy] = draft.points[0];
    const closes =
      draft.points.length > 2 &&
      Math.hypot(camera.toScreenX(fx) - x, camera.toScreenY(fy) - y) < kClose_px;
    if (closes) void desk.send();
    else desk.extend(point);
  }
}

/** The virtual obstacle under a point of the world; null: there is none. */
export function bodyAt(bodies: Iterable<Body>, x: number, y: number): number | null {
  for (const body of bodies) {
    if (body.kind !== 'virtual') continue;
    const [c, s] = [Math.cos(body.pose[2]), Math.sin(body.pose[2])];
    const [lx, ly] = [
      c * (x - body.pose[0]) + s * (y - body.pose[1]),
      -s * (x - body.pose[0]) + c * (y - body.pose[1]),
    ];
    if (
      body.shapes.some((shape) =>
        shape.disc
          ? Math.hypot(lx - shape.disc[0], ly - shape.disc[1]) <= shape.disc[2]
          : holds(shape.polygon ?? [], lx, ly),
      )
    )
      return body.id;
  }
  return null;
}

function holds(polygon: readonly Point[], x: number, y: number): boolean {
  let inside = false;
  for (let i = 0, j = polygon.length - 1; i < polygon.length; j = i++) {
    const [[ax, ay], [bx, by]] = [polygon[i], polygon[j]];
    if (ay > y !== by > y && x < ((bx - ax) * (y - ay)) / (by - ay) + ax) inside = !inside;
  }
  return inside;
}
