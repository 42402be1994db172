// SPDX-License-Identifier: Apache-2.0
import {expect, it} from 'vitest';
import {RunModel} from '../../model/run_model';
import type {Robot} from '../../protocol/messages';
import {saidIn} from './said';

it('puts people, robots and leases into one order', () => {
  const model = new RunModel();
  model.robots = [{name: 'walker-5'} as Robot];
  const event = (t: number, kind: string, text: string) => ({
    t,
    until: t,
    count: 1,
    kind,
    level: 'info' as const,
    text,
    slots: [0],
  });
  model.takeMessage({
    type: 'events',
    reset: true,
    first: 0,
    events: [
      event(3, 'said', 'walker-5: said, going to 1, 2'),
      event(1, 'lease', 'walker-5: lease, anna'),
      event(2, 'contact', 'walker-5 and a wall touch'),
    ],
  });
  model.takeMessage({
    type: 'chat',
    reset: true,
    lines: [
      {
        number: 1,
        t: 2,
        from: {name: 'ada', role: 'commander'},
        yours: false,
        to: 'team',
        name: 'green',
        text: 'Go',
      },
    ],
  });
  expect(saidIn(model).map(({kind, name, to, text}) => [kind, name, to, text])).toEqual([
    ['note', 'walker-5', '', 'walker-5: anna'],
    ['person', 'ada', 'team green', 'Go'],
    ['robot', 'walker-5', '', 'going to 1, 2'],
  ]);
});
