// SPDX-License-Identifier: Apache-2.0
import type {AskConduct, Transport} from '../../protocol/messages';

/** What a line asks: of the server about runs, of the run about its time, or nothing but a text. */
export type Asked =
  | {conduct: Omit<AskConduct, 'request'>}
  | {transport: Transport}
  | {text: string}
  | {error: string};

/** The commands, with what follows each, in the words of the terminal. */
export const kCommandHelp: readonly [string, string][] = [
  ['scenarios', 'lists what can be started'],
  ['start NAME [--seed N]', 'starts a run'],
  ['end', 'ends the run'],
  ['restart [--seed N]', 'starts the same scenario again'],
  ['pause', 'holds the run'],
  ['resume', 'continues it'],
  ['step [N]', 'computes steps of a paused run'],
  ['pace FACTOR', 'simulated seconds per second, or max'],
  ['open RUN', 'shows a recording in all pages'],
  ['close', 'shows the list in all pages'],
];

const kNames = kCommandHelp.map(([usage]) => usage.split(' ')[0]);

/** Commands that begin like a line. */
export function completions(line: string): readonly [string, string][] {
  const word = line.trimStart();
  if (word === '' || word.includes(' ')) return [];
  return kCommandHelp.filter(([usage]) => usage.startsWith(word));
}

/** Takes `--seed N` out of the words; null: it is no whole number. */
function takeSeed(words: string[]): {seed?: number} | null {
  const at = words.indexOf('--seed');
  if (at < 0) return {};
  const [, value] = words.splice(at, 2);
  return /^\d{1,9}$/.test(value ?? '') ? {seed: Number(value)} : null;
}

function timeOf(name: string, value: string | undefined): Asked | null {
  if (name === 'pause') return {transport: {type: 'transport', do: 'pause'}};
  if (name === 'resume') return {transport: {type: 'transport', do: 'play'}};
  if (name === 'step') {
    const steps = value === undefined ? 1 : Number(value);
    return Number.isInteger(steps) && steps > 0
      ? {transport: {type: 'transport', do: 'step', value: steps}}
      : {error: '`step`: expected a whole number from 1'};
  }
  if (name !== 'pace') return null;
  const factor = value === 'max' ? 0 : Number(value?.replace(/x$/, ''));
  return value === 'max' || factor > 0
    ? {transport: {type: 'transport', do: 'pace', value: factor}}
    : {error: '`pace`: expected a factor such as 2x, or max'};
}

/** Reads a line. `scenarios` are the names that can be started. */
export function readLine(line: string, scenarios: readonly string[]): Asked {
  const [name = '', ...words] = line.trim().split(/\s+/);
  if (!kNames.includes(name))
    return {error: `there is no command \`${name}\`; there are ${kNames.join(', ')}`};
  const seed = takeSeed(words);
  if (seed === null) return {error: '`--seed`: expected a whole number'};
  if ('seed' in seed && name !== 'start' && name !== 'restart')
    return {error: `\`${name}\` takes no seed`};
  const takes = ['start', 'open', 'step', 'pace'].includes(name) ? 1 : 0;
  if (words.length > takes) return {error: `\`${name}\`: unexpected \`${words[takes]}\``};
  const time = timeOf(name, words[0]);
  if (time !== null) return time;
  if (name === 'scenarios') return {text: scenarios.join(', ')};
  if (takes === 1) {
    if (words[0] === undefined) return {error: `\`${name}\`: expected a name`};
    return {conduct: {type: 'conduct', do: name as 'start' | 'open', name: words[0], ...seed}};
  }
  return {conduct: {type: 'conduct', do: name as 'end' | 'restart' | 'close', ...seed}};
}
