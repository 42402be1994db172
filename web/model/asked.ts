// SPDX-License-Identifier: Apache-2.0

/** A velocity that was asked of a robot: forward, m/s, and to the left, rad/s. */
export interface AskedVelocity {
  /** Seconds of the run. */
  t: number;
  v: number;
  w: number;
}

/** So long a velocity holds that is not renewed, seconds. */
export const kHolds_s = 0.2;
/** So far back it is kept. */
export const kAsked_s = 30;

/** What this page asked of robots in the last seconds, as it is plotted. */
export class Asked {
  private readonly bySlot = new Map<number, AskedVelocity[]>();

  note(slots: readonly number[], v: number, w: number, t: number): void {
    for (const slot of slots) {
      const list = this.bySlot.get(slot) ?? [];
      // The time of a run goes back when it begins anew.
      if (list.length > 0 && list[list.length - 1].t > t) list.length = 0;
      list.push({t, v, w});
      while (list[0].t < t - kAsked_s) list.shift();
      this.bySlot.set(slot, list);
    }
  }

  of(slot: number): readonly AskedVelocity[] {
    return this.bySlot.get(slot) ?? [];
  }

  clear(): void {
    this.bySlot.clear();
  }
}
