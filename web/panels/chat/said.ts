// SPDX-License-Identifier: Apache-2.0
import type {RunModel} from '../../model/run_model';

/** What stands in the chat: of people, of robots, or what became of a lease. */
export interface Said {
  key: string;
  t: number;
  kind: 'person' | 'robot' | 'note';
  name: string;
  /** Of a robot. */
  slot: number | null;
  yours: boolean;
  /** For whom; empty: for all. */
  to: string;
  text: string;
}

const kNotes = ['lease', 'ordered'];

/** Lines of people, answers of robots and changes of leases, oldest first. */
export function saidIn(model: RunModel): Said[] {
  const all: Said[] = model.lines.map((line) => ({
    key: `p${line.number}`,
    t: line.t,
    kind: 'person',
    name: line.yours ? 'You' : line.from.name,
    slot: null,
    yours: line.yours,
    to: addressee(line.to, line.name),
    text: line.text,
  }));
  model.events.forEach((event, i) => {
    if (event.kind !== 'said' && !kNotes.includes(event.kind)) return;
    const slot = event.slots[0] ?? null;
    const name = slot === null ? '' : (model.robots[slot]?.name ?? '');
    const text =
      event.kind === 'said'
        ? withoutSubject(event.text, name)
        : event.text.replace(/: (lease|ordered), /, ': ');
    all.push({
      key: `e${i}`,
      t: event.t,
      kind: event.kind === 'said' ? 'robot' : 'note',
      name,
      slot,
      yours: false,
      to: '',
      text,
    });
  });
  return all.sort((a, b) => a.t - b.t);
}

/** An event says `walker-5: said, here I am`. */
function withoutSubject(text: string, name: string): string {
  const rest = text.startsWith(`${name}: `) ? text.slice(name.length + 2) : text;
  return rest.startsWith('said, ') ? rest.slice(6) : rest;
}

function addressee(to: string, name: string): string {
  if (to === 'all') return '';
  if (to === 'role')
    return (
      {observer: 'observers', commander: 'commanders', super_user: 'super-users'}[name] ?? name
    );
  return to === 'team' ? `team ${name}` : name;
}
