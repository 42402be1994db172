// SPDX-License-Identifier: Apache-2.0
import type {RunModel} from '../../model/run_model';

/** The guard of a robot holds it back. */
export interface GuardAct {
  /** What it lets through, m/s. */
  limit_mps: number;
  why: string;
}

const kRecent_s = 3;

/** What the guard of a robot did last, if that was a moment ago. `asked_mps`: null if nobody drives it. */
export function guardOf(model: RunModel, slot: number, asked_mps: number | null): GuardAct | null {
  const now_s = model.poses.newest?.time_s ?? 0;
  const driven = Math.abs(model.poses.newest?.speed[slot] ?? 0);
  for (let i = model.events.length - 1; i >= 0; --i) {
    const event = model.events[i];
    if (event.until < now_s - kRecent_s) break;
    if (!event.kind.startsWith('guard ') || !event.slots.includes(slot)) continue;
    if (asked_mps !== null && Math.abs(asked_mps) <= driven + 0.02) return null;
    return {limit_mps: driven, why: event.text.replace(/^[^:]*: /, '')};
  }
  return null;
}
