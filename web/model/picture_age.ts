// SPDX-License-Identifier: Apache-2.0

/** Microseconds of Unix time, as frames have them: modulo 2^32. */
const kTakenAt = 44;

/** How old the newest picture was when it came: from the server's state to this page. */
export class PictureAge {
  /** Null before the first picture, and of a recording. */
  newest_ms: number | null = null;
  private least_ms = Infinity;

  /** `sameClock`: server and page are one machine. Otherwise their clocks differ by an unknown
   * amount, and the age is counted from that of the fastest picture. */
  constructor(private readonly sameClock: boolean) {}

  take(buffer: ArrayBuffer, wall_ms: number): void {
    const view = new DataView(buffer);
    // Poses, no past ones and no true ones.
    if (view.byteLength < kTakenAt + 4 || view.getUint8(0) !== 1 || view.getUint8(1) !== 0) return;
    const taken_us = view.getUint32(kTakenAt, true);
    if (taken_us === 0) {
      this.newest_ms = null;
      return;
    }
    // Differences of numbers modulo 2^32 are right, whichever is the larger.
    const age_ms = ((Math.floor(wall_ms * 1000) - taken_us) | 0) / 1000;
    this.least_ms = Math.min(this.least_ms, age_ms);
    this.newest_ms = this.sameClock ? Math.max(0, age_ms) : age_ms - this.least_ms;
  }
}
