// SPDX-License-Identifier: Apache-2.0
import {Signal} from '../model/signal';

/** Which robots the person is busy with; shared by all panels. */
export class Selection {
  /** Slots, in the order in which they were chosen. The last one is shown in detail. */
  slots: number[] = [];
  hovered: number | null = null;
  /** The World View keeps the selected robot in the middle. */
  following = false;
  readonly changed = new Signal();
  private names: readonly string[] = [];

  get primary(): number | null {
    return this.slots[this.slots.length - 1] ?? null;
  }

  has(slot: number): boolean {
    return this.slots.includes(slot);
  }

  set(slots: number[]): void {
    if (slots.length === 0) this.following = false;
    this.slots = slots;
    this.changed.emit();
  }

  /** Takes another roster, with its names by slot. Selected robots that it has stay selected; they
   * are found by name. */
  adopt(names: readonly string[]): void {
    const slotOf = new Map(names.map((name, slot) => [name, slot]));
    const kept = this.slots
      .map((slot) => slotOf.get(this.names[slot] ?? ''))
      .filter((slot) => slot !== undefined);
    this.names = names;
    this.hovered = null;
    this.set(kept);
  }

  toggle(slot: number): void {
    this.set(this.has(slot) ? this.slots.filter((other) => other !== slot) : [...this.slots, slot]);
  }

  hover(slot: number | null): void {
    if (slot === this.hovered) return;
    this.hovered = slot;
    this.changed.emit();
  }

  follow(on: boolean): void {
    this.following = on && this.slots.length > 0;
    this.changed.emit();
  }
}
