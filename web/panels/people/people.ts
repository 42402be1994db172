// SPDX-License-Identifier: Apache-2.0
// What is said of people, invitations and lines of the audit log.
import type {AuditLine, KnownInvitation, KnownPerson} from '../../protocol/messages';

export type Role = KnownPerson['role'];
export const kRoles: readonly Role[] = ['observer', 'commander', 'super_user'];

/** `green,blue` as `green, blue`. */
export function teamsText(teams: string): string {
  if (teams === '*') return 'all teams';
  return teams === '-' || teams === '' ? 'no team' : teams.replaceAll(',', ', ');
}

/** Teams as the server takes them: names that were ticked and names that were typed. */
export function teamsOf(all: boolean, ticked: Iterable<string>, typed: string): string {
  if (all) return '*';
  const names = new Set(
    [...ticked, ...typed.split(',').map((name) => name.trim())].filter((name) => name !== ''),
  );
  return names.size === 0 ? '-' : [...names].sort().join(',');
}

/** How long ago, in the largest unit that is not zero. */
export function agoText(moment_s: number, now_s: number): string {
  if (moment_s === 0) return 'never';
  const ago = now_s - moment_s;
  if (ago < 60) return 'just now';
  return `${spanText(ago)} ago`;
}

/** When something ends. */
export function endsText(until_s: number, now_s: number): string {
  return until_s <= now_s ? 'ended' : `ends in ${spanText(until_s - now_s)}`;
}

function spanText(span_s: number): string {
  if (span_s >= 2 * 86_400) return `${Math.floor(span_s / 86_400)} days`;
  if (span_s >= 3600) return `${Math.floor(span_s / 3600)} h`;
  return `${Math.max(1, Math.floor(span_s / 60))} min`;
}

/** Whether a person is here, when they were, or that they cannot come. */
export function seenText(person: KnownPerson, now_s: number): string {
  if (person.disabled) return 'disabled';
  return person.pages > 0 ? 'now' : agoText(person.seen_s, now_s);
}

/** What else is to be known of an account; empty: nothing. */
export function accountText({guest, name_given}: KnownPerson): string {
  return [guest ? 'guest, no password' : '', name_given ? '' : 'chose this name']
    .filter(Boolean)
    .join('; ');
}

/** Those whose name, role or teams have what was typed; who is here comes first. */
export function peopleWith(people: readonly KnownPerson[], typed: string): KnownPerson[] {
  const part = typed.trim().toLowerCase();
  const fits = ({name, role, teams}: KnownPerson) =>
    `${name} ${role.replace('_', '-')} ${teamsText(teams)}`.toLowerCase().includes(part);
  return people
    .filter(fits)
    .sort((a, b) => Number(b.pages > 0) - Number(a.pages > 0) || a.name.localeCompare(b.name));
}

export function usesText({uses, name}: KnownInvitation): string {
  if (name !== '') return `for ${name}`;
  return uses === 1 ? 'for one person' : `${uses} uses left`;
}

/** Kinds of lines, as the filter offers them. */
export const kAuditKinds: readonly string[] = [
  'login',
  'logout',
  'refused',
  'cut_off',
  'stop',
  'release',
  'order',
  'right',
  'see_as',
  'account',
  'invitation',
  'recording',
  'accounts',
];

/** `you` is who has the link of the terminal. */
export function whoText(line: AuditLine): string {
  const user = line.user ?? '';
  return user === 'you' || user === 'operator'
    ? 'The operator'
    : user === ''
      ? (line.from ?? 'Somebody')
      : user;
}

/** A line as a sentence without its subject. */
export function auditText(line: AuditLine): string {
  const {what, why, by, from, detail} = line;
  const said = detail ?? '';
  const at = from === undefined || line.user === undefined ? '' : ` from ${from}`;
  switch (what) {
    case 'login':
      return `signed in by ${by ?? 'link'}${at}`;
    case 'logout':
      return `signed out${at}`;
    case 'refused':
      return `was refused: ${[why, said].filter(Boolean).join(', ')}${at}`;
    case 'stop':
      return `stopped ${said}`;
    case 'release':
      return `released ${said}`;
    case 'right':
      return `set the right ${said}`;
    case 'cut_off':
      return `was cut off: ${why}`;
    case 'see_as':
      return said === 'self' ? 'no longer views the page as another user' : `sees as ${said}`;
    case 'order':
      return `ordered ${said}`;
    case 'account':
      return `changed ${said}`;
    case 'invitation':
      return `invitation ${said}`;
    case 'recording':
      return `downloaded the recording${at}`;
    default:
      return [what, why, said].filter(Boolean).join(': ');
  }
}

/** Time of day of a moment of today, and otherwise the day too. */
export function auditTime(iso: string, now: Date): string {
  const moment = new Date(iso);
  if (Number.isNaN(moment.getTime())) return iso;
  const two = (value: number) => String(value).padStart(2, '0');
  const time = `${two(moment.getHours())}:${two(moment.getMinutes())}:${two(moment.getSeconds())}`;
  return moment.toDateString() === now.toDateString()
    ? time
    : `${moment.getFullYear()}-${two(moment.getMonth() + 1)}-${two(moment.getDate())} ${time}`;
}
