// SPDX-License-Identifier: Apache-2.0
import {describe, expect, it} from 'vitest';
import {kPoints} from './motion';
import {readTemplates, writeTemplates} from './template_file';

const kGestures = ['gather', 'spread', 'stop'];
const points = (axes: number) =>
  Array.from({length: kPoints}, (_, i) =>
    Array.from({length: axes}, (_, axis) => Math.sin(i + axis)),
  );
const good = () =>
  writeTemplates([
    {gesture: 'gather', points: points(2)},
    {gesture: 'stop', points: points(3)},
  ]);
const errorOf = (text: string): string => {
  const file = readTemplates(text, kGestures);
  return 'error' in file ? file.error : '';
};
/** The good file with one part of its text replaced. */
const errorWith = (from: string | RegExp, to: string) => errorOf(good().replace(from, to));

describe('a file of templates', () => {
  it('is read as it was written', () => {
    const file = readTemplates(good(), kGestures);
    expect('templates' in file && file.templates.map(({gesture}) => gesture)).toEqual([
      'gather',
      'stop',
    ]);
    expect(file).toEqual(
      readTemplates(writeTemplates('templates' in file ? file.templates : []), kGestures),
    );
  });

  it('says where it is wrong and what was expected', () => {
    expect(errorOf('{\n  "rave_gestures": x')).toMatch(/^the file is no JSON: .*x/);
    expect(errorOf('[]')).toMatch(/the file: expected an object .* found \[\]/);
    expect(errorWith('"rave_gestures":1', '"rave_gestures":2')).toMatch(/expected 1, found 2/);
    expect(errorWith('"templates"', '"template"')).toMatch(
      /unknown key "template".*did you mean templates/,
    );
    expect(errorWith('"gather"', '"gathr"')).toBe(
      'templates[0].gesture: expected one of gather, spread, stop, ' +
        'found "gathr"; did you mean gather?',
    );
    expect(errorWith(/\[-?[\d.]+,/, '[1e9,')).toMatch(
      /templates\[0\]\.points\[0\]\[0\]: expected a number from -100 to 100, found 1000000000/,
    );
    expect(errorWith(/\[-?[\d.]+,-?[\d.]+\]/, '[0]')).toMatch(/points\[0\]: expected 2 or 3/);
    expect(errorWith(/\],\[-?[\d.]+,/, '],[')).toMatch(/points\[1\]: expected 2 numbers/);
    expect(errorWith(/\[-?[\d.]+,-?[\d.]+\],/, '')).toMatch(/expected 48 points/);
    expect(errorWith(/"points":.*\]\]/, '"points":[]')).toMatch(/expected 48 points/);
    expect(errorOf('x'.repeat(2_000_001))).toMatch(/2000001 characters; expected at most/);
  });
});

describe('the reader of templates', () => {
  it('never throws, and takes nothing that it would not write', () => {
    let state = 12345;
    const next = (below: number) => {
      state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
      return Math.floor((state / 4294967296) * below);
    };
    const bits = ['{', '}', '[', ']', ',', ':', '"', '-', 'e', '9', '0', 'null', '__proto__', ' '];
    let taken = 0;
    for (let round = 0; round < 1000; ++round) {
      let text = good();
      for (let k = next(4); k >= 0; --k) {
        const at = next(text.length);
        text = text.slice(0, at) + bits[next(bits.length)] + text.slice(at + next(3));
      }
      const file = readTemplates(text, kGestures);
      if ('error' in file) {
        expect(file.error.length).toBeGreaterThan(10);
        expect(file.error.length).toBeLessThan(300);
        continue;
      }
      ++taken;
      for (const {gesture, points: kept} of file.templates) {
        expect(kGestures).toContain(gesture);
        expect(kept.length).toBe(kPoints);
        expect(kept.flat().every((value) => Math.abs(value) <= 100)).toBe(true);
      }
    }
    expect(taken).toBeGreaterThan(15);
  });
});
