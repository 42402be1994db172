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

/** What the event says of its only robot; null if it is of none, of several, or says it
 * otherwise. */
function partOf(event: Event, name: string | undefined): string | null {
  if (event.slots.length !== 1 || name === undefined || !event.text.startsWith(`${name}: `))
    return null;
  return event.text.slice(name.length + 2);
}

/** Folds what robots have in common at one moment: one STOP of all is one row. The server folds
 * what one robot repeats, and sends each page the events of its own robots alone, so no row tells
 * of others. */
export function foldSame(events: readonly Event[], names: readonly string[]): LogRow[] {
  const rows: LogRow[] = [];
  const last = new Map<string, number>();
  /** By row: the robots that it has already. */
  const known = new Map<LogRow, Set<number>>();
  for (const event of events) {
    const what = partOf(event, names[event.slots[0]]);
    const key = what === null ? '' : `${event.kind}\n${event.level}\n${what}`;
    const at = what === null ? undefined : last.get(key);
    const row = at === undefined || rows.length - at > kLookBack ? undefined : rows[at];
    if (
      row === undefined ||
      Math.abs(event.t - row.t) > kMoment_s ||
      known.get(row)?.has(event.slots[0])
    ) {
      const own: LogRow = {...event, slots: [...event.slots], what: ''};
      if (what !== null) {
        last.set(key, rows.length);
        known.set(own, new Set(event.slots));
      }
      rows.push(own);
      continue;
    }
    row.what = what ?? '';
    row.slots.push(event.slots[0]);
    known.get(row)?.add(event.slots[0]);
    row.count += event.count;
    row.until = Math.max(row.until, event.until);
  }
  for (const row of rows) if (row.what !== '') row.text = shortText(row, names);
  return rows;
}

function shortText(row: LogRow, names: readonly string[]): string {
  const {first, last} = shownSlots(row.slots);
  const named = first.map((slot) => names[slot]).join(', ');
  return `${named}${last === null ? '' : ` … ${names[last]}`}: ${row.what}`;
}

/** The names of a row, shortened: the first and the last where they are many. */
export function shownSlots(
  slots: readonly number[],
  most = 3,
): {first: number[]; last: number | null} {
  return slots.length <= most
    ? {first: [...slots], last: null}
    : {first: [slots[0]], last: slots[slots.length - 1]};
}
