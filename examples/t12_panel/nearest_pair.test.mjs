// SPDX-License-Identifier: Apache-2.0
// node --test, in this folder
import assert from 'node:assert/strict';
import test from 'node:test';
import {component, nearestPair} from './nearest_pair.mjs';

const robots = [{name: 'a'}, {name: 'b'}, {name: 'c'}];

test('the two nearest robots, and their distance', () => {
  const newest = {x: [0, 3, 3], y: [0, 4, 5.5], flags: [1, 1, 1]};
  assert.deepEqual(nearestPair({robots, poses: {newest}}), {slots: [1, 2], distance_m: 1.5});
});

test('a robot whose pose is unknown has none to be near to', () => {
  const newest = {x: [0, 3, 3], y: [0, 4, 5.5], flags: [1, 1, 0]};
  assert.deepEqual(nearestPair({robots, poses: {newest}}), {slots: [0, 1], distance_m: 5});
});

test('there is no pair before the first frame, and none of one robot', () => {
  assert.equal(nearestPair({robots, poses: {newest: null}}), null);
  assert.equal(nearestPair({robots, poses: {newest: {x: [0, 0, 0], y: [0, 0, 0], flags: [1, 0, 0]}}}), null);
});

test('the component says for which interface it was made', () => {
  assert.equal(component.api, 1);
});
