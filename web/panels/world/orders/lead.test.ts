// SPDX-License-Identifier: Apache-2.0
import {expect, it} from 'vitest';
import {kLead_s, leadOf} from './lead';

it('a straight line ahead, a quarter of a circle to the left, and on the spot', () => {
  const end = (v: number, w: number) => leadOf(1, 2, Math.PI / 2, v, w).at(-1)!;
  expect(end(0.5, 0)).toEqual([expect.closeTo(1), expect.closeTo(2 + 0.5 * kLead_s)]);
  const w = Math.PI / 2 / kLead_s;
  expect(end(0.5, w)).toEqual([expect.closeTo(1 - 0.5 / w), expect.closeTo(2 + 0.5 / w)]);
  expect(end(0, 1)).toEqual([expect.closeTo(1), expect.closeTo(2)]);
});
