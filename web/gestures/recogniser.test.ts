// SPDX-License-Identifier: Apache-2.0
import {describe, expect, it} from 'vitest';
import {evened, kPoints, type Motion} from './motion';
import {Recogniser, type Template} from './recogniser';

/** A circle of any size, place and first angle. */
const circle = (from: number, size = 1, samples = 60): Motion =>
  Array.from({length: samples}, (_, i) => [
    7 + size * Math.cos(from + (6.28 * i) / samples),
    -3 + size * Math.sin(from + (6.28 * i) / samples),
  ]);
/** A line with one bend upwards at a share of it. */
const tick = (bend: number, size = 1, samples = 60): Motion =>
  Array.from({length: samples}, (_, i) => {
    const at = i / (samples - 1);
    return [size * at, size * (at < bend ? -at : at - 2 * bend)];
  });
const zigzag: Motion = Array.from({length: 80}, (_, i) => [i / 40, Math.abs(((i / 10) % 2) - 1)]);
const line: Motion = Array.from({length: 50}, (_, i) => [0, i]);

const template = (gesture: string, motion: Motion): Template => ({
  gesture,
  points: evened(motion) ?? [],
});
const templates = [
  ...[0, 0.3, 0.6, 0.9].map((from) => template('circle', circle(from))),
  ...[0.25, 0.3, 0.35, 0.4].map((bend) => template('tick', tick(bend))),
];

describe('an evened motion', () => {
  it('has the same points wherever, however large and however often it was sampled', () => {
    const small = evened(circle(0.2, 0.01, 40));
    const large = evened(circle(0.2, 300, 400));
    expect(small?.length).toBe(kPoints);
    for (const [i, point] of (small ?? []).entries())
      for (const [axis, value] of point.entries())
        expect(Math.abs(value - (large?.[i][axis] ?? 9))).toBeLessThan(0.3);
  });

  it('is none for too few samples, mixed axes, no numbers, or a hand that rests', () => {
    expect(evened(circle(0, 1, 7))).toBeNull();
    expect(evened([])).toBeNull();
    expect(evened([...circle(0), [1, 2, 3]])).toBeNull();
    expect(evened([...circle(0), [1, NaN]])).toBeNull();
    expect(evened(Array.from({length: 30}, () => [4, 4]))).toBeNull();
  });
});

describe('the recogniser', () => {
  it('names what was taught, and refuses what was not', () => {
    const recogniser = new Recogniser(templates);
    expect(recogniser.read(circle(0.45, 3))).toMatchObject({verdict: 'sure', first: 'circle'});
    expect(recogniser.read(tick(0.33, 90))).toMatchObject({verdict: 'sure', first: 'tick'});
    expect(recogniser.read(zigzag)?.verdict).toBe('none');
    expect(recogniser.read(line)?.verdict).toBe('none');
  });

  it('compares a motion only with templates of as many axes', () => {
    const recogniser = new Recogniser(templates);
    const shaken: Motion = Array.from({length: 40}, (_, i) => [Math.sin(i), Math.cos(i), i % 3]);
    expect(recogniser.read(shaken)).toMatchObject({verdict: 'none', first: ''});
    expect(new Recogniser([]).read(line)).toMatchObject({verdict: 'none', first: ''});
    expect(recogniser.read([[0, 0]])).toBeNull();
  });

  it('offers two readings of what is between two gestures', () => {
    const blend = (share: number): Motion =>
      circle(2.5).map(([x, y], i) => {
        const [tx, ty] = tick(0.3)[i];
        return [(1 - share) * (x - 7) + share * 2 * tx, (1 - share) * (y + 3) + share * 2 * ty];
      });
    const wide = [
      ...[0, 0.2, 0.4, 0.6].map((share) => template('round', blend(share))),
      ...[0.55, 0.7, 0.85, 1].map((share) => template('bent', blend(share))),
    ];
    const reading = new Recogniser(wide).read(blend(0.575));
    expect(reading?.verdict).toBe('unsure');
    expect([reading?.first, reading?.second].sort()).toEqual(['bent', 'round']);
  });

  it('can be taught with a single template of each', () => {
    const recogniser = new Recogniser([templates[0], templates[4]]);
    expect(recogniser.read(circle(0.1))).toMatchObject({first: 'circle'});
    expect(recogniser.read(circle(0.1))?.verdict).not.toBe('none');
  });
});
