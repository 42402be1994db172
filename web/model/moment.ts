// SPDX-License-Identifier: Apache-2.0
import type {RunModel} from './run_model';

/** The moment that is shown, seconds of the run. */
export function nowOf(model: RunModel): number {
  return model.poses.newest?.time_s ?? model.time?.now_s ?? 0;
}

/** The timeline reaches from the begin to the planned or known end. A live run can show its present
 * only, but its events are since its begin. */
export function spanOf(model: RunModel): [number, number] {
  const {time} = model;
  if (time === null) return [0, 1];
  const known = Math.max(time.end_s, model.live ? nowOf(model) : 0);
  const begin = model.live ? 0 : time.begin_s;
  return [begin, Math.max(time.duration_s, known, begin + 1e-3)];
}
