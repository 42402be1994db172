// SPDX-License-Identifier: Apache-2.0
import type {Commands} from '../../model/commands';
import type {LinePedals} from '../../protocol/line';

/** So often a velocity is sent while the stick is held. */
export const kPeriod_ms = 1000 / 30;
/** A stick that is moved says so at once, but not more often than this. Hosts take 100 orders a
 * second. */
export const kLeast_ms = 16;

export type StickSource = 'pad' | 'keys' | 'touch';

/** Sends velocities as long as something is held, and zero at once when it is let go. */
export class DriveLoop {
  /** Share of full speed: right and up positive, each from -1 to 1. */
  x = 0;
  y = 0;
  /** What holds the stick; null: nothing. */
  held: StickSource | null = null;
  /** From sending to the answer, milliseconds; 0: not known. */
  delay_ms = 0;
  delays_ms: number[] = [];
  /** Why the robot does not obey; empty if it does. */
  refusal = '';
  /** Full speed, m/s and rad/s. */
  v_mps = 0.4;
  w_radps = 1.2;
  /** Left and right move the robot sideways instead of turning it. */
  slides = false;
  /** What a car gets beside the velocity; null: no pedals. */
  private pedals: LinePedals | null = null;
  private slot: number | null = null;
  private timer = 0;
  private soon = 0;
  private sent_ms = -Infinity;
  /** Held on after the robot refused or the page let go for it: it counts only when it is gripped
   * anew. */
  private spent: StickSource | null = null;
  /** The robot that refused: its host waits for a neutral stick, too. */
  private refused: number | null = null;

  constructor(
    private readonly commands: Commands,
    private readonly changed: () => void,
  ) {}

  /** The velocity of the present position: forward, m/s, and to the left, rad/s. */
  get velocity(): [number, number] {
    return [this.y * this.v_mps || 0, this.slides ? 0 : -this.x * this.w_radps || 0];
  }

  /** Sideways, to the left, m/s. */
  get sideways_mps(): number {
    return this.slides ? -this.x * this.v_mps || 0 : 0;
  }

  /** The driven robot is let go first: a stick never moves from one robot to the next. */
  choose(slot: number | null): void {
    if (slot === this.slot) return;
    this.release();
    this.slot = slot;
    this.refusal = '';
  }

  /** A source is let go, or gripped anew; without one: whichever was held. */
  renew(source?: StickSource): void {
    if (this.spent === null || (source !== undefined && source !== this.spent)) return;
    this.spent = null;
    if (this.refused !== null && this.refused === this.slot && this.held === null) this.send();
    this.refused = null;
  }

  hold(source: StickSource, x: number, y: number): void {
    const length = Math.hypot(x, y);
    const scale = length > 1 ? 1 / length : 1;
    this.holdBoth(source, x * scale, y * scale);
  }

  /** As hold(), of two controls that do not limit each other; each from -1 to 1. `pedals`: what
   * they come from. */
  holdBoth(source: StickSource, x: number, y: number, pedals: LinePedals | null = null): void {
    if (this.slot === null || source === this.spent || (this.held !== null && this.held !== source))
      return;
    const [from_x, from_y] = [this.x, this.y];
    const other = JSON.stringify(pedals) !== JSON.stringify(this.pedals);
    this.pedals = pedals;
    [this.x, this.y] = [Math.max(-1, Math.min(1, x)), Math.max(-1, Math.min(1, y))];
    if (this.held === null) {
      this.held = source;
      this.refusal = '';
      this.send();
    } else if (this.x !== from_x || this.y !== from_y || other) {
      this.sendSoon();
    }
    this.changed();
  }

  /** The robot stands. Of another source than the one that holds it does nothing. Without a source
   * the page lets go, and what is still held counts only when it is gripped anew. */
  release(source?: StickSource): void {
    if (source !== undefined) this.renew(source);
    if (this.held === null || (source !== undefined && source !== this.held)) return;
    if (source === undefined) this.spent = this.held;
    this.held = null;
    this.x = this.y = 0;
    this.pedals = null;
    this.send();
    this.changed();
  }

  private sendSoon(): void {
    const wait_ms = kLeast_ms - (performance.now() - this.sent_ms);
    if (wait_ms <= 0) this.send();
    else if (this.soon === 0) this.soon = window.setTimeout(() => this.send(), wait_ms);
  }

  private stopTimers(): void {
    clearTimeout(this.timer);
    clearTimeout(this.soon);
    this.soon = 0;
  }

  /** Says where the stick is, and again after a while as long as it is held. */
  private send(): void {
    this.stopTimers();
    if (this.slot === null) return;
    if (this.held !== null) this.timer = window.setTimeout(() => this.send(), kPeriod_ms);
    const slot = this.slot;
    const [v, w] = this.velocity;
    const wide = {...(this.slides ? {vy: this.sideways_mps} : {}), ...(this.pedals ?? {})};
    const sent_ms = performance.now();
    this.sent_ms = sent_ms;
    void this.commands
      .ask({type: 'order', kind: 'drive', slots: [slot], v, w, ...wide})
      .then((answer) => {
        if (slot !== this.slot) return;
        if (answer.good) {
          this.delay_ms = performance.now() - sent_ms;
          this.delays_ms = [...this.delays_ms.slice(-39), this.delay_ms];
        } else {
          // Asked again and again it would be refused again and again.
          const held = this.held !== null;
          if (held) [this.spent, this.refused] = [this.held, slot];
          this.stopTimers();
          this.held = null;
          this.x = this.y = 0;
          if (held) this.refusal = answer.text;
        }
        this.changed();
      });
  }
}
