// SPDX-License-Identifier: Apache-2.0
import type {Placed} from '../../model/pose_history';
import {RobotFlag} from '../../protocol/frames';
import type {Stage} from './stage';

/** So often it is looked whether a robot has left the picture. */
const kLook_ms = 500;

/** Keeps all robots in the picture for as long as the person has not chosen what is shown. */
export class AutoFit {
  /** Robots with a pose when the picture was fitted last, -1: it was not. On the bus poses come
   * after the world, host by host. */
  private fittedRobots = -1;
  /** The person has chosen what is shown. */
  private moved = false;
  /** The person asked for everything, so it stays everything. */
  private everything = false;
  private lookedAt_ms = -Infinity;

  /** Another run: nothing has been chosen. */
  reset(): void {
    this.fittedRobots = -1;
    this.moved = false;
    this.everything = false;
  }

  /** The picture has another size, or is another one. */
  again(): void {
    this.fittedRobots = -1;
  }

  /** The person moves the camera. */
  move(): void {
    this.moved = true;
  }

  /** The person asks for everything; where that is shown, for the selection. */
  ask(stage: Stage, animate: boolean): void {
    this.moved = stage.fit(animate, 'closer') === 'selection';
    this.everything = true;
  }

  /** Before a picture: fits it to those who have come, and to who is about to leave it. */
  look(stage: Stage, placed: Placed, now_ms: number, animate: boolean): void {
    if (this.moved) return;
    if (this.fittedRobots < placed.count) {
      let known = 0;
      for (let slot = 0; slot < placed.count; ++slot)
        known += placed.flags[slot] & RobotFlag.known ? 1 : 0;
      if (
        known > this.fittedRobots &&
        stage.fit(false, this.everything ? 'all' : 'room') !== 'nothing'
      )
        this.fittedRobots = known;
    }
    if (now_ms - this.lookedAt_ms < kLook_ms) return;
    this.lookedAt_ms = now_ms;
    if (hasLeft(stage, placed)) stage.fit(animate, 'more');
  }
}

function hasLeft(stage: Stage, placed: Placed): boolean {
  const {clientWidth, clientHeight} = stage.element;
  for (let slot = 0; slot < placed.count; ++slot) {
    if ((placed.flags[slot] & RobotFlag.known) === 0) continue;
    const [x, y] = stage.screenOf(slot);
    if (x < 0 || y < 0 || x > clientWidth || y > clientHeight) return true;
  }
  return false;
}

/** Whether the person wants what moves by itself. */
export function motion(): boolean {
  return !matchMedia('(prefers-reduced-motion: reduce)').matches;
}
