// SPDX-License-Identifier: Apache-2.0
// node --test, in this folder
import assert from 'node:assert/strict';
import test from 'node:test';
import {component, fastest} from './@NAME@.mjs';

const model = {
  robots: [{name: 'slow'}, {name: 'fast'}, {name: 'stands'}],
  poses: {newest: {speed: [0.1, -0.4, 0]}},
};

test('the fastest robot comes first, whichever way it goes', () => {
  assert.deepEqual(fastest(model, 2).map(({name}) => name), ['fast', 'slow']);
});

test('there is nothing to sort before the first picture', () => {
  assert.equal(fastest({robots: [{name: 'a'}], poses: {newest: null}})[0].speed, 0);
});

test('the component says for which interface it was made', () => {
  assert.equal(component.api, 1);
  assert.equal(component.panels[0].id, '@NAME@');
});
