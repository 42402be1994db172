// SPDX-License-Identifier: Apache-2.0
import {afterEach, beforeEach, expect, it, vi} from 'vitest';
import type {Commands} from '../../model/commands';
import {Car, carPedals, kIdle, pedalsOf, together} from './car';
import {CarDesk} from './car_desk';
import {DriveLoop} from './drive_loop';
import {DriveKeys} from './keys';
import {readCarPad} from './pad';

beforeEach(() => void vi.useFakeTimers());
afterEach(() => {
  vi.useRealTimers();
  vi.unstubAllGlobals();
});

function car(gear: -1 | 0 | 1): Car {
  const made = new Car();
  made.shift(gear);
  return made;
}

it('throttle is a share of the largest speed, in the direction of the gear', () => {
  const forward = car(1);
  forward.step({steering: 0, throttle: 0.5, brake: 0}, 0.02);
  expect(forward.place).toEqual([0, 0.5]);
  const back = car(-1);
  back.step({steering: 0.5, throttle: 0.5, brake: 0}, 0.02);
  // The wheels to the right lead the tail to the right, so the robot turns left.
  expect(back.place).toEqual([-0.5, -0.5]);
});

it('stands in neutral, whatever is pressed', () => {
  const neutral = car(0);
  const all = {steering: 1, throttle: 1, brake: 0};
  neutral.step(all, 0.02);
  expect(neutral.place).toEqual([0, 0]);
  expect(neutral.held(all)).toBe(false);
});

it('the brake takes speed away as a ramp and goes before the throttle', () => {
  const forward = car(1);
  forward.step({steering: 0, throttle: 1, brake: 0}, 0.02);
  forward.step({steering: 0, throttle: 1, brake: 1}, 0.1);
  expect(forward.place[1]).toBeCloseTo(0.8);
  forward.step({steering: 0, throttle: 0, brake: 0.5}, 0.2);
  expect(forward.place[1]).toBeCloseTo(0.6);
  forward.step({steering: 0, throttle: 0, brake: 1}, 1);
  expect(forward.place[1]).toBe(0);
  // A brake alone moves nothing, so nobody holds the robot by it.
  expect(forward.held({steering: 0, throttle: 0, brake: 1})).toBe(false);
});

it('changes between forward and reverse at rest alone; neutral always', () => {
  const forward = car(1);
  const full = {steering: 0, throttle: 1, brake: 0};
  forward.step(full, 0.02);
  expect(forward.shift(-1, full)).toBe(false);
  expect(forward.refusal).toContain('throttle');
  expect(forward.shift(0, full)).toBe(true);
  forward.step(full, 0.02);
  // Out of neutral with a foot down it would leap.
  expect(forward.shift(1, full)).toBe(false);
  forward.release();
  expect(forward.shift(-1, kIdle)).toBe(true);
  expect(forward.refusal).toBe('');
});

it('let go is at rest, and slack is nothing', () => {
  const forward = car(1);
  forward.step({steering: 1, throttle: 1, brake: 0}, 0.02);
  forward.release();
  expect(forward.place).toEqual([0, 0]);
  expect(forward.held({steering: 0.04, throttle: 0.04, brake: 0.04})).toBe(false);
});

it('keys and fingers come together', () => {
  expect(pedalsOf([-1, 1])).toEqual({steering: -1, throttle: 1, brake: 0});
  expect(pedalsOf([0, -1])).toEqual({steering: 0, throttle: 0, brake: 1});
  expect(together(pedalsOf([-1, 0]), {steering: 0.3, throttle: 0.7, brake: 0})).toEqual({
    steering: -1,
    throttle: 0.7,
    brake: 0,
  });
});

it('full throttle and full steering are both full, and the dead-man sends zero at once', () => {
  const ask = vi.fn((_: {v: number; w: number}) =>
    Promise.resolve({type: 'answer', to: 'drive', good: true, text: ''}),
  );
  const loop = new DriveLoop({ask} as unknown as Commands, () => {});
  loop.choose(3);
  const forward = car(1);
  forward.step({steering: 1, throttle: 1, brake: 0}, 0.02);
  loop.holdBoth('touch', ...forward.place);
  expect(loop.velocity).toEqual([0.4, -1.2]);
  vi.advanceTimersByTime(100);
  loop.release('touch');
  expect(ask.mock.calls.at(-1)?.[0]).toMatchObject({v: 0, w: 0});
  const sent = ask.mock.calls.length;
  vi.advanceTimersByTime(1000);
  expect(ask.mock.calls.length).toBe(sent);
});

function desk(good = true) {
  const ask = vi.fn((_: {v: number; w: number}) =>
    Promise.resolve({type: 'answer', to: 'drive', good, text: good ? '' : 'no'}),
  );
  const loop = new DriveLoop({ask} as unknown as Commands, () => {});
  loop.choose(3);
  const keys = new DriveKeys();
  const made = new CarDesk(loop, keys);
  let now_ms = 0;
  return {
    ask,
    loop,
    keys,
    made,
    last: () => ask.mock.calls.at(-1)?.[0],
    tick: () => made.tick((now_ms += 16)),
  };
}

it('a pedal that is let go lets the robot stand at once', () => {
  const {made, keys, tick, last, loop} = desk();
  made.shiftBy(1);
  made.touch('throttle', 0.5);
  tick();
  expect(last()).toMatchObject({v: 0.2, w: 0});
  keys.press('d');
  tick();
  expect(loop.held).toBe('touch');
  made.touch('throttle', 0);
  keys.lift('d');
  tick();
  expect(last()).toMatchObject({v: 0, w: 0});
  expect(loop.held).toBeNull();
});

it('lost focus means neutral: a pedal that is still pressed moves nothing', () => {
  const {made, tick, ask, loop} = desk();
  made.shiftBy(1);
  made.touch('throttle', 1);
  tick();
  made.letGo();
  loop.release();
  const sent = ask.mock.calls.length;
  made.touch('throttle', 1);
  tick();
  expect(made.car.gear).toBe(0);
  expect(ask.mock.calls.length).toBe(sent);
});

it('a robot that refuses is not asked again before everything is let go', async () => {
  const {made, tick, ask, loop} = desk(false);
  made.shiftBy(1);
  made.touch('throttle', 1);
  tick();
  await vi.advanceTimersByTimeAsync(10);
  expect(loop.held).toBeNull();
  for (let i = 0; i < 50; ++i) tick();
  expect(ask.mock.calls.length).toBe(1);
  expect(loop.refusal).toBe('no');
  made.touch('throttle', 0);
  tick();
  // The host waits for that as well.
  expect(ask.mock.calls.at(-1)?.[0]).toMatchObject({v: 0, w: 0});
  made.touch('throttle', 1);
  tick();
  expect(ask.mock.calls.length).toBe(3);
});

it('triggers are pedals, and shoulder buttons gears', () => {
  const buttons = Array.from({length: 16}, () => ({pressed: false, value: 0}));
  buttons[7] = {pressed: true, value: 0.6};
  buttons[6] = {pressed: true, value: 0.2};
  buttons[4] = {pressed: true, value: 1};
  vi.stubGlobal('navigator', {
    getGamepads: () => [null, {id: 'pad', connected: true, axes: [-0.5, 0.9], buttons}],
  });
  expect(readCarPad()).toEqual({
    name: 'pad',
    steering: -0.5,
    throttle: 0.6,
    brake: 0.2,
    down: true,
    up: false,
  });
  vi.stubGlobal('navigator', {getGamepads: () => [null]});
  expect(readCarPad()).toBeNull();
});

it('a car gets the pedals themselves, its steering positive to the left', () => {
  expect(carPedals(-1, {steering: 0.5, throttle: 0.7, brake: 0.01})).toEqual({
    steering: -0.5,
    throttle: 0.7,
    brake: 0,
    gear: -1,
  });
});
