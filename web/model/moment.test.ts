// SPDX-License-Identifier: Apache-2.0
import {expect, it} from 'vitest';
import type {RunModel} from './run_model';
import {spanOf} from './moment';

const at = (live: boolean, time: object) =>
  ({live, time, poses: {newest: null}}) as unknown as RunModel;

it('reaches from the begin of a live run, whose events lie before the present', () => {
  expect(spanOf(at(true, {now_s: 80, begin_s: 80, end_s: 80, duration_s: 120}))).toEqual([0, 120]);
  expect(spanOf(at(true, {now_s: 130, begin_s: 130, end_s: 130, duration_s: 120}))).toEqual([
    0, 130,
  ]);
});

it('reaches from the begin of a recording to its known or planned end', () => {
  expect(spanOf(at(false, {now_s: 12, begin_s: 10, end_s: 20, duration_s: 30}))).toEqual([10, 30]);
});
