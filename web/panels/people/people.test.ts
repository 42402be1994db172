// SPDX-License-Identifier: Apache-2.0
import {expect, it} from 'vitest';
import type {KnownPerson} from '../../protocol/messages';
import {
  accountText,
  agoText,
  auditText,
  auditTime,
  endsText,
  peopleWith,
  seenText,
  teamsOf,
  teamsText,
  usesText,
  whoText,
} from './people';

const kNow_s = 1_800_000_000;

function person(name: string, more: Partial<KnownPerson> = {}): KnownPerson {
  return {
    name,
    role: 'observer',
    teams: '*',
    guest: false,
    name_given: true,
    disabled: false,
    pages: 0,
    sessions: 0,
    seen_s: 0,
    ...more,
  };
}

it('teams are said and sent', () => {
  expect(teamsText('*')).toBe('all teams');
  expect(teamsText('-')).toBe('no team');
  expect(teamsText('blue,green')).toBe('blue, green');
  expect(teamsOf(true, ['green'], 'x')).toBe('*');
  expect(teamsOf(false, [], ' , ')).toBe('-');
  expect(teamsOf(false, ['green', 'blue'], 'red, green')).toBe('blue,green,red');
});

it('moments are said in one unit', () => {
  expect(agoText(0, kNow_s)).toBe('never');
  expect(agoText(kNow_s - 59, kNow_s)).toBe('just now');
  expect(agoText(kNow_s - 61, kNow_s)).toBe('1 min ago');
  expect(agoText(kNow_s - 47 * 3600, kNow_s)).toBe('47 h ago');
  expect(agoText(kNow_s - 49 * 3600, kNow_s)).toBe('2 days ago');
  expect(endsText(kNow_s + 23 * 3600 + 5, kNow_s)).toBe('ends in 23 h');
  expect(endsText(kNow_s, kNow_s)).toBe('ended');
});

it('who is here is seen now, and who is disabled never', () => {
  expect(seenText(person('ada', {pages: 2}), kNow_s)).toBe('now');
  expect(seenText(person('ada', {seen_s: kNow_s - 7200}), kNow_s)).toBe('2 h ago');
  expect(seenText(person('ada', {disabled: true, pages: 1}), kNow_s)).toBe('disabled');
});

it('people are found by name, role and team, those who are here first', () => {
  const people = [
    person('zoe', {pages: 1}),
    person('ben', {teams: 'green'}),
    person('Ada', {role: 'super_user'}),
  ];
  expect(peopleWith(people, '').map(({name}) => name)).toEqual(['zoe', 'Ada', 'ben']);
  expect(peopleWith(people, 'GREEN').map(({name}) => name)).toEqual(['ben']);
  expect(peopleWith(people, 'super-user').map(({name}) => name)).toEqual(['Ada']);
  expect(
    usesText({id: '', role: 'observer', teams: '*', uses: 1, until_s: 0, by: 'ada', name: ''}),
  ).toBe('for one person');
  expect(
    usesText({id: '', role: 'observer', teams: '*', uses: 1, until_s: 0, by: 'ada', name: 'ben'}),
  ).toBe('for ben');
  expect(accountText(person('ada'))).toBe('');
  expect(accountText(person('eve', {guest: true, name_given: false}))).toBe(
    'guest, no password; chose this name',
  );
});

it('lines of the audit log are sentences', () => {
  const line = {
    time: '2026-08-03T10:00:00Z',
    what: 'refused',
    user: 'eve',
    why: 'order',
    detail: 'goal: no',
  };
  expect(`${whoText(line)} ${auditText(line)}`).toBe('eve was refused: order, goal: no');
  expect(whoText({time: '', what: 'refused', from: '10.0.0.1'})).toBe('10.0.0.1');
  expect(whoText({time: '', what: 'stop', user: 'you'})).toBe('The operator');
  expect(auditText({time: '', what: 'login', user: 'ada', by: 'password', from: '::1'})).toBe(
    'signed in by password from ::1',
  );
  expect(auditText({time: '', what: 'see_as', user: 'ada', detail: 'self'})).toContain(
    'no longer views',
  );
  expect(auditText({time: '', what: 'new kind', detail: 'x'})).toBe('new kind: x');
});

it('a time of today has no day', () => {
  const noon = new Date(2026, 7, 3, 12, 0, 5);
  expect(auditTime(noon.toISOString(), noon)).toBe('12:00:05');
  expect(auditTime(noon.toISOString(), new Date(2026, 7, 4))).toBe('2026-08-03 12:00:05');
  expect(auditTime('x', noon)).toBe('x');
});
