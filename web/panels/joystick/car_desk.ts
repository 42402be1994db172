// SPDX-License-Identifier: Apache-2.0
import {Car, carPedals, kIdle, pedalsOf, together, type Gear, type Pedals} from './car';
import type {DriveLoop} from './drive_loop';
import type {DriveKeys} from './keys';
import {readCarPad} from './pad';

/** The four controls, from whatever input, as what the loop sends. */
export class CarDesk {
  readonly car = new Car();
  /** Of the gamepad; empty: there is none. */
  pad = '';
  private touched: Pedals = kIdle;
  private ofPad: Pedals = kIdle;
  private shoulder = 0;
  private last_ms = 0;
  /** The loop let go by itself, as when the robot refuses: first everything has to be let go. */
  private blocked = false;
  private holding = false;

  constructor(
    private readonly loop: DriveLoop,
    private readonly keys: DriveKeys,
  ) {}

  /** As they are shown. */
  get pedals(): Pedals {
    return together(this.ofPad, this.ofHands);
  }

  private get ofHands(): Pedals {
    return together(this.touched, pedalsOf(this.keys.place));
  }

  touch(control: keyof Pedals, value: number): void {
    this.touched = {...this.touched, [control]: value};
  }

  shift(gear: Gear): void {
    this.car.shift(gear, this.pedals);
  }

  /** One gear up or down. */
  shiftBy(step: number): void {
    this.shift(Math.max(-1, Math.min(1, this.car.gear + step)) as Gear);
  }

  /** Some 60 times a second. A pedal that is released lets the robot stand at once. */
  tick(now_ms: number): void {
    const dt_s = Math.min(0.1, (now_ms - this.last_ms) / 1000);
    this.last_ms = now_ms;
    const pad = readCarPad();
    this.pad = pad?.name ?? '';
    this.ofPad =
      pad === null ? kIdle : {steering: pad.steering, throttle: pad.throttle, brake: pad.brake};
    const shoulder = pad === null ? 0 : Number(pad.up) - Number(pad.down);
    if (shoulder !== 0 && this.shoulder === 0) this.shiftBy(shoulder);
    this.shoulder = shoulder;
    const hands = this.ofHands;
    // Keys and fingers are of the same person, who may go from one to the other.
    const now =
      this.loop.held === 'keys' || this.loop.held === 'touch'
        ? this.loop.held
        : this.keys.held
          ? 'keys'
          : 'touch';
    const source = this.car.held(hands) ? now : this.car.held(this.ofPad) ? 'pad' : null;
    if (source === null || (this.loop.held !== null && this.loop.held !== source)) {
      // Another hand takes over only after this one has let go.
      this.car.release();
      this.loop.release();
      // This desk knows by itself what was held too long; to the loop keys, fingers and pad are one
      // hand here.
      this.loop.renew();
      this.holding = false;
      this.blocked = this.blocked && source !== null;
      return;
    }
    this.blocked = this.blocked || (this.holding && this.loop.held === null);
    this.holding = !this.blocked;
    if (this.blocked) {
      this.car.release();
      return;
    }
    const pedals = source === 'pad' ? this.ofPad : hands;
    this.car.step(pedals, dt_s);
    this.loop.holdBoth(source, ...this.car.place, carPedals(this.car.gear, pedals));
  }

  /** Focus, link or robot is lost: whatever is still pressed counts only when it is pressed
   * again. */
  letGo(): void {
    this.touched = kIdle;
    this.car.release();
    this.car.gear = 0;
  }
}
