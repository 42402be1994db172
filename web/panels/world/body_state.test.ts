// SPDX-License-Identifier: Apache-2.0
import {expect, it} from 'vitest';
import {Placed, PoseHistory} from '../../model/pose_history';
import {RobotFlag, type PoseFrame} from '../../protocol/frames';
import {bodyState, reachOf} from './body_state';

const frame = (time_s: number, flags: number, speed: number) =>
  ({
    time_s,
    past: false,
    x: [0],
    y: [0],
    yaw: [0],
    flags: Uint16Array.of(flags),
    speed: [speed],
  }) as unknown as PoseFrame;

it('a stale robot is a ghost whatever it waits for, and only real ones wait to be armed', () => {
  expect(bodyState('real', RobotFlag.known | RobotFlag.unarmed)).toBe('unarmed');
  expect(bodyState('simulated', RobotFlag.known | RobotFlag.unarmed)).toBe('plain');
  expect(bodyState('real', RobotFlag.stale | RobotFlag.unarmed)).toBe('stale');
});

it('what a ghost may have reached grows with its age, at the highest speed it had', () => {
  const history = new PoseHistory();
  const placed = new Placed();
  const reach = (time_s: number, flags: number, speed: number) => {
    history.add(frame(time_s, flags, speed), 1000 * time_s);
    history.interpolate(1000 * time_s + 1000, placed);
    return reachOf(placed, 0);
  };
  expect(reach(1, RobotFlag.known, -0.5)).toBe(0);
  expect(reach(2, RobotFlag.known, 0.25)).toBe(0);
  // What is told of a ghost is no measurement.
  expect(reach(3, RobotFlag.known | RobotFlag.stale, 9)).toBeCloseTo(0.5);
  for (let t = 4; t < 60; ++t) reach(t, RobotFlag.known | RobotFlag.stale, 0);
  expect(reach(60, RobotFlag.known | RobotFlag.stale, 0)).toBeCloseTo(29);
  expect(reach(61, RobotFlag.known, 0)).toBe(0);
});
