// SPDX-License-Identifier: Apache-2.0
import type {Placed} from '../../model/pose_history';
import type {Robot} from '../../protocol/messages';
import type {ColourBy} from './layers';

const kFastest_mps = 0.4;
const kOldest_s = 5;

/** Where a simulated robot stands on the ramp of "colour by". */
export class Tint {
  private teams: string[] = [];
  private teamOf: number[] = [];

  refresh(robots: readonly Robot[]): void {
    this.teams = [
      ...new Set(robots.filter((robot) => robot.kind === 'simulated').map((robot) => robot.team)),
    ];
    this.teamOf = robots.map((robot) => this.teams.indexOf(robot.team));
  }

  /** From 0 to 1; null where the colour is that of the kind. */
  share(
    by: ColourBy,
    slot: number,
    placed: Placed,
    speeds: Float32Array | undefined,
  ): number | null {
    if (by === 'team')
      return this.teams.length < 2 ? 0.5 : this.teamOf[slot] / (this.teams.length - 1);
    if (by === 'speed') return Math.abs(speeds?.[slot] ?? 0) / kFastest_mps;
    if (by === 'age') return (placed.time_s - placed.freshAt(slot)) / kOldest_s;
    return null;
  }

  /** The ends of the scale, for the legend. */
  scale(by: ColourBy): [string, string] {
    if (by === 'team')
      return [this.teams[0] ?? '', this.teams.length > 1 ? this.teams[this.teams.length - 1] : ''];
    return by === 'speed' ? ['0', `${kFastest_mps} m/s`] : ['now', `${kOldest_s} s`];
  }
}
