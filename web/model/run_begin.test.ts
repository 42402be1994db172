// SPDX-License-Identifier: Apache-2.0
import {expect, it} from 'vitest';
import type {Event, Hello, Robot, ServerMessage} from '../protocol/messages';
import {beginOf, logOf} from './run_begin';
import {RunModel} from './run_model';

const event: Event = {
  t: 3,
  until: 3,
  count: 1,
  kind: 'contact',
  level: 'info',
  text: 'they touch',
  slots: [0, 1],
};
const hello = (source: 'live' | 'replay', may: Hello['may'] = ['log']) =>
  ({
    type: 'hello',
    protocol: 1,
    server: 's',
    user: {name: 'Ada', role: 'commander'},
    may,
    why_not: {},
    run: {
      name: 'r',
      source,
      clock: 'lock_step',
      started: '',
      step_s: 0.01,
      seed: 7,
      hash: null,
      recording: null,
    },
  }) as Hello;
const time = (begin_s: number) =>
  ({
    type: 'time',
    now_s: 20,
    step: 0,
    begin_s,
    end_s: 20,
    duration_s: 60,
    state: 'running',
    reason: '',
    pace: 1,
    speed: 1,
  }) as ServerMessage;
const roster = (...kinds: Robot['kind'][]) =>
  ({
    type: 'roster',
    robots: kinds.map((kind, i) => ({name: `r${i}`, kind, sensors: []})),
  }) as unknown as ServerMessage;

function modelOf(...messages: ServerMessage[]): RunModel {
  const model = new RunModel();
  for (const message of messages) model.takeMessage(message);
  return model;
}

it('is the same in a live run that is joined late and in its replay', () => {
  const robots = roster('real', 'real', 'simulated');
  const live = beginOf(modelOf(hello('live'), robots, time(20)));
  expect(live).toEqual(beginOf(modelOf(hello('replay'), robots, time(0))));
  expect(live).toMatchObject({t: 0, text: 'Run begins: 2 real and 1 simulated robots, seed 7'});
});

it('comes once before the events, which keep their numbers', () => {
  const model = modelOf(hello('live'), roster('simulated'), time(1), {
    type: 'events',
    reset: true,
    first: 0,
    events: [event],
  });
  model.takeMessage({type: 'events', reset: false, first: 0, events: [{...event, count: 2}]});
  expect(logOf(model).map(({text, count}) => `${text} ${count}`)).toEqual([
    'Run begins: 1 simulated robot, seed 7 1',
    'they touch 2',
  ]);
  expect(model.events).toHaveLength(1);
});

it('waits for the robots and, in a replay, for the begin; without the log it is not given', () => {
  expect(beginOf(modelOf(hello('live')))).toBeNull();
  expect(beginOf(modelOf(hello('replay'), roster('real')))).toBeNull();
  expect(beginOf(modelOf(hello('live', []), roster('real'), time(0)))).toBeNull();
});

it('does not say that the run begins where its recording does so later', () => {
  expect(beginOf(modelOf(hello('replay'), roster('real'), time(10)))).toMatchObject({
    t: 10,
    text: 'Recording begins: 1 real robot, seed 7',
  });
});

it('counts a robot that was handed over as what it was', () => {
  const model = modelOf(hello('live'), roster('real', 'simulated'));
  Object.assign(model.robots[0], {kind: 'simulated', handedOver: true});
  expect(beginOf(model)?.text).toBe('Run begins: 1 real and 1 simulated robots, seed 7');
});
