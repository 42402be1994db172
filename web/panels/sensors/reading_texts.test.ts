// SPDX-License-Identifier: Apache-2.0
import {expect, it} from 'vitest';
import {numberText} from './reading_texts';

it('measured numbers keep their digits, counts and values of a driver have those they need', () => {
  const field = {name: 'x_m', label: 'x', unit: 'm', format: 'float64'} as const;
  expect([1, 0.25, -2, NaN, Infinity].map((value) => numberText(field, value))).toEqual([
    '1.000',
    '0.250',
    '−2.000',
    '–',
    'no return',
  ]);
  expect(numberText({...field, unit: '', format: 'int32'}, 23)).toBe('23');
  expect([97, 0.5].map((value) => numberText({...field, unit: ''}, value))).toEqual([
    '97',
    '0.500',
  ]);
});
