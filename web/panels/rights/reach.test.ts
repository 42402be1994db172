// SPDX-License-Identifier: Apache-2.0
import {expect, it} from 'vitest';
import type {Rights} from '../../protocol/messages';
import {className, nextReach, reachText, rowsOf} from './reach';

const kRights: Rights = {
  type: 'rights',
  classes: ['pose', 'readings'],
  teams: ['green'],
  rows: [
    {role: 'observer', cells: {pose: 'all', readings: 'own'}},
    {user: 'carla', cells: {pose: 'none'}},
  ],
  people: [
    {name: 'carla', role: 'observer', teams: 'green,blue'},
    {name: 'ben', role: 'observer', teams: '*'},
  ],
};

it('people have what their role has, but for what was set for them', () => {
  const {roles, people} = rowsOf(kRights);
  expect(roles.map((row) => row.role)).toEqual(['observer']);
  expect(people[0].cells.get('pose')).toEqual({reach: 'none', own: true});
  expect(people[0].cells.get('readings')).toEqual({reach: 'own', own: false});
  expect(people[1].cells.get('pose')).toEqual({reach: 'all', own: false});
  expect(people[0].note).toBe('observer of green, blue');
});

it('a press gives more, then nothing, then what the role has', () => {
  expect(nextReach({reach: 'none', own: false}, false)).toBe('own');
  expect(nextReach({reach: 'own', own: false}, false)).toBe('all');
  expect(nextReach({reach: 'all', own: false}, false)).toBe('none');
  expect(nextReach({reach: 'all', own: false}, true)).toBe('none');
  expect(nextReach({reach: 'none', own: true}, true)).toBe('own');
  expect(nextReach({reach: 'all', own: true}, true)).toBeNull();
});

it('reaches and classes are said in words', () => {
  expect(reachText(['red', 'green'])).toBe('robots of red, green');
  expect(reachText('none')).toBe('no right');
  expect(className('hybrid_parts')).toBe('Hybrid parts');
});
