// SPDX-License-Identifier: Apache-2.0
import type {RunModel} from '../../model/run_model';
import {toldOf} from './told';

/** The guard of a robot holds it back. */
export interface GuardAct {
  /** What it lets through, m/s. */
  limit_mps: number;
  why: string;
}

const kRecent_s = 3;
/** So much less than was asked, m/s or rad/s, is not rounding. */
const kHeld = 0.01;

const words = (text: string) => text.replace(/^[^:]*: /, '');

/** What the guard of a robot did at last, however long ago; null: nothing that this person may
 * read. */
export function lastAct(model: RunModel, slot: number): {ago_s: number; why: string} | null {
  const now_s = model.poses.newest?.time_s ?? 0;
  for (let i = model.events.length - 1; i >= 0; --i) {
    const {kind, slots, t, until, text} = model.events[i];
    if (kind.startsWith('guard ') && slots.includes(slot) && t <= now_s)
      return {ago_s: Math.max(0, now_s - until), why: words(text)};
  }
  return null;
}

/** What the guard of a robot did last, if that was a moment ago. `asked_mps`: null if no person
 * drives it. */
export function guardOf(model: RunModel, slot: number, asked_mps: number | null): GuardAct | null {
  const now_s = model.poses.newest?.time_s ?? 0;
  const told = toldOf(model, slot);
  if (told !== null) {
    const held = told.asked.some((value, i) => Math.abs(value) > Math.abs(told.given[i]) + kHeld);
    const last = lastAct(model, slot);
    const why = last !== null && last.ago_s < kRecent_s ? last.why : 'above the limit of its drive';
    return held ? {limit_mps: Math.abs(told.given[0]), why} : null;
  }
  const driven = Math.abs(model.poses.newest?.speed[slot] ?? 0);
  for (let i = model.events.length - 1; i >= 0; --i) {
    const event = model.events[i];
    if (event.until < now_s - kRecent_s) break;
    if (!event.kind.startsWith('guard ') || !event.slots.includes(slot)) continue;
    if (asked_mps !== null && Math.abs(asked_mps) <= driven + 0.02) return null;
    return {limit_mps: driven, why: words(event.text)};
  }
  return null;
}
