// SPDX-License-Identifier: Apache-2.0
import {readFileSync} from 'node:fs';
import {join} from 'node:path';
import {expect, it} from 'vitest';
import {namesText, personHue} from './words';

const kTokens = readFileSync(join(process.cwd(), 'app/tokens.css'), 'utf8');

/** Red, green and blue of a token of both themes, 0 to 1. */
function rgb(token: string): number[] {
  const value = new RegExp(`--${token}: #([0-9a-f]{6});`).exec(kTokens)?.[1] ?? '';
  return [0, 2, 4].map((at) => parseInt(value.slice(at, at + 2), 16) / 255);
}

/** Contrast of white on it, WCAG 2.1. */
function contrast(colour: number[]): number {
  const [r, g, b] = colour.map((part) =>
    part <= 0.03928 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4,
  );
  return 1.05 / (0.2126 * r + 0.7152 * g + 0.0722 * b + 0.05);
}

it('people have hues of their own by their names alone, and all hues are used', () => {
  expect(personHue('olga')).toBe(personHue('olga'));
  const names = Array.from({length: 80}, (_, i) => `person-${i}`);
  expect([...new Set(names.map(personHue))].sort()).toEqual([
    'person-1',
    'person-2',
    'person-3',
    'person-4',
    'person-5',
    'person-6',
    'person-7',
    'person-8',
  ]);
  expect(new Set(['olga', 'paul', 'quinn'].map(personHue)).size).toBe(3);
});

it('white initials are legible on each, and none is the red of faults or the violet of you', () => {
  for (let i = 1; i <= 8; ++i) {
    const [r, g, b] = rgb(`person-${i}`);
    expect(contrast([r, g, b])).toBeGreaterThan(4.5);
    // Red leads alone, or blue leads with red before green.
    expect(r > 2 * Math.max(g, b)).toBe(false);
    expect(b > r && r > g + 0.1).toBe(false);
  }
});

it('few names are said, of many the first ones', () => {
  expect([[], ['a'], ['a', 'b'], ['a', 'b', 'c', 'd']].map((names) => namesText(names))).toEqual([
    '',
    'a',
    'a and b',
    'a, b, c and d',
  ]);
  expect(namesText(['a', 'b', 'c', 'd', 'e'])).toBe('a, b, c and 2 others');
});
