// SPDX-License-Identifier: Apache-2.0
import type {Event} from '../protocol/messages';
import type {KnownRobot, RunModel} from './run_model';

/** The first line of the log: with what the run began. The server does not send it, as hello and
 * roster say all of it. null: that is not known yet, or this person does not get the log. */
export function beginOf(model: RunModel): Event | null {
  const {hello, time, robots} = model;
  if (hello === null || !model.rosterCame || !model.may('log')) return null;
  if (!model.live && time === null) return null;
  const t = model.live ? 0 : (time?.begin_s ?? 0);
  // A recording may have a part of its run only.
  const what = t > 1.5 * hello.run.step_s ? 'Recording begins' : 'Run begins';
  return {
    t,
    until: t,
    count: 1,
    kind: 'begin',
    level: 'info',
    text: `${what}: ${robotsText(robots)}, seed ${hello.run.seed}`,
    slots: [],
  };
}

/** All lines of the log, oldest first. */
export function logOf(model: RunModel): readonly Event[] {
  const begin = beginOf(model);
  return begin === null ? model.events : [begin, ...model.events];
}

function robotsText(robots: readonly KnownRobot[]): string {
  const real = robots.filter(
    ({kind, handedOver}) => (kind === 'real') !== (handedOver === true),
  ).length;
  const counts = [
    [real, 'real'],
    [robots.length - real, 'simulated'],
  ].filter(([count]) => count !== 0);
  if (counts.length === 0) return 'no robots';
  const words = counts.map(([count, word]) => `${count} ${word}`).join(' and ');
  return `${words} robot${robots.length === 1 ? '' : 's'}`;
}
