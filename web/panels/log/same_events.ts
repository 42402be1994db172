// SPDX-License-Identifier: Apache-2.0
import type {Event} from '../../protocol/messages';

/** Events of one moment come in one or two steps of the run. */
const kMoment_s = 0.1;
/** How many rows back the same may be: the log of one moment is no longer. */
const kLookBack = 5000;

/** A row of the log: one event, or the same one of several robots. */
export interface LogRow extends Event {
  /** What several robots have in common; empty of one event. */
  what: string;
}

/** What the event says of its only robot; null if it is of none, of several, or says it otherwise. */
function partOf(event: Event, name: string | undefined): string | null {
  if (event.slots.length !== 1 || name === undefined || !event.text.startsWith(`${name}: `)) return null;
  return event.text.slice(name.length + 2);
}

/** Folds what robots have in common at one moment: one STOP of all is one row. The server folds what one robot repeats,
 * and sends each page the events of its own robots alone, so no row tells of others. */
export function foldSame(events: readonly Event[], names: readonly string[]): LogRow[] {
  const rows: LogRow[] = [];
  const last = new Map<string, number>();
  for (const event of events) {
    const what = partOf(event, names[event.slots[0]]);
    const key = what === null ? '' : `${event.kind}\n${event.level}\n${what}`;
    const at = what === null ? undefined : last.get(key);
    const row = at === undefined || rows.length - at > kLookBack ? undefined : rows[at];
    if (row === undefined || Math.abs(event.t - row.t) > kMoment_s || row.slots.includes(event.slots[0])) {
      if (what !== null) last.set(key, rows.length);
      rows.push({...event, what: ''});
      continue;
    }
    row.what = what ?? '';
    row.slots = [...row.slots, event.slots[0]];
    row.count += event.count;
    row.until = Math.max(row.until, event.until);
    row.text = `${row.slots.map((slot) => names[slot]).join(', ')}: ${row.what}`;
  }
  return rows;
}

/** The names of a row, shortened: the first and the last where they are many. */
export function shownSlots(slots: readonly number[], most = 3): {first: number[]; last: number | null} {
  return slots.length <= most ? {first: [...slots], last: null} : {first: [slots[0]], last: slots[slots.length - 1]};
}
