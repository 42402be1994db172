// SPDX-License-Identifier: Apache-2.0
import {RobotFlag} from '../../protocol/frames';
import type {Robot} from '../../protocol/messages';

/** What is not normal about a robot, in words; empty if all is. */
export function stateOf(robot: Robot, flags: number): string {
  if ((flags & RobotFlag.known) === 0) return 'no pose yet';
  if ((flags & RobotFlag.stopped) !== 0) return 'stopped';
  if ((flags & RobotFlag.stale) !== 0) return 'pose stale';
  if ((flags & RobotFlag.poseLost) !== 0) return 'pose lost';
  if ((flags & RobotFlag.unarmed) !== 0 && robot.kind === 'real') return 'arm';
  return '';
}

/** Robots of a team that this person may stop and that obey it: recorded ones obey no orders. */
export function stoppable(robots: readonly Robot[], team: string): number[] {
  return robots.flatMap((robot, slot) =>
    robot.team === team && !robot.recorded && robot.stoppable !== false ? [slot] : [],
  );
}
