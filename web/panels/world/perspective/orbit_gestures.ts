// SPDX-License-Identifier: Apache-2.0
import type {SelectionBox} from '../selection_box';
import type {StageContext} from '../stage';
import {pick} from '../top_gestures';
import type {Orbit} from './orbit';

const kSlip_px = 4;

/** What the hands need to know of the picture. */
export interface OrbitHands {
  slotAt(px: number, py: number): number | null;
  slotsIn(box: SelectionBox): number[];
}

/** Mouse: the left button turns, with Shift it draws a box; the right one pans, the wheel zooms.
 * One finger pans, two zoom and turn. */
export class OrbitGestures {
  /** Being drawn with Shift; pixels. */
  box: SelectionBox | null = null;
  private readonly pointers = new Map<number, {x: number; y: number}>();
  private pressed: {x: number; y: number; moved: boolean; does: 'turn' | 'pan' | 'box'} | null =
    null;

  constructor(
    element: HTMLElement,
    private readonly context: StageContext,
    private readonly orbit: Orbit,
    private readonly hands: OrbitHands,
  ) {
    element.addEventListener('pointerdown', (event) => this.down(event));
    element.addEventListener('pointermove', (event) => this.move(event));
    element.addEventListener('pointerup', (event) => this.up(event));
    element.addEventListener('pointercancel', (event) => {
      this.drop();
      this.up(event);
    });
    element.addEventListener('pointerleave', () => context.selection.hover(null));
    element.addEventListener('contextmenu', (event) => event.preventDefault());
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
    this.orbit.zoom(Math.exp(-event.deltaY * (event.deltaMode === 1 ? 0.05 : 0.0015)));
    this.changed();
  }

  private changed(): void {
    this.context.moved();
    this.context.redraw();
  }

  private down(event: PointerEvent): void {
    (event.currentTarget as HTMLElement).setPointerCapture(event.pointerId);
    const {offsetX: x, offsetY: y} = event;
    this.pointers.set(event.pointerId, {x, y});
    const pans = event.pointerType === 'touch' || event.button !== 0;
    this.pressed = {x, y, moved: false, does: pans ? 'pan' : event.shiftKey ? 'box' : 'turn'};
  }

  private move(event: PointerEvent): void {
    const {offsetX: x, offsetY: y} = event;
    const last = this.pointers.get(event.pointerId);
    if (last === undefined) {
      this.context.selection.hover(this.hands.slotAt(x, y));
      return;
    }
    if (this.pointers.size === 2) this.twist(event, last);
    this.pointers.set(event.pointerId, {x, y});
    const {pressed} = this;
    if (pressed === null || this.pointers.size !== 1) return;
    if (Math.hypot(x - pressed.x, y - pressed.y) > kSlip_px) pressed.moved = true;
    if (!pressed.moved) return;
    if (pressed.does === 'box') {
      this.box = [pressed.x, pressed.y, x, y];
      return this.context.redraw();
    }
    if (pressed.does === 'pan') {
      this.orbit.pan(x - last.x, y - last.y);
      this.context.selection.follow(false);
    } else this.orbit.rotate(x - last.x, y - last.y);
    this.changed();
  }

  /** Two fingers: apart zooms, about each other turns, both up or down tilts. */
  private twist(event: PointerEvent, last: {x: number; y: number}): void {
    for (const [id, other] of this.pointers) {
      if (id === event.pointerId) continue;
      const before = Math.hypot(last.x - other.x, last.y - other.y);
      const after = Math.hypot(event.offsetX - other.x, event.offsetY - other.y);
      if (before > 1) this.orbit.zoom(after / before);
      const turned =
        Math.atan2(event.offsetY - other.y, event.offsetX - other.x) -
        Math.atan2(last.y - other.y, last.x - other.x);
      this.orbit.rotate(
        Math.atan2(Math.sin(turned), Math.cos(turned)) / 0.006,
        (event.offsetY - last.y) / 2,
      );
    }
    if (this.pressed) this.pressed.moved = true;
    this.changed();
  }

  private up(event: PointerEvent): void {
    this.pointers.delete(event.pointerId);
    const {pressed} = this;
    if (pressed === null || this.pointers.size > 0) return;
    this.pressed = null;
    if (this.box !== null) this.context.selection.set(this.hands.slotsIn(this.box));
    this.box = null;
    if (!pressed.moved)
      pick(
        this.context.selection,
        this.hands.slotAt(event.offsetX, event.offsetY),
        event.ctrlKey || event.metaKey,
      );
    this.context.redraw();
  }
}
