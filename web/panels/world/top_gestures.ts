// SPDX-License-Identifier: Apache-2.0
import type {Camera} from './camera';
import type {Measure} from './measure';
import type {OrderHands} from './orders/order_hands';
import type {SelectionBox} from './selection_box';
import type {StageContext} from './stage';

/** What the hands need to know of the picture. */
export interface Hands {
  readonly camera: Camera;
  readonly measure: Measure;
  /** Presses that draw go there first. */
  readonly orders: OrderHands;
  /** A virtual obstacle that this person may move is chosen by a click. */
  pickBody(px: number, py: number): boolean;
  /** The menu of a robot, or of the selection. */
  menu(px: number, py: number): void;
  slotAt(px: number, py: number): number | null;
  slotsIn(box: SelectionBox): number[];
  /** A press on the small map goes there; true if it was one. */
  jump(px: number, py: number): boolean;
  /** The pointer moved, whatever is pressed. */
  pointed(px: number, py: number): void;
}

const kSlip_px = 4;
const kLong_ms = 450;

/** Mouse, fingers and wheel over the top view: pan, zoom, pick, box, measure. */
export class TopGestures {
  /** Being drawn with Shift; pixels. */
  box: SelectionBox | null = null;
  private readonly pointers = new Map<number, {x: number; y: number}>();
  private long = 0;
  private pressed: {x: number; y: number; moved: boolean; box: boolean} | null = null;

  constructor(
    element: HTMLElement,
    private readonly context: StageContext,
    private readonly hands: Hands,
  ) {
    element.addEventListener('pointerdown', (event) => this.down(event));
    element.addEventListener('pointermove', (event) => this.move(event));
    element.addEventListener('pointerup', (event) => this.up(event));
    element.addEventListener('pointercancel', (event) => this.cancel(event));
    element.addEventListener('contextmenu', (event) => {
      event.preventDefault();
      // A finger has its own long press.
      if ((event as PointerEvent).pointerType !== 'touch') hands.menu(event.offsetX, event.offsetY);
    });
    element.addEventListener('pointerleave', () => context.selection.hover(null));
    // A wheel that zooms must not scroll the page.
    element.addEventListener('wheel', (event) => this.wheel(event), {passive: false});
  }

  /** Drops a box that is being drawn. */
  drop(): boolean {
    const begun = this.box !== null;
    this.box = null;
    return begun;
  }

  private wheel(event: WheelEvent): void {
    event.preventDefault();
    const speed = event.deltaMode === 1 ? 0.05 : 0.0015;
    this.hands.camera.zoom(Math.exp(-event.deltaY * speed), event.offsetX, event.offsetY);
    this.context.moved();
    this.context.redraw();
  }

  private down(event: PointerEvent): void {
    (event.currentTarget as HTMLElement).setPointerCapture(event.pointerId);
    const {offsetX: x, offsetY: y} = event;
    if (event.button === 2 || this.hands.jump(x, y)) return;
    this.pointers.set(event.pointerId, {x, y});
    clearTimeout(this.long);
    if (this.pointers.size > 1) this.hands.orders.cancel();
    else if (event.pointerType !== 'mouse')
      this.long = window.setTimeout(() => this.pressedLong(x, y), kLong_ms);
    if (this.pointers.size === 1 && !this.hands.measure.on && this.hands.orders.down(event)) {
      this.pressed = {x, y, moved: false, box: false};
      this.context.redraw();
      return;
    }
    this.pressed = {x, y, moved: false, box: event.shiftKey};
    if (this.hands.measure.on) this.hands.measure.begin(...this.hands.camera.toWorld(x, y));
  }

  private move(event: PointerEvent): void {
    const {offsetX: x, offsetY: y} = event;
    this.hands.pointed(x, y);
    const last = this.pointers.get(event.pointerId);
    if (last === undefined) {
      this.context.selection.hover(this.hands.slotAt(x, y));
      return;
    }
    if (this.pointers.size === 2) this.pinch(event, last);
    this.pointers.set(event.pointerId, {x, y});
    const pressed = this.pressed;
    if (pressed === null || this.pointers.size !== 1) return;
    if (Math.hypot(x - pressed.x, y - pressed.y) > kSlip_px) {
      pressed.moved = true;
      clearTimeout(this.long);
    }
    if (this.hands.orders.drawing) {
      this.hands.orders.move(event);
      this.context.redraw();
      return;
    }
    if (!pressed.moved) return;
    if (this.hands.measure.on) this.hands.measure.extend(...this.hands.camera.toWorld(x, y));
    else if (pressed.box) this.box = [pressed.x, pressed.y, x, y];
    else {
      this.hands.camera.pan(x - last.x, y - last.y);
      this.context.moved();
      this.context.selection.follow(false);
    }
    this.context.redraw();
  }

  private pinch(event: PointerEvent, last: {x: number; y: number}): void {
    const {camera} = this.hands;
    for (const [id, other] of this.pointers) {
      if (id === event.pointerId) continue;
      const before = Math.hypot(last.x - other.x, last.y - other.y);
      const after = Math.hypot(event.offsetX - other.x, event.offsetY - other.y);
      if (before > 1)
        camera.zoom(after / before, (event.offsetX + other.x) / 2, (event.offsetY + other.y) / 2);
      camera.pan((event.offsetX - last.x) / 2, (event.offsetY - last.y) / 2);
    }
    this.context.moved();
    this.context.redraw();
    if (this.pressed) this.pressed.moved = true;
  }

  /** The hand rests: whatever it began, it asks for the menu. */
  private pressedLong(x: number, y: number): void {
    this.hands.orders.cancel();
    this.pressed = null;
    this.pointers.clear();
    this.hands.menu(x, y);
  }

  private cancel(event: PointerEvent): void {
    clearTimeout(this.long);
    this.hands.orders.cancel();
    this.pointers.delete(event.pointerId);
    this.pressed = null;
    this.box = null;
  }

  private up(event: PointerEvent): void {
    clearTimeout(this.long);
    this.pointers.delete(event.pointerId);
    if (this.hands.orders.drawing) {
      this.hands.orders.up(event);
      this.pressed = null;
      this.context.redraw();
      return;
    }
    const pressed = this.pressed;
    if (pressed === null || this.pointers.size > 0) return;
    this.pressed = null;
    const {selection} = this.context;
    if (this.box !== null) {
      selection.set(this.hands.slotsIn(this.box));
      this.box = null;
    } else if (!pressed.moved && !this.hands.measure.on) {
      if (this.hands.orders.click(event) || this.hands.pickBody(event.offsetX, event.offsetY))
        return this.context.redraw();
      pick(
        selection,
        this.hands.slotAt(event.offsetX, event.offsetY),
        event.ctrlKey || event.metaKey,
      );
    }
    this.context.redraw();
  }
}

/** A click on a robot, or beside all of them. */
export function pick(
  selection: StageContext['selection'],
  slot: number | null,
  more: boolean,
): void {
  if (slot === null) selection.set([]);
  else if (more) selection.toggle(slot);
  else selection.set([slot]);
}
