// SPDX-License-Identifier: Apache-2.0
import {expect, it} from 'vitest';
import {RunModel} from '../../model/run_model';
import {kCommandsOf, type PoseFrame} from '../../protocol/frames';
import {guardOf} from './guard_act';
import {toldLines, toldOf} from './told';

function at(time_s: number, ...told: [number, number[]][]): RunModel {
  const model = new RunModel();
  for (const [stamp_s, values] of told)
    model.readings.add({
      slot: 0,
      sensor: kCommandsOf,
      part: 0,
      past: false,
      stamp_s,
      time_s: stamp_s,
      rows: 1,
      fields: 4,
      values: Float32Array.from(values),
    });
  model.poses.newest = {
    time_s,
    speed: Float32Array.of(0.1),
    flags: Uint16Array.of(1),
  } as unknown as PoseFrame;
  return model;
}

it('knows what a robot is told, and not when that is old', () => {
  const told = toldOf(at(10, [9.9, [0.5, 0, 0.25, 0]]), 0);
  expect(told).toEqual({asked: [0.5, 0], given: [0.25, 0]});
  expect(toldOf(at(12, [9.9, [0.5, 0, 0.25, 0]]), 0)).toBeNull();
  expect(toldOf(at(10, [9.9, [NaN, NaN, 0, 0]]), 0)).toBeNull();
});

it('shows the limit of what lets less through than was asked', () => {
  expect(guardOf(at(10, [9.9, [0.5, 0, 0.25, 0]]), 0, null)).toMatchObject({limit_mps: 0.25});
  expect(guardOf(at(10, [9.9, [0.5, 0, 0.5, 0]]), 0, null)).toBeNull();
});

it('draws what was asked by whomever, with gaps where nothing was told', () => {
  const model = at(
    10,
    [1, [0.5, 0.1, 0.5, 0.1]],
    [1.2, [0.4, 0, 0.4, 0]],
    [5, [0, 0, 0, 0]],
    [5.1, [NaN, NaN, 0, 0]],
    [5.2, [0.25, 0, 0.25, 0]],
  );
  const lines = toldLines(model, 0, 'v', 0).map((line) =>
    line.map(([t, v]) => [t, Number(v.toFixed(2))]),
  );
  expect(lines).toEqual([
    [
      [1, 0.5],
      [1.2, 0.4],
    ],
    [[5, 0]],
    [[5.2, 0.25]],
  ]);
});
