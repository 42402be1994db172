// SPDX-License-Identifier: Apache-2.0
// Colours of kinds can be told apart, also without red, green or blue receptors, and read.
import {readFileSync} from 'node:fs';
import {join} from 'node:path';
import {expect, it} from 'vitest';
import {Palette} from '../panel_api/palette';

const kTokens = readFileSync(join(process.cwd(), 'app/tokens.css'), 'utf8');
const kKinds = ['kind-1-ink', 'kind-2-ink', 'kind-3-ink'];
/** Machado, Oliveira and Fernandes 2009, severity 1, for linear RGB. */
const kEyes: Record<string, number[][]> = {
  all: [
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
  ],
  protan: [
    [0.152286, 1.052583, -0.204868],
    [0.114503, 0.786281, 0.099216],
    [-0.003882, -0.048116, 1.051998],
  ],
  deutan: [
    [0.367322, 0.860646, -0.227968],
    [0.280085, 0.672501, 0.047413],
    [-0.01182, 0.04294, 0.968881],
  ],
  tritan: [
    [1.255528, -0.076749, -0.178779],
    [-0.078411, 0.930809, 0.147602],
    [0.004733, 0.691367, 0.3039],
  ],
};

/** Linear RGB of a token; `theme` 0: dark, 1: light. */
function linear(token: string, theme: number): number[] {
  const value = [...kTokens.matchAll(new RegExp(`--${token}: *#([0-9a-f]{6});`, 'g'))].map(
    (found) => found[1],
  )[theme];
  return [0, 2, 4]
    .map((at) => parseInt(value.slice(at, at + 2), 16) / 255)
    .map((part) => (part <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4));
}

const times = (rows: number[][], v: number[]) =>
  rows.map((row) => row.reduce((sum, factor, i) => sum + factor * v[i], 0));

/** Oklab, in percent. */
function oklab(rgb: number[]): number[] {
  const cones = times(
    [
      [0.4122214708, 0.5363325363, 0.0514459929],
      [0.2119034982, 0.6806995451, 0.1073969566],
      [0.0883024619, 0.2817188376, 0.6299787005],
    ],
    rgb,
  ).map(Math.cbrt);
  return times(
    [
      [0.2104542553, 0.793617785, -0.0040720468],
      [1.9779984951, -2.428592205, 0.4505937099],
      [0.0259040371, 0.7827717662, -0.808675766],
    ],
    cones,
  ).map((part) => 100 * part);
}

/** The smallest distance that any eye sees between two tokens. */
function apart(a: string, b: string, theme: number): number {
  return Math.min(
    ...Object.values(kEyes).map((eye) => {
      const [p, q] = [a, b].map((token) =>
        oklab(times(eye, linear(token, theme)).map((part) => Math.min(Math.max(part, 0), 1))),
      );
      return Math.hypot(...p.map((part, i) => part - q[i]));
    }),
  );
}

const luminance = (token: string, theme: number) =>
  times([[0.2126, 0.7152, 0.0722]], linear(token, theme))[0];
function contrast(a: string, b: string, theme: number): number {
  const [low, high] = [luminance(a, theme), luminance(b, theme)].sort((p, q) => p - q);
  return (high + 0.05) / (low + 0.05);
}

it.each([
  ['dark', 0],
  ['light', 1],
])('of the %s theme', (_, theme) => {
  kKinds.forEach((kind, i) => {
    for (const other of kKinds.slice(i + 1))
      expect(apart(kind, other, theme), `${kind} ${other}`).toBeGreaterThan(8);
    expect(apart(kind, 'sim-ink', theme), `${kind} sim`).toBeGreaterThan(6);
    for (const ground of ['bg-1', 'bg-2', 'bg-3', 'floor'])
      expect(contrast(kind, ground, theme), `${kind} on ${ground}`).toBeGreaterThan(4.5);
  });
});

it('each kind has one of its own, real robots have theirs', () => {
  const palette = new Palette(document.createElement('div'));
  const robot = (word: string, kind = 'simulated') =>
    ({word, kind}) as Parameters<Palette['assign']>[0][number];
  palette.assign([
    robot('predator'),
    robot('prey'),
    robot(''),
    robot('prey'),
    robot('', 'real'),
    robot('sheep'),
  ]);
  expect([0, 1, 2, 3, 4, 5].map((slot) => palette.hueName(slot))).toEqual([
    'kind-1',
    'kind-2',
    'sim',
    'kind-2',
    'real-1',
    'kind-3',
  ]);
});
