// SPDX-License-Identifier: Apache-2.0
import {readFileSync} from 'node:fs';
import {join} from 'node:path';
import {describe, expect, it} from 'vitest';
import type {Hello, Person, Power} from '../protocol/messages';
import {RunModel} from './run_model';
import {
  askText,
  classOf,
  holdersText,
  kNotYours,
  kUsualRights,
  withheldText,
  type RightsClass,
} from './withheld';

const kBoss: Person = {name: 'ada', role: 'super_user'};
/** Of these nothing is sent to a page that it could name: goals are left out of a robot's state, no
 * video exists. */
const kUnnamed = ['goals', 'video'];

it('is the table of the documentation, which the server is compared with', () => {
  const page = readFileSync(join(process.cwd(), '../docs/how-to/share-the-page.md'), 'utf8');
  const rows = [...page.matchAll(/^\| `(\w+)` \| (\w+) \| (\w+) \| (\w+) \|/gm)].map(
    ([, name, ...reach]) => [name, reach] as const,
  );
  expect(rows.length).toBe(18);
  const named = rows.filter(([name]) => !kUnnamed.includes(name));
  expect(Object.fromEntries(named)).toEqual(
    Object.fromEntries(Object.entries(kUsualRights).map(([name, {reach}]) => [name, [...reach]])),
  );
});

it('has the words of the server for what rights withhold', () => {
  const source = readFileSync(
    join(process.cwd(), '../servers/gui_server/src/visitors/restricted_source.cpp'),
    'utf8',
  );
  expect(source).toContain(`kNotYours = "${kNotYours}"`);
});

describe('what is withheld', () => {
  it('is named with the roles that have it and whom to ask', () => {
    expect(withheldText('obstacles', [kBoss])).toBe(
      'You may not see virtual obstacles. By default observers, commanders and super-users ' +
        'have this right. Ask a super-user who is here: ada.',
    );
    expect(withheldText('stop', [])).toBe(
      'You may not stop robots. By default commanders and super-users have this right. ' +
        'Ask a super-user for it; none is here now.',
    );
  });

  it('says where a right covers the robots of some teams', () => {
    expect(holdersText(kUsualRights.readings)).toBe(
      'By default observers and commanders have this right for robots of their teams, ' +
        'super-users for all robots.',
    );
    expect(holdersText(kUsualRights.recording)).toBe('By default super-users have this right.');
  });

  it('names everybody who can change it, and nobody else', () => {
    expect(
      askText([kBoss, {name: 'eve', role: 'observer'}, {name: 'bob', role: 'super_user'}]),
    ).toBe('Ask a super-user who is here: ada or bob.');
  });
});

it('knows each power that rights can withhold', () => {
  const powers: Power[] = [
    'play',
    'pace',
    'step',
    'stop',
    'release',
    'true_pose',
    'readings',
    'hybrid_parts',
    'obstacles',
    'log',
    'recording',
    'command',
    'edit',
    'chat',
    'maps',
    'probe',
  ];
  const classes = powers.map((power): RightsClass | null => classOf(power));
  expect(classes).not.toContain(null);
  expect(new Set(classes.slice(0, 3))).toEqual(new Set(['run_control']));
});

describe('a model', () => {
  const hello = (why_not: Record<string, string>): Hello => ({
    type: 'hello',
    protocol: 1,
    server: 'test',
    user: {name: 'eve', role: 'observer'},
    may: ['log'],
    why_not,
    run: {
      name: 'r',
      source: 'live',
      clock: 'lock_step',
      started: '',
      step_s: 0.01,
      seed: 1,
      hash: null,
      recording: null,
    },
  });

  it('explains what rights withhold, and repeats other reasons', () => {
    const model = new RunModel();
    model.takeMessage(hello({maps: kNotYours, seek: 'It goes on.'}));
    model.takeMessage({type: 'people', people: [kBoss]});
    expect(model.whyNot('maps')).toBe(withheldText('maps', [kBoss]));
    expect(model.whyNot('seek')).toBe('It goes on.');
    expect(model.whyNot('log')).toBe('');
    expect(model.isWithheld('maps')).toBe(true);
    expect(model.isWithheld('seek')).toBe(false);
    expect(model.whyNot('rights')).toContain('super-users');
  });

  it('knows who may see less than everything', () => {
    const model = new RunModel();
    model.takeMessage(hello({}));
    expect(model.seesLess).toBe(true);
    model.takeMessage({...hello({}), user: kBoss});
    expect(model.seesLess).toBe(false);
  });
});
