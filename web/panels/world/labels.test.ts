// SPDX-License-Identifier: Apache-2.0
import {expect, it} from 'vitest';
import {LabelPlacer, type Label} from './labels';

const label = (text: string, more: Partial<Label> = {}): Label => ({
  text,
  x: 50,
  y: 50,
  gap: 4,
  colour: '',
  weight: 400,
  rank: 5,
  ...more,
});

/** The names that are written where nothing is free. */
function written(...labels: Label[]): string[] {
  const texts: string[] = [];
  const ctx = {
    strokeText() {},
    fillText: (text: string) => texts.push(text),
    measureText: () => ({width: 40}),
  };
  const placer = new LabelPlacer(100, 100);
  placer.block(50, 50, 100);
  placer.draw(ctx as unknown as CanvasRenderingContext2D, labels, '');
  return texts;
}

it('a name that finds no place is left out, unless the person points at its robot', () => {
  expect(written(label('one'), label('other'))).toEqual([]);
  expect(written(label('one'), label('other', {always: true}))).toEqual(['other']);
});
