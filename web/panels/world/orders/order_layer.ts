// SPDX-License-Identifier: Apache-2.0
import {kHolds_s} from '../../../model/asked';
import {placeOf, type Pending} from '../../../model/commands';
import type {Placed} from '../../../model/pose_history';
import type {PanelContext} from '../../../panel_api';
import {RobotFlag} from '../../../protocol/frames';
import type {Point} from '../../../protocol/messages';
import {initials} from '../../../ui/words';
import type {Camera} from '../camera';
import {kFont} from '../labels';
import {radiusOf} from '../outlines';
import {withAlpha} from '../scan_layer';
import {arrowsAlong} from './arrows';
import {leadOf} from './lead';
import type {Draft, OrderDesk} from './order_desk';
import {outlineOf} from './outline';

/** Distance between the arrows on a path, and around its ends without one. */
const kArrows_px = 64;
const kArrowFree_px = 14;

/** Violet is people: what they draw, where robots are sent, and who drives them. */
export class OrderLayer {
  private ctx!: CanvasRenderingContext2D;
  private camera!: Camera;
  private placed!: Placed;

  constructor(
    private readonly context: PanelContext,
    private readonly desk: OrderDesk,
  ) {}

  draw(ctx: CanvasRenderingContext2D, camera: Camera, placed: Placed): void {
    [this.ctx, this.camera, this.placed] = [ctx, camera, placed];
    ctx.save();
    ctx.lineJoin = ctx.lineCap = 'round';
    // An order of this page comes back as one of the run; it is drawn once, as the page knows it.
    const drawn = new Set<number>();
    for (const order of this.context.commands.pending) this.drawPending(order, drawn);
    for (const [slot, drive] of this.context.model.drives) {
      if (slot >= placed.count) continue;
      const place = placeOf(drive.order);
      if (place !== null && !drawn.has(slot)) this.drawOther(slot, place, drive.lease, drive.yours);
      if (drive.lease !== '')
        this.drawBadge(
          slot,
          drive.yours ? (this.context.model.hello?.user.name ?? '') : drive.lease,
          drive.yours,
        );
    }
    if (this.desk.draft !== null) this.drawDraft(this.desk.draft);
    this.drawLead();
    this.drawChosen();
    ctx.restore();
  }

  /** Where the stick that is held leads in the next seconds. */
  private drawLead(): void {
    const {commands, selection} = this.context;
    const slot = selection.primary;
    const asked = slot === null ? undefined : commands.asked.of(slot).at(-1);
    const {placed} = this;
    if (
      slot === null ||
      asked === undefined ||
      slot >= placed.count ||
      Math.abs(placed.time_s - asked.t) > kHolds_s ||
      Math.abs(asked.v) < 0.02
    )
      return;
    const points = leadOf(placed.x[slot], placed.y[slot], placed.yaw[slot], asked.v, asked.w);
    const intent = this.token('intent');
    this.line(points, intent, 2.5, [6, 5]);
    const [a, b] = points.slice(-2).map((point) => this.screen(point));
    this.arrow(...b, Math.atan2(b[1] - a[1], b[0] - a[0]), intent);
  }

  private screen([x, y]: readonly [number, number]): [number, number] {
    return [this.camera.toScreenX(x), this.camera.toScreenY(y)];
  }

  private robot(slot: number): Point {
    return [this.placed.x[slot], this.placed.y[slot]];
  }

  private line(
    points: readonly (readonly [number, number])[],
    colour: string,
    width: number,
    dash: number[] = [],
  ): void {
    const {ctx} = this;
    ctx.beginPath();
    for (const point of points) ctx.lineTo(...this.screen(point));
    ctx.setLineDash(dash);
    ctx.strokeStyle = colour;
    ctx.lineWidth = width;
    ctx.stroke();
    ctx.setLineDash([]);
  }

  /** Which way a path goes. */
  private arrows(points: readonly Point[], colour: string): void {
    for (const {x, y, angle} of arrowsAlong(
      points.map((point) => this.screen(point)),
      kArrows_px,
      kArrowFree_px,
    ))
      this.arrow(x, y, angle, colour);
  }

  private arrow(x: number, y: number, angle: number, colour: string): void {
    const {ctx} = this;
    ctx.save();
    ctx.fillStyle = colour;
    ctx.translate(x, y);
    ctx.rotate(angle);
    ctx.beginPath();
    ctx.moveTo(6, 0);
    ctx.lineTo(-4, 4.5);
    ctx.lineTo(-1.5, 0);
    ctx.lineTo(-4, -4.5);
    ctx.fill();
    ctx.restore();
  }

  private ring(point: readonly [number, number], colour: string, filled: boolean): void {
    const {ctx} = this;
    const [x, y] = this.screen(point);
    ctx.beginPath();
    ctx.arc(x, y, 8, 0, 2 * Math.PI);
    ctx.fillStyle = this.token('floor');
    ctx.fill();
    ctx.strokeStyle = colour;
    ctx.lineWidth = 2;
    ctx.stroke();
    if (!filled) return;
    ctx.beginPath();
    ctx.arc(x, y, 3, 0, 2 * Math.PI);
    ctx.fillStyle = colour;
    ctx.fill();
  }

  private token(name: string): string {
    return this.context.palette.token(name);
  }

  private drawPending(order: Pending, drawn: Set<number>): void {
    const intent = this.token('intent');
    order.slots.forEach((slot, i) => {
      if (slot >= this.placed.count || (this.placed.flags[slot] & RobotFlag.known) === 0) return;
      drawn.add(slot);
      const refused = order.state === 'refused' || order.refused.includes(slot);
      // One point may serve several robots; otherwise each has its own.
      const points =
        order.kind === 'path' ? order.points : [order.points[order.points.length > 1 ? i : 0]];
      const colour = refused
        ? this.token('danger')
        : order.state === 'sent'
          ? withAlpha(intent, 0.45)
          : intent;
      this.line(
        [this.robot(slot), ...points],
        colour,
        2,
        refused || order.state === 'taken' ? [7, 5] : [],
      );
      if (order.kind === 'path') this.arrows(points, colour);
      const end = points[points.length - 1];
      this.ring(end, colour, !refused);
      if (refused) this.cross(end, colour);
      else if (order.state === 'taken' && order.slots.length === 1)
        this.distance(slot, end, colour);
    });
  }

  private cross(point: readonly [number, number], colour: string): void {
    const {ctx} = this;
    const [x, y] = this.screen(point);
    ctx.strokeStyle = colour;
    ctx.beginPath();
    ctx.moveTo(x - 3, y - 3);
    ctx.lineTo(x + 3, y + 3);
    ctx.moveTo(x + 3, y - 3);
    ctx.lineTo(x - 3, y + 3);
    ctx.stroke();
  }

  /** What another page, another person or a terminal asked for. */
  private drawOther(slot: number, place: Point, driver: string, yours: boolean): void {
    const colour = this.token(yours ? 'intent' : 'text-2');
    this.line([this.robot(slot), place], colour, yours ? 2 : 1.5, yours ? [7, 5] : [2, 5]);
    this.ring(place, colour, true);
    if (yours) this.distance(slot, place, colour);
    else if (driver !== '') this.disc(...this.screen([place[0], place[1]]), -12, driver, false);
  }

  private distance(slot: number, place: readonly [number, number], colour: string): void {
    const [x, y] = this.screen(place);
    const left_m = Math.hypot(place[0] - this.placed.x[slot], place[1] - this.placed.y[slot]);
    this.tag(`taken, ${left_m.toFixed(1)} m`, x, y + 22, colour);
  }

  private tag(text: string, x: number, y: number, colour: string): void {
    const {ctx} = this;
    ctx.font = `500 11px ${kFont}`;
    const w = ctx.measureText(text).width + 12;
    ctx.fillStyle = this.token('bg-2');
    ctx.strokeStyle = this.token('line-2');
    ctx.lineWidth = 1;
    ctx.beginPath();
    ctx.roundRect(x - w / 2, y - 9, w, 18, 4);
    ctx.fill();
    ctx.stroke();
    ctx.fillStyle = colour;
    ctx.textAlign = 'center';
    ctx.textBaseline = 'middle';
    ctx.fillText(text, x, y + 0.5);
  }

  /** Initials of who drives, at the robot; left of a stop sign. */
  private drawBadge(slot: number, name: string, yours: boolean): void {
    if ((this.placed.flags[slot] & RobotFlag.known) === 0) return;
    const r = Math.max(
      7.5,
      radiusOf(this.context.model.robots[slot]?.shapes ?? []) * this.camera.scale,
    );
    const [x, y] = this.screen(this.robot(slot));
    const side = (this.placed.flags[slot] & RobotFlag.stopped) !== 0 ? -0.75 : 0.75;
    this.disc(x + side * r, y - 0.75 * r - 2, 0, name, yours);
  }

  private disc(x: number, y: number, dx: number, name: string, yours: boolean): void {
    const {ctx} = this;
    ctx.beginPath();
    ctx.arc(x + dx, y + dx, 8.5, 0, 2 * Math.PI);
    ctx.fillStyle = yours ? this.token('intent-fill') : this.token('bg-4');
    ctx.fill();
    ctx.strokeStyle = this.token('floor');
    ctx.lineWidth = 1.5;
    ctx.stroke();
    ctx.fillStyle = yours ? '#ffffff' : this.token('text-1');
    ctx.font = `600 8.5px ${kFont}`;
    ctx.textAlign = 'center';
    ctx.textBaseline = 'middle';
    ctx.fillText(initials(name), x + dx, y + dx + 0.5);
  }

  private drawDraft(draft: Draft): void {
    const intent = this.token('intent');
    if (draft.kind === 'outline') return this.drawOutline(draft);
    if (draft.kind === 'path') {
      this.line(draft.points, intent, 2.5);
      this.arrows(draft.points, intent);
      // A drawn path has hundreds of points; a few knots say enough.
      const every = Math.max(1, Math.ceil(draft.points.length / 6));
      draft.points.forEach((point, i) => {
        if (i > 0 && i % every === 0 && i < draft.points.length - 1) this.knot(point);
      });
      if (draft.points.length > 0) this.ring(draft.points[draft.points.length - 1], intent, true);
      return;
    }
    for (const slot of this.desk.slotsFor(draft.kind)) {
      if (draft.kind === 'goal')
        this.line([this.robot(slot), draft.point], withAlpha(intent, 0.6), 2);
    }
    this.ring(draft.point, intent, true);
    if (draft.yaw === null) return;
    const [x, y] = this.screen(draft.point);
    this.ctx.beginPath();
    this.ctx.moveTo(x, y);
    this.ctx.lineTo(x + 30 * Math.cos(draft.yaw), y - 30 * Math.sin(draft.yaw));
    this.ctx.stroke();
  }

  private knot(point: Point): void {
    const [x, y] = this.screen(point);
    this.ctx.beginPath();
    this.ctx.arc(x, y, 4, 0, 2 * Math.PI);
    this.ctx.fillStyle = this.token('floor');
    this.ctx.fill();
    this.ctx.strokeStyle = this.token('intent');
    this.ctx.lineWidth = 2;
    this.ctx.stroke();
  }

  private drawOutline(draft: Extract<Draft, {kind: 'outline'}>): void {
    const {ctx} = this;
    const intent = this.token('intent');
    const made = outlineOf(draft.shape, draft.points);
    ctx.fillStyle = withAlpha(intent, 0.12);
    ctx.strokeStyle = intent;
    ctx.lineWidth = 1.5;
    ctx.setLineDash([7, 5]);
    ctx.beginPath();
    if (made?.radius !== undefined) {
      const [x, y] = this.screen([made.pose[0], made.pose[1]]);
      ctx.arc(x, y, made.radius * this.camera.scale, 0, 2 * Math.PI);
    } else {
      const corners =
        draft.shape === 'polygon'
          ? draft.points
          : (made?.polygon ?? []).map(
              ([x, y]): Point => [x + (made?.pose[0] ?? 0), y + (made?.pose[1] ?? 0)],
            );
      for (const corner of corners) ctx.lineTo(...this.screen(corner));
      ctx.closePath();
    }
    ctx.fill();
    ctx.stroke();
    ctx.setLineDash([]);
    if (draft.shape === 'polygon') draft.points.forEach((point) => this.knot(point));
  }

  /** Frame and handle of the obstacle that is moved or turned. */
  private drawChosen(): void {
    const {chosen} = this.desk;
    if (chosen === null) return;
    const {ctx} = this;
    const intent = this.token('intent');
    const [x, y] = this.screen([chosen.pose[0], chosen.pose[1]]);
    const r = radiusOf(chosen.body.shapes) * this.camera.scale + 8;
    ctx.strokeStyle = intent;
    ctx.lineWidth = 2;
    ctx.beginPath();
    ctx.arc(x, y, r, 0, 2 * Math.PI);
    ctx.stroke();
    if (this.desk.moved !== null) this.ghost(chosen.body.shapes, chosen.pose);
    const [hx, hy] = handleOf(this.camera, chosen.pose, r);
    ctx.beginPath();
    ctx.moveTo(x + r * Math.cos(chosen.pose[2]), y - r * Math.sin(chosen.pose[2]));
    ctx.lineTo(hx, hy);
    ctx.stroke();
    ctx.beginPath();
    ctx.arc(hx, hy, 7, 0, 2 * Math.PI);
    ctx.fillStyle = this.token('floor');
    ctx.fill();
    ctx.stroke();
  }

  private ghost(
    shapes: readonly {polygon?: Point[]; disc?: [number, number, number]}[],
    pose: readonly [number, number, number],
  ): void {
    const {ctx, camera} = this;
    const [c, s] = [Math.cos(pose[2]), Math.sin(pose[2])];
    const at = ([x, y]: readonly [number, number]) =>
      this.screen([pose[0] + c * x - s * y, pose[1] + s * x + c * y]);
    ctx.setLineDash([7, 5]);
    for (const shape of shapes) {
      ctx.beginPath();
      if (shape.disc)
        ctx.arc(
          ...at([shape.disc[0], shape.disc[1]]),
          shape.disc[2] * camera.scale,
          0,
          2 * Math.PI,
        );
      else for (const corner of shape.polygon ?? []) ctx.lineTo(...at(corner));
      ctx.closePath();
      ctx.stroke();
    }
    ctx.setLineDash([]);
  }
}

/** Where the handle is that turns an obstacle; pixels. */
export function handleOf(
  camera: Camera,
  pose: readonly [number, number, number],
  r: number,
): [number, number] {
  return [
    camera.toScreenX(pose[0]) + (r + 18) * Math.cos(pose[2]),
    camera.toScreenY(pose[1]) - (r + 18) * Math.sin(pose[2]),
  ];
}
