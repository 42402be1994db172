// SPDX-License-Identifier: Apache-2.0
import {RobotFlag} from '../protocol/frames';
import type {RunModel} from './run_model';

/** How long a release is held, so that no slip of a finger sets robots in motion. */
export const kHold_ms = 600;
/** Two presses of Space within this time are a STOP. */
export const kTwice_ms = 600;

/** Whom STOP means, and who stands already. */
export interface StopCount {
  /** Those that this person may stop, and that can be reached. */
  robots: number[];
  /** Those of them that stand. */
  stopped: number[];
  /** No robot is left that could be stopped: the button releases. */
  latched: boolean;
}

/** Recorded robots obey no orders, so they do not keep the others from counting as all. */
export function countStopped(
  model: RunModel,
  reaches: (slot: number) => boolean = () => true,
): StopCount {
  const flags = model.poses.newest?.flags;
  const robots: number[] = [];
  const stopped: number[] = [];
  let moving = 0;
  model.robots.forEach((robot, slot) => {
    if (robot.stoppable === false || !reaches(slot)) return;
    robots.push(slot);
    if (((flags?.[slot] ?? 0) & RobotFlag.stopped) !== 0) stopped.push(slot);
    else if (!robot.recorded) ++moving;
  });
  return {robots, stopped, latched: stopped.length > 0 && moving === 0};
}

/** Who stopped, by what the log says of robots that stand: `stopped, by hand: ben`. */
const kByHand = /: stopped, by hand: (.+)$/;

/** The last stop of robots that stand still, and of whom; null where the author is not known. */
export interface LastStop {
  t_s: number;
  /** Empty: the log does not name anybody. */
  who: string;
}

/** When the robots that stand were stopped, and by whom: as the log has it, for everybody's stop
 * alike. `unlogged`: robots whose stop the log cannot have yet. */
export function lastStop(
  model: RunModel,
  unlogged: (slot: number) => boolean = () => false,
): LastStop | null {
  const flags = model.poses.newest?.flags;
  for (let i = model.events.length - 1; i >= 0; --i) {
    const event = model.events[i];
    if (
      event.kind !== 'stopped' ||
      !event.slots.some(
        (slot) => ((flags?.[slot] ?? 0) & RobotFlag.stopped) !== 0 && !unlogged(slot),
      )
    )
      continue;
    return {t_s: event.until, who: kByHand.exec(event.text)?.[1] ?? ''};
  }
  return null;
}

/** A press that counts only after it was held for long enough. */
export class Hold {
  private since_ms: number | null = null;

  constructor(private readonly needed_ms = kHold_ms) {}

  get pressed(): boolean {
    return this.since_ms !== null;
  }

  press(now_ms: number): void {
    this.since_ms ??= now_ms;
  }

  lift(): void {
    this.since_ms = null;
  }

  /** From 0 to 1, where it counts. */
  share(now_ms: number): number {
    return this.since_ms === null ? 0 : Math.min((now_ms - this.since_ms) / this.needed_ms, 1);
  }
}

/** Whether a key was pressed twice in a short time. */
export class Twice {
  private last_ms = -Infinity;

  /** True on the second press. */
  press(now_ms: number): boolean {
    const second = now_ms - this.last_ms <= kTwice_ms;
    this.last_ms = second ? -Infinity : now_ms;
    return second;
  }
}
