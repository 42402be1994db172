// SPDX-License-Identifier: Apache-2.0
import {expect, it, vi} from 'vitest';
import {bindKeys, panelKey} from './keys';

it('gives more than nine panels a key', () => {
  expect([0, 8, 9, 10, 12].map(panelKey)).toEqual([['1'], ['9'], ['0'], ['Shift 1'], ['Shift 3']]);
  expect(panelKey(19)).toEqual([]);
});

it('knows a digit with Shift by its place, unless what it writes is a key of its own', () => {
  const [eleventh, find] = [vi.fn(), vi.fn()];
  bindKeys(() => [
    {keys: ['/'], what: 'find', act: find},
    {keys: ['Shift 1'], what: 'panel', act: eleventh},
    {keys: ['Shift 7'], what: 'panel', act: eleventh},
  ]);
  const press = (key: string, code: string) =>
    document.body.dispatchEvent(
      new KeyboardEvent('keydown', {key, code, shiftKey: true, bubbles: true, composed: true}),
    );
  press('!', 'Digit1');
  expect(eleventh).toHaveBeenCalledTimes(1);
  press('/', 'Digit7');
  expect(find).toHaveBeenCalledTimes(1);
  expect(eleventh).toHaveBeenCalledTimes(1);
});
