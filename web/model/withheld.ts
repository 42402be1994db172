// SPDX-License-Identifier: Apache-2.0
import type {Person, Power} from '../protocol/messages';

/** Reason of the server for a power that rights withhold (kNotYours in restricted_source.cpp).
 * Other reasons, such as that a recording takes no orders, are shown as they are. */
export const kNotYours = 'Your rights do not include this.';

type Reach = 'none' | 'own' | 'all';

/** A row of the table of rights, as it is unless a scenario or a super-user changes it. */
export interface RightsRow {
  /** What it covers, as the subject of a sentence. */
  what: string;
  /** Data is seen, a request is done. */
  to: 'see' | 'do';
  /** Observer, commander, super-user. */
  reach: readonly [Reach, Reach, Reach];
}

/** Classes of the table in docs/how-to/share-the-page.md that a page can name; a test compares
 * them. The rights of the present run go to super-users alone. */
export const kUsualRights = {
  pose: {what: 'robots', to: 'see', reach: ['all', 'all', 'all']},
  true_pose: {what: 'true poses', to: 'see', reach: ['none', 'none', 'all']},
  readings: {what: 'sensors and their readings', to: 'see', reach: ['own', 'own', 'all']},
  hybrid_parts: {
    what: 'the real and the virtual half of hybrid sensors',
    to: 'see',
    reach: ['none', 'own', 'all'],
  },
  obstacles: {what: 'virtual obstacles', to: 'see', reach: ['all', 'all', 'all']},
  maps: {what: 'maps', to: 'see', reach: ['own', 'own', 'all']},
  chat: {what: 'the chat', to: 'see', reach: ['own', 'own', 'all']},
  log: {what: 'the log', to: 'see', reach: ['all', 'all', 'all']},
  recording: {what: 'the recording as a file', to: 'see', reach: ['none', 'none', 'all']},
  stop: {what: 'stop robots', to: 'do', reach: ['none', 'all', 'all']},
  release: {what: 'release stopped robots', to: 'do', reach: ['none', 'own', 'all']},
  run_control: {what: 'pause, step and pace the run', to: 'do', reach: ['none', 'none', 'all']},
  command: {what: 'command robots', to: 'do', reach: ['none', 'own', 'all']},
  edit: {what: 'change obstacles and place robots', to: 'do', reach: ['none', 'none', 'all']},
  probe: {what: 'try virtual sensors', to: 'do', reach: ['none', 'own', 'all']},
  conduct: {what: 'start and end runs', to: 'do', reach: ['none', 'none', 'all']},
} as const satisfies Record<string, RightsRow>;

export type RightsClass = keyof typeof kUsualRights;

const kRoles = ['observers', 'commanders', 'super-users'];

/** The class that a power belongs to; null: of no class. */
export function classOf(power: Power): RightsClass | null {
  if (power === 'play' || power === 'step' || power === 'pace') return 'run_control';
  return power in kUsualRights ? (power as RightsClass) : null;
}

/** What is withheld, which roles have it, and whom to ask: three sentences. `people` are those who
 * are here. */
export function withheldText(what: RightsClass, people: readonly Person[]): string {
  return `${notYoursText(what)} ${askText(people)}`;
}

/** The same without whom to ask, for lists. */
export function notYoursText(what: RightsClass): string {
  const row: RightsRow = kUsualRights[what];
  return `You may not ${row.to === 'see' ? 'see ' : ''}${row.what}. ${holdersText(row)}`;
}

/** Which roles have a right, unless it was changed for this run. */
export function holdersText({reach}: RightsRow): string {
  const of = (kind: Reach) => kRoles.filter((_, i) => reach[i] === kind);
  const all = of('all');
  if (of('own').length === 0) return `By default ${listed(all, 'and')} have this right.`;
  const own = listed(of('own'), 'and');
  return (
    `By default ${own} have this right for robots of their teams, ` +
    `${listed(all, 'and')} for all robots.`
  );
}

/** Which roles have a right, and whom to ask for it: two sentences. */
export function rightText(what: RightsClass, people: readonly Person[]): string {
  return `${holdersText(kUsualRights[what])} ${askText(people)}`;
}

/** The super-users who are here, by name. */
export function askText(people: readonly Person[]): string {
  const names = people.filter(({role}) => role === 'super_user').map(({name}) => name);
  if (names.length === 0) return 'Ask a super-user for it; none is here now.';
  return `Ask a super-user who is here: ${listed(names, 'or')}.`;
}

function listed(words: readonly string[], last: string): string {
  return words.length < 2
    ? words.join('')
    : `${words.slice(0, -1).join(', ')} ${last} ${words[words.length - 1]}`;
}
