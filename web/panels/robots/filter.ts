// SPDX-License-Identifier: Apache-2.0
import {RobotFlag} from '../../protocol/frames';
import type {Robot} from '../../protocol/messages';

export interface Filtered {
  robot: Robot;
  speed: number;
  flags: number;
}

export type Filter = (robot: Filtered) => boolean;

const kStates: Record<string, (robot: Filtered) => boolean> = {
  stale: ({flags}) => (flags & RobotFlag.stale) !== 0,
  stopped: ({flags}) => (flags & RobotFlag.stopped) !== 0,
  real: ({robot}) => robot.kind === 'real',
  simulated: ({robot}) => robot.kind === 'simulated',
  recorded: ({robot}) => robot.recorded,
};

/** Words that must all hold: a part of the name or team, a state, or a comparison such as `speed <
 * 0.02`. */
export function parseFilter(text: string): Filter {
  const terms: Filter[] = [];
  const comparison = /\bspeed\s*([<>])\s*([0-9.]+)/g;
  const words = text.replace(comparison, (_, sign: string, limit: string) => {
    const value = Number(limit);
    terms.push(({speed}) => (sign === '<' ? Math.abs(speed) < value : Math.abs(speed) > value));
    return ' ';
  });
  for (const word of words.toLowerCase().split(/\s+/).filter(Boolean)) {
    const state = kStates[word];
    terms.push(
      state ??
        (({robot}) =>
          robot.name.toLowerCase().includes(word) || robot.team.toLowerCase().includes(word)),
    );
  }
  return (robot) => terms.every((term) => term(robot));
}
