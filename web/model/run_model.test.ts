// SPDX-License-Identifier: Apache-2.0
import {describe, expect, it} from 'vitest';
import type {Body, Hello, People, Time} from '../protocol/messages';
import {RunModel} from './run_model';

function hello(source: 'live' | 'replay', may: Hello['may']): Hello {
  return {
    type: 'hello',
    protocol: 1,
    server: 'test',
    user: {name: 'a', role: 'commander'},
    may,
    why_not: {seek: 'It goes on.'},
    run: {
      name: 'r',
      source,
      clock: 'lock_step',
      started: '',
      step_s: 0.01,
      seed: 1,
      hash: null,
      recording: null,
    },
  };
}

const kTime: Time = {
  type: 'time',
  now_s: 9,
  step: 900,
  begin_s: 0,
  end_s: 9,
  duration_s: 60,
  state: 'running',
  reason: '',
  pace: 1,
  speed: 1,
};

function body(id: number, x: number): Body {
  return {id, name: `b${id}`, kind: 'virtual', pose: [x, 0, 0], shapes: []};
}

describe('a live run', () => {
  it('cannot be moved in time, with the reason of the server', () => {
    const model = new RunModel();
    model.takeMessage(hello('live', ['stop']));
    expect(model.live).toBe(true);
    expect(model.may('seek')).toBe(false);
    expect(model.whyNot('seek')).toBe('It goes on.');
    expect(model.whyNot('stop')).toBe('');
  });

  it('becomes its recording on the same connection', () => {
    const model = new RunModel();
    model.takeMessage(hello('live', ['stop']));
    model.takeMessage(kTime);
    model.takeMessage({type: 'events', reset: false, first: 0, events: []});
    model.takeMessage({type: 'hosts', hosts: []});
    model.takeMessage(hello('replay', ['seek']));
    expect(model.live).toBe(false);
    expect(model.may('seek')).toBe(true);
    expect(model.time).toBeNull();
    expect(model.events).toEqual([]);
  });
});

it('forgets who is here when the rights change: the server names them to who may talk', () => {
  const model = new RunModel();
  model.takeMessage(hello('live', ['chat']));
  model.takeMessage({
    type: 'people',
    people: [
      {name: 'a', role: 'commander'},
      {name: 'b', role: 'observer'},
    ],
  });
  expect(model.others.map(({name}) => name)).toEqual(['b']);
  model.takeMessage(hello('live', []));
  expect(model.others).toEqual([]);
});

describe('bodies', () => {
  it('come, move and go', () => {
    const model = new RunModel();
    let told = 0;
    model.sceneChanged.on(() => ++told);
    model.takeMessage({type: 'scene', bodies: [body(1, 0), body(2, 0)], hidden: []});
    model.takeMessage({type: 'scene_change', set: [body(2, 5), body(3, 1)], gone: [1]});
    expect([...model.bodies.keys()]).toEqual([2, 3]);
    expect(model.bodies.get(2)?.pose[0]).toBe(5);
    expect(told).toBe(2);
  });
});

it('shows a robot that was handed over as what it is now', () => {
  const model = new RunModel();
  const robot = {
    name: 'r',
    team: '',
    kind: 'simulated' as const,
    word: '',
    recorded: false,
    program: '',
    drivers: [],
    shapes: [],
    sensors: [],
    twin: {kind: 'real' as const, drivers: ['create_drive'], sensors: []},
  };
  model.takeMessage({type: 'roster', robots: [robot]});
  let told = 0;
  model.rosterChanged.on(() => ++told);
  const frame = (flags: number): ArrayBuffer => {
    const view = new DataView(new ArrayBuffer(48 + 14));
    view.setUint8(0, 1);
    view.setUint32(20, 1, true);
    view.setUint16(48 + 12, flags, true);
    return view.buffer;
  };
  model.takeFrame(frame(1), 0);
  expect(model.robots[0]).toMatchObject({kind: 'simulated', mixed: true});
  model.takeFrame(frame(1 | 16), 1);
  expect(model.robots[0]).toMatchObject({kind: 'real', handedOver: true});
  model.takeFrame(frame(1), 2);
  expect(model.robots[0]).toMatchObject({kind: 'simulated', handedOver: false});
  expect(told).toBe(2);
});

it('does not list the person at this page among the others, by whatever name', () => {
  const model = new RunModel();
  const ben = {name: 'ben', role: 'observer'} as const;
  model.takeMessage({...hello('live', []), user: {name: 'you', role: 'super_user'}});
  const here: People = {type: 'people', people: [ben, {name: 'the operator', role: 'super_user'}]};
  model.takeMessage(here);
  expect(model.knownAs).toBe('the operator');
  expect(model.others).toEqual([ben]);
  // Who looks as another person is still who they are.
  model.takeMessage({...hello('live', []), user: ben, seen_by: {name: 'you', role: 'super_user'}});
  model.takeMessage(here);
  expect(model.others).toEqual([ben]);
  model.takeMessage({...hello('live', []), user: ben});
  model.takeMessage(here);
  expect(model.others.map(({name}) => name)).toEqual(['the operator']);
});
