// SPDX-License-Identifier: Apache-2.0
import {expect, it} from 'vitest';
import type {Event} from '../../protocol/messages';
import {foldSame, shownSlots} from './same_events';

const kNames = ['real-1', 'real-2', 'walker-1'];

function event(t: number, slots: number[], text: string, more: Partial<Event> = {}): Event {
  return {t, until: t, count: 1, kind: 'stopped', level: 'warn', text, slots, ...more};
}

it('one STOP of all robots is one row that lists them', () => {
  const rows = foldSame(
    kNames.map((name, slot) => event(12.3, [slot], `${name}: stopped, by hand: ben`)),
    kNames,
  );
  expect(rows).toHaveLength(1);
  expect(rows[0]).toMatchObject({
    slots: [0, 1, 2],
    count: 3,
    what: 'stopped, by hand: ben',
    text: 'real-1, real-2, walker-1: stopped, by hand: ben',
  });
});

it('another text, kind or moment is another row', () => {
  const rows = foldSame(
    [
      event(1, [0], 'real-1: stopped, by hand: ben'),
      event(1, [1], 'real-2: stopped, by hand: ada'),
      event(1, [2], 'walker-1: stopped, by hand: ben', {kind: 'guard stopped'}),
      event(2, [1], 'real-2: stopped, by hand: ben'),
    ],
    kNames,
  );
  expect(rows.map((row) => row.slots)).toEqual([[0], [1], [2], [1]]);
});

it('what concerns two robots, or none, is never folded', () => {
  const pair = event(1, [0, 1], 'real-1 and real-2 touch', {kind: 'contact'});
  const none = event(1, [], 'process lost: host `a`');
  expect(foldSame([pair, pair, none, none], kNames)).toHaveLength(4);
});

it('the events that came are as they were', () => {
  const came = [event(1, [0], 'real-1: armed'), event(1, [1], 'real-2: armed')];
  foldSame(came, kNames);
  expect(came[0]).toEqual(event(1, [0], 'real-1: armed'));
});

it('many names are the first and the last', () => {
  expect(shownSlots([4, 5, 6])).toEqual({first: [4, 5, 6], last: null});
  expect(shownSlots([4, 5, 6, 7])).toEqual({first: [4], last: 7});
});
