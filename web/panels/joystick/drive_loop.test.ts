// SPDX-License-Identifier: Apache-2.0
import {afterEach, beforeEach, expect, it, vi} from 'vitest';
import type {Commands} from '../../model/commands';
import {DriveLoop} from './drive_loop';

beforeEach(() => void vi.useFakeTimers());
afterEach(() => void vi.useRealTimers());

function made(good = true) {
  const ask = vi.fn((_: {v: number; w: number; slots: number[]}) =>
    Promise.resolve({type: 'answer', to: 'drive', good, text: good ? '' : '`ben` drives r1'}),
  );
  const loop = new DriveLoop({ask} as unknown as Commands, () => {});
  loop.choose(3);
  return {ask, loop, last: () => ask.mock.calls.at(-1)?.[0]};
}

it('sends at 30 Hz while it is held, and zero at once when it is let go', () => {
  const {ask, loop, last} = made();
  loop.hold('touch', 0, 1);
  expect(last()).toMatchObject({v: 0.4, w: 0, slots: [3]});
  vi.advanceTimersByTime(1000);
  expect(ask.mock.calls.length).toBeGreaterThanOrEqual(30);
  loop.release();
  const sent = ask.mock.calls.length;
  expect(last()).toMatchObject({v: 0, w: 0});
  vi.advanceTimersByTime(1000);
  expect(ask.mock.calls.length).toBe(sent);
});

it('turns left for a stick that is moved to the left, and is no faster in a corner', () => {
  const {loop} = made();
  loop.hold('pad', -1, 1);
  const [v, w] = loop.velocity;
  expect(v).toBeCloseTo(0.4 / Math.SQRT2);
  expect(w).toBeCloseTo(1.2 / Math.SQRT2);
});

it('has one hand: a second source neither moves nor lets go', () => {
  const {loop} = made();
  loop.hold('touch', 0, 1);
  loop.hold('keys', 1, 0);
  loop.release('keys');
  expect(loop.velocity[0]).toBeCloseTo(0.4);
  expect(loop.held).toBe('touch');
});

it('lets a robot stand before it drives another one', () => {
  const {loop, last} = made();
  loop.hold('touch', 0, 1);
  loop.choose(4);
  expect(last()).toMatchObject({v: 0, slots: [3]});
  expect(loop.held).toBeNull();
});

it('stops asking a robot that refuses, and says why', async () => {
  const {ask, loop} = made(false);
  loop.hold('touch', 0, 1);
  await vi.advanceTimersByTimeAsync(500);
  expect(ask.mock.calls.length).toBeLessThan(5);
  expect(loop.refusal).toBe('`ben` drives r1');
});

it('asks a robot that refuses once per grip, however often a held gamepad is read', async () => {
  const {ask, loop} = made(false);
  for (let i = 0; i < 60; ++i) {
    loop.hold('pad', 0, 1);
    await vi.advanceTimersByTimeAsync(16);
  }
  expect(ask.mock.calls.length).toBe(1);
  expect(loop.refusal).toBe('`ben` drives r1');
  loop.release('pad');
  // The host of the robot waits for a neutral stick as well.
  expect(ask.mock.calls.map(([order]) => order.v)).toEqual([0.4, 0]);
  loop.hold('pad', 0, 1);
  expect(ask.mock.calls.length).toBe(3);
  await vi.advanceTimersByTimeAsync(16);
  // Another hand was not refused yet.
  loop.hold('keys', 0, 1);
  expect(ask.mock.calls.length).toBe(4);
});

it('drives no robot on with a gamepad that is still held when the page has let go', () => {
  const {ask, loop, last} = made();
  loop.hold('pad', 0, 1);
  loop.release();
  expect(last()).toMatchObject({v: 0});
  const sent = ask.mock.calls.length;
  loop.hold('pad', 0, 1);
  loop.choose(4);
  loop.hold('pad', 0, 1);
  vi.advanceTimersByTime(500);
  expect(ask.mock.calls.length).toBe(sent);
  loop.release('pad');
  loop.hold('pad', 0, 1);
  expect(last()).toMatchObject({v: 0.4, slots: [4]});
});

it('says at once that the stick has moved, at most 60 times a second', () => {
  const {ask, loop, last} = made();
  loop.hold('touch', 0, 1);
  vi.advanceTimersByTime(20);
  loop.hold('touch', 0, 0.5);
  expect(last()).toMatchObject({v: 0.2});
  const sent = ask.mock.calls.length;
  for (let i = 0; i < 100; ++i) {
    loop.hold('touch', 0, i / 100);
    vi.advanceTimersByTime(1);
  }
  expect(ask.mock.calls.length - sent).toBeLessThanOrEqual(7);
  expect(ask.mock.calls.length - sent).toBeGreaterThanOrEqual(5);
  loop.hold('touch', 0, 0.25);
  loop.release();
  const let_go = ask.mock.calls.length;
  vi.advanceTimersByTime(1000);
  expect(ask.mock.calls.length).toBe(let_go);
  expect(last()).toMatchObject({v: 0, w: 0});
});

it('moves sideways instead of turning, as wide as the drive', () => {
  const {loop, last} = made();
  loop.slides = true;
  loop.hold('touch', -1, 0);
  expect(last()).toMatchObject({v: 0, w: 0, vy: 0.4});
  loop.release();
  expect(last()).toMatchObject({v: 0, w: 0, vy: 0});
});

it('sends pedals beside the velocity, also when only the brake changes', () => {
  const {loop, last} = made();
  loop.holdBoth('touch', 0, 0.5, {steering: 0, throttle: 0.5, brake: 0, gear: 1});
  expect(last()).toMatchObject({v: 0.2, w: 0, throttle: 0.5, gear: 1});
  vi.advanceTimersByTime(20);
  loop.holdBoth('touch', 0, 0.5, {steering: 0, throttle: 0.5, brake: 1, gear: 1});
  vi.advanceTimersByTime(20);
  expect(last()).toMatchObject({brake: 1});
  loop.release();
  expect(last()).not.toHaveProperty('throttle');
});
