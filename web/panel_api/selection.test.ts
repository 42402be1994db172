// SPDX-License-Identifier: Apache-2.0
import {expect, it} from 'vitest';
import {Selection} from './selection';

it('finds its robots again by name in another roster', () => {
  const selection = new Selection();
  selection.adopt(['a', 'b', 'c']);
  selection.set([0, 2]);
  selection.follow(true);
  selection.adopt(['c', 'd', 'a']);
  expect(selection.slots).toEqual([2, 0]);
  expect(selection.following).toBe(true);
  selection.adopt(['d']);
  expect(selection.slots).toEqual([]);
  expect(selection.following).toBe(false);
});
