// SPDX-License-Identifier: Apache-2.0
import type {Reach, Rights, RightsPerson} from '../../protocol/messages';

/** One cell of the table: of how many robots, and whether it was set here or comes from the
 * role. */
export interface Cell {
  reach: Reach;
  own: boolean;
}

/** A row of the table. */
export interface Row {
  /** Role or user, as a change names it. */
  role?: 'observer' | 'commander' | 'super_user';
  user?: string;
  note: string;
  cells: Map<string, Cell>;
}

/** Roles, then people; who has no right of their own has those of their role. */
export function rowsOf(rights: Rights): {roles: Row[]; people: Row[]} {
  const roles = rights.rows
    .filter((row) => row.role !== undefined && row.user === undefined)
    .map(
      (row): Row => ({
        role: row.role,
        note: kNotes[row.role ?? ''] ?? '',
        cells: new Map(
          rights.classes.map((what) => [what, {reach: row.cells[what] ?? 'none', own: false}]),
        ),
      }),
    );
  const people = rights.people.map((person): Row => {
    const set = rights.rows.find((row) => row.user === person.name)?.cells ?? {};
    const role =
      rights.rows.find((row) => row.role === person.role && row.user === undefined)?.cells ?? {};
    return {
      user: person.name,
      note: noteOf(person),
      cells: new Map(
        rights.classes.map((what) => [
          what,
          {reach: set[what] ?? role[what] ?? 'none', own: set[what] !== undefined},
        ]),
      ),
    };
  });
  return {roles, people};
}

const kNotes: Record<string, string> = {
  observer: 'every visitor',
  commander: 'rights of observers, and more',
  super_user: 'all rights',
};

function noteOf({role, teams}: RightsPerson): string {
  const word = role === 'super_user' ? 'super-user' : role;
  if (teams === '*') return `${word} of all teams`;
  return teams === '-' || teams === ''
    ? `${word} of no team`
    : `${word} of ${teams.replaceAll(',', ', ')}`;
}

/** What a press on a cell asks for: more, up to all, then nothing; of a user finally what the role
 * has. */
export function nextReach(cell: Cell, ofUser: boolean): Reach | null {
  if (ofUser && !cell.own) return cell.reach === 'all' ? 'none' : 'all';
  if (cell.reach === 'none') return 'own';
  if (cell.reach !== 'all') return 'all';
  return ofUser ? null : 'none';
}

export function reachText(reach: Reach): string {
  if (reach === 'all') return 'all robots';
  if (reach === 'own') return 'robots of own teams';
  return reach === 'none' ? 'no right' : `robots of ${reach.join(', ')}`;
}

/** `hybrid_parts` is `Hybrid parts`. */
export function className(what: string): string {
  return what.charAt(0).toUpperCase() + what.slice(1).replaceAll('_', ' ');
}
