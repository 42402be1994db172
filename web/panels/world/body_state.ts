// SPDX-License-Identifier: Apache-2.0
import type {Placed} from '../../model/pose_history';
import {RobotFlag} from '../../protocol/frames';
import type {Robot} from '../../protocol/messages';

/** How a body is drawn: as usual, as one that waits to be armed, or as a ghost at its last pose. */
export type BodyState = 'plain' | 'unarmed' | 'stale';

/** Of a robot with these flags; only real ones wait to be armed. */
export function bodyState(kind: Robot['kind'], flags: number): BodyState {
  if ((flags & RobotFlag.stale) !== 0) return 'stale';
  return kind === 'real' && (flags & RobotFlag.unarmed) !== 0 ? 'unarmed' : 'plain';
}

/** How far a ghost may have come since its last pose: at the highest speed that was seen of it.
 * Metres. */
export function reachOf(placed: Placed, slot: number): number {
  return (placed.fastest[slot] ?? 0) * Math.max(placed.time_s - placed.freshAt(slot), 0);
}
