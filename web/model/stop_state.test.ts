// SPDX-License-Identifier: Apache-2.0
import {describe, expect, it} from 'vitest';
import {RobotFlag} from '../protocol/frames';
import type {Robot} from '../protocol/messages';
import {RunModel} from './run_model';
import {countStopped, Hold, lastStop, Twice} from './stop_state';

function robot(name: string, recorded = false): Robot {
  return {
    name,
    team: '',
    kind: 'real',
    word: '',
    recorded,
    program: '',
    drivers: [],
    shapes: [],
    sensors: [],
  };
}

function modelWith(robots: Robot[], flags: number[]): RunModel {
  const model = new RunModel();
  model.takeMessage({type: 'roster', robots});
  const zeros = new Float64Array(robots.length);
  model.poses.add(
    {
      sequence: 1,
      past: false,
      truth: false,
      time_s: 0,
      step: 0,
      x: zeros,
      y: zeros,
      yaw: new Float32Array(robots.length),
      speed: new Float32Array(robots.length),
      flags: Uint16Array.from(flags),
    },
    0,
  );
  return model;
}

describe('stopped robots', () => {
  it('are counted, and all of them turn STOP into release', () => {
    const two = [robot('a'), robot('b')];
    expect(countStopped(modelWith(two, [1, 1]))).toEqual({
      robots: [0, 1],
      stopped: [],
      latched: false,
    });
    expect(countStopped(modelWith(two, [1, 1 | RobotFlag.stopped]))).toEqual({
      robots: [0, 1],
      stopped: [1],
      latched: false,
    });
    const both = countStopped(modelWith(two, [RobotFlag.stopped, 1 | RobotFlag.stopped]));
    expect(both).toEqual({robots: [0, 1], stopped: [0, 1], latched: true});
  });

  it('are those that this person may stop and that can be reached', () => {
    const three = [robot('a'), {...robot('of others'), stoppable: false as const}, robot('c')];
    expect(countStopped(modelWith(three, [1, 1, 1]))).toEqual({
      robots: [0, 2],
      stopped: [],
      latched: false,
    });
    const stands = modelWith(three, [1 | RobotFlag.stopped, 1, 1]);
    expect(countStopped(stands, (slot) => slot !== 2)).toEqual({
      robots: [0],
      stopped: [0],
      latched: true,
    });
  });

  it('do not wait for recorded ones', () => {
    const mixed = [robot('a'), robot('tape', true)];
    expect(countStopped(modelWith(mixed, [1 | RobotFlag.stopped, 1])).latched).toBe(true);
    expect(countStopped(modelWith(mixed, [1, 1])).latched).toBe(false);
  });

  it('are none where no robot is', () => {
    expect(countStopped(new RunModel()).latched).toBe(false);
  });
});

describe('the last stop', () => {
  it('was by somebody, whoever it was', () => {
    const model = modelWith([robot('a'), robot('b')], [1 | RobotFlag.stopped, 1]);
    expect(lastStop(model)).toBeNull();
    const stop = (t: number, slot: number, text: string) => ({
      t,
      until: t,
      count: 1,
      kind: 'stopped',
      level: 'warn' as const,
      text,
      slots: [slot],
    });
    const released = stop(9, 1, 'b: stopped, by hand: carla');
    model.takeMessage({
      type: 'events',
      first: 0,
      events: [
        stop(3, 0, 'a: stopped, by hand: ada'),
        stop(7, 0, 'a: stopped, by hand: Ben K'),
        released,
      ],
    } as never);
    // Of a robot that goes again nobody asks.
    expect(lastStop(model)).toEqual({t_s: 7, who: 'Ben K'});
    model.takeMessage({type: 'events', first: 3, events: [stop(12, 0, 'a: stopped')]} as never);
    expect(lastStop(model)).toEqual({t_s: 12, who: ''});
  });
});

describe('hold to release', () => {
  it('counts after 0.6 s and starts anew after a lift', () => {
    const hold = new Hold();
    hold.press(100);
    hold.press(500);
    expect(hold.share(400)).toBeCloseTo(0.5);
    expect(hold.share(700)).toBe(1);
    hold.lift();
    expect(hold.share(800)).toBe(0);
  });
});

describe('two presses', () => {
  it('are a pair only if they are near to each other', () => {
    const twice = new Twice();
    expect(twice.press(0)).toBe(false);
    expect(twice.press(700)).toBe(false);
    expect(twice.press(900)).toBe(true);
    expect(twice.press(1000)).toBe(false);
  });
});
