// SPDX-License-Identifier: Apache-2.0
import {RobotFlag} from '../protocol/frames';
import type {DirectLines} from './direct_lines';
import type {RunModel} from './run_model';

/** Without the server the last picture stands, so who is stopped is what the hosts say over the
 * direct lines. */
export class LineStops {
  /** Slots that stand by the word of their host alone: neither a picture nor the log of the server
   * has it. */
  private readonly marked = new Set<number>();
  private picture: object | null = null;

  constructor(
    private readonly model: RunModel,
    private readonly lines: DirectLines,
  ) {}

  /** Whether a host has stopped the robot since the last picture of the server. */
  has(slot: number): boolean {
    return this.picture === this.model.poses.newest && this.marked.has(slot);
  }

  /** Takes the words of the hosts over into the last picture. */
  take(): void {
    const newest = this.model.poses.newest;
    if (newest === null) return;
    if (newest !== this.picture) {
      this.picture = newest;
      this.marked.clear();
    }
    let changed = false;
    this.model.robots.forEach((robot, slot) => {
      // Of a robot that this person may not stop its host says nothing.
      const stands = this.model.stops(slot) ? this.lines.stands(robot.name) : null;
      const shown = (newest.flags[slot] & RobotFlag.stopped) !== 0;
      if (stands === null || stands === shown) return;
      newest.flags[slot] ^= RobotFlag.stopped;
      if (stands) this.marked.add(slot);
      else this.marked.delete(slot);
      changed = true;
    });
    if (changed) this.model.pictureChanged.emit();
  }
}
