// SPDX-License-Identifier: Apache-2.0
import type {RunModel} from '../../model/run_model';
import {kCommandsOf} from '../../protocol/frames';

/** The velocities that a robot was told last: what its program or driver asked for, and what is
 * left of it behind controllers and guard. */
export interface ToldVelocity {
  asked: [number, number];
  given: [number, number];
}

/** What is older says nothing of now. */
const kFresh_s = 1;

/** Null: the page has not received it, or there is no velocity. */
export function toldOf(model: RunModel, slot: number): ToldVelocity | null {
  const reading = model.readings.of(slot, kCommandsOf);
  const now_s = model.poses.newest?.time_s ?? 0;
  if (reading === null || reading.values.length !== 4 || now_s - reading.stamp_s > kFresh_s)
    return null;
  const [v, w, givenV, givenW] = reading.values;
  return [v, w, givenV, givenW].every(Number.isFinite)
    ? {asked: [v, w], given: [givenV, givenW]}
    : null;
}

/** Lines of what was asked of a robot, by whomever, as the host told it. */
export function toldLines(
  model: RunModel,
  slot: number,
  of: 'v' | 'w',
  since_s: number,
): [number, number][][] {
  const lines: [number, number][][] = [];
  let line: [number, number][] = [];
  for (const {time_s, values} of model.readings.course(slot, kCommandsOf)) {
    const value = values[of === 'v' ? 0 : 1];
    const gap = line.length > 0 && time_s - line[line.length - 1][0] > kFresh_s;
    if (gap || !Number.isFinite(value)) {
      if (line.length > 0) lines.push(line);
      line = [];
    }
    if (Number.isFinite(value) && time_s >= since_s) line.push([time_s, value]);
  }
  return line.length > 0 ? [...lines, line] : lines;
}
