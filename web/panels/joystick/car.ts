// SPDX-License-Identifier: Apache-2.0
// Steering, throttle, brake and gear of a vehicle, as the two velocities of an order.
import type {LinePedals} from '../../protocol/line';

export type Gear = -1 | 0 | 1;
export const kGears: readonly {gear: Gear; letter: string; name: string}[] = [
  {gear: 1, letter: 'F', name: 'Forward'},
  {gear: 0, letter: 'N', name: 'Neutral'},
  {gear: -1, letter: 'R', name: 'Reverse'},
];

/** A full brake takes full speed away in this number of seconds, half a brake in twice as many. */
export const kFullBrake_s = 0.5;
/** Pedals and sticks that are let go are not quite at zero. */
const kSlack = 0.05;

/** What hands and feet do. */
export interface Pedals {
  /** Right positive, from -1 to 1. */
  steering: number;
  /** From 0 to 1. */
  throttle: number;
  brake: number;
}

export const kIdle: Pedals = {steering: 0, throttle: 0, brake: 0};

/** A vehicle in the sense of its driver. A robot with two wheels or tracks follows it as well. */
export class Car {
  gear: Gear = 0;
  /** Why the last change of gear was not made; empty if it was. */
  refusal = '';
  /** Share of the largest speed, without its direction. */
  private speed = 0;
  private steering = 0;

  /** From forward to reverse only at rest: a robot would be asked to turn round within an
   * instant. */
  shift(gear: Gear, pedals: Pedals = kIdle): boolean {
    const stands = this.speed === 0 && pedals.throttle <= kSlack;
    this.refusal =
      gear === this.gear || gear === 0 || stands
        ? ''
        : 'Let go of the throttle to change the gear.';
    if (this.refusal !== '') return false;
    this.gear = gear;
    return true;
  }

  /** Whether a person is at the pedals. In neutral there is nothing to hold: the robot stands. */
  held({steering, throttle, brake}: Pedals): boolean {
    return (
      this.gear !== 0 &&
      (throttle > kSlack || (brake > kSlack && this.speed > 0) || Math.abs(steering) > kSlack)
    );
  }

  /** After `seconds` with the pedals as they are. The throttle is followed at once; the brake goes
   * before it. */
  step(pedals: Pedals, dt_s: number): void {
    const throttle = pedals.throttle > kSlack ? Math.min(pedals.throttle, 1) : 0;
    const brake = pedals.brake > kSlack ? Math.min(pedals.brake, 1) : 0;
    this.steering =
      Math.abs(pedals.steering) > kSlack ? Math.max(-1, Math.min(1, pedals.steering)) : 0;
    this.speed = brake > 0 ? Math.max(0, this.speed - (brake * dt_s) / kFullBrake_s) : throttle;
  }

  /** The dead-man: no control is held. */
  release(): void {
    this.speed = 0;
    this.steering = 0;
  }

  /** Shares of full turn and full speed, as a stick has them: right and forward positive. In
   * reverse the wheels lead the other way, so the same steering turns the other way. */
  get place(): [number, number] {
    return [this.gear * this.steering || 0, this.gear * this.speed || 0];
  }
}

/** As a car gets them: its steering is positive to the left. */
export function carPedals(gear: Gear, {steering, throttle, brake}: Pedals): LinePedals {
  const share = (value: number) => (value > kSlack ? Math.min(value, 1) : 0);
  const left = Math.abs(steering) > kSlack ? Math.max(-1, Math.min(1, -steering)) : 0;
  return {steering: left, throttle: share(throttle), brake: share(brake), gear};
}

/** The stronger of two: a foot on a pedal of the screen and a key at once. */
export function together(a: Pedals, b: Pedals): Pedals {
  const steering = Math.abs(a.steering) >= Math.abs(b.steering) ? a.steering : b.steering;
  return {steering, throttle: Math.max(a.throttle, b.throttle), brake: Math.max(a.brake, b.brake)};
}

/** Keys that drive: forward is the throttle, back the brake. */
export function pedalsOf([x, y]: readonly [number, number]): Pedals {
  return {steering: x, throttle: Math.max(0, y), brake: Math.max(0, -y)};
}
