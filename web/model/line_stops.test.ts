// SPDX-License-Identifier: Apache-2.0
import {expect, it} from 'vitest';
import {RobotFlag} from '../protocol/frames';
import type {Robot, ServerMessage} from '../protocol/messages';
import type {DirectLines} from './direct_lines';
import {LineStops} from './line_stops';
import {RunModel} from './run_model';
import {countStopped, lastStop} from './stop_state';

function robot(name: string, more: Partial<Robot> = {}): Robot {
  return {
    name,
    team: '',
    kind: 'real',
    word: '',
    recorded: false,
    program: '',
    drivers: [],
    shapes: [],
    sensors: [],
    ...more,
  };
}

function picture(model: RunModel, flags: number[]): void {
  const zeros = new Float64Array(flags.length);
  const still = new Float32Array(flags.length);
  model.poses.add(
    {
      sequence: 1,
      past: false,
      truth: false,
      time_s: model.poses.past.length,
      step: 0,
      x: zeros,
      y: zeros,
      yaw: still,
      speed: still,
      flags: Uint16Array.from(flags),
    },
    0,
  );
}

/** What the hosts say is `said`; of robots that are not in it they say nothing. */
function made(robots: Robot[], flags: number[], said: Record<string, boolean>) {
  const model = new RunModel();
  model.takeMessage({
    type: 'hello',
    may: ['stop'],
    run: {source: 'live'},
    user: {name: 'ada', role: 'commander'},
    why_not: {},
  } as unknown as ServerMessage);
  model.takeMessage({type: 'roster', robots});
  picture(model, flags);
  const lines = {stands: (name: string) => said[name] ?? null} as unknown as DirectLines;
  return {model, stops: new LineStops(model, lines)};
}

it('who stands by word of a host is stopped in the last picture and goes again by its word', () => {
  const said: Record<string, boolean> = {a: true, b: false};
  const {model, stops} = made([robot('a'), robot('b'), robot('no line')], [1, 1, 1], said);
  let drawn = 0;
  model.pictureChanged.on(() => ++drawn);
  stops.take();
  expect(countStopped(model).stopped).toEqual([0]);
  stops.take();
  expect(drawn).toBe(1);
  said['a'] = false;
  stops.take();
  expect(countStopped(model).stopped).toEqual([]);
  expect(drawn).toBe(2);
});

it('a robot that a host says nothing of stays as the picture had it', () => {
  const others = robot('of others', {stoppable: false});
  const {model, stops} = made(
    [robot('a'), others],
    [1 | RobotFlag.stopped, 1 | RobotFlag.stopped],
    {'of others': false},
  );
  stops.take();
  expect([...model.poses.newest!.flags]).toEqual([1 | RobotFlag.stopped, 1 | RobotFlag.stopped]);
});

it('an earlier stop in the log is none of this one, until the server has a picture again', () => {
  const {model, stops} = made([robot('a')], [1], {a: true});
  const event = {
    t: 3,
    until: 3,
    count: 1,
    kind: 'stopped',
    level: 'warn',
    text: 'a: stopped, by hand: ben',
    slots: [0],
  };
  model.takeMessage({type: 'events', first: 0, events: [event]} as unknown as ServerMessage);
  stops.take();
  const unlogged = (slot: number) => stops.has(slot);
  expect(stops.has(0)).toBe(true);
  expect(lastStop(model, unlogged)).toBeNull();
  picture(model, [1 | RobotFlag.stopped]);
  expect(stops.has(0)).toBe(false);
  expect(lastStop(model, unlogged)).toEqual({t_s: 3, who: 'ben'});
});
