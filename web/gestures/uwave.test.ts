// SPDX-License-Identifier: Apache-2.0
// Real hand motions: the uWave gesture library (J. Liu et al., Pervasive and Mobile Computing,
// 2009), rows of a class and 315 triples of accelerations. The data do not ship: these tests are
// skipped where no folder above this one has shared/data/uwave.
import {existsSync, readFileSync} from 'node:fs';
import {dirname, join} from 'node:path';
import {gunzipSync} from 'node:zlib';
import {describe, expect, it} from 'vitest';
import {evened, type Motion} from './motion';
import {Recogniser, type Reading, type Template} from './recogniser';

const kFile = 'shared/data/uwave/uwave-half.csv.gz';

function found(): string | null {
  for (let folder = process.cwd(); ; folder = dirname(folder)) {
    if (existsSync(join(folder, kFile))) return join(folder, kFile);
    if (folder === dirname(folder)) return null;
  }
}

const file = found();
if (file === null) console.warn(`The tests with real motions are skipped: there is no ${kFile}.`);

interface Row {
  gesture: string;
  motion: Motion;
}

function rows(path: string): Row[] {
  return gunzipSync(readFileSync(path))
    .toString()
    .trim()
    .split('\n')
    .map((line) => line.split(',').map(Number))
    .map(([gesture, ...v]) => ({
      gesture: String(gesture),
      motion: Array.from({length: v.length / 3}, (_, i) => v.slice(3 * i, 3 * i + 3)),
    }));
}

const templateOf = ({gesture, motion}: Row): Template => ({gesture, points: evened(motion) ?? []});

/** mulberry32: the same draws on every machine. */
function random(seed: number): () => number {
  return () => {
    seed = (seed + 0x6d2b79f5) | 0;
    let t = Math.imul(seed ^ (seed >>> 15), 1 | seed);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
}

/** `count` rows of each gesture for templates, and the others. */
function draw(all: readonly Row[], count: number, next: () => number): [Row[], Row[]] {
  const mixed = all.map((row) => ({row, key: next()})).sort((a, b) => a.key - b.key);
  const taken = new Map<string, number>();
  const [templates, rest]: [Row[], Row[]] = [[], []];
  for (const {row} of mixed) {
    const had = taken.get(row.gesture) ?? 0;
    taken.set(row.gesture, had + 1);
    (had < count ? templates : rest).push(row);
  }
  return [templates, rest];
}

/** Reads motions one after the other; the runner of the tests wants to be heard in between. */
async function readAll(
  motions: readonly Motion[],
  read: (motion: Motion, i: number) => Reading | null,
): Promise<(Reading | null)[]> {
  const readings = [];
  for (const [i, motion] of motions.entries()) {
    readings.push(read(motion, i));
    if (i % 20 === 0) await new Promise((done) => setTimeout(done, 0));
  }
  return readings;
}

/** Shares of the motions that were named rightly, and that were named rightly and not refused. */
async function judged(
  recogniser: Recogniser,
  rest: readonly Row[],
): Promise<{right: number; kept: number}> {
  const readings = await readAll(
    rest.map(({motion}) => motion),
    (motion) => recogniser.read(motion),
  );
  const right = readings.filter((reading, i) => reading?.first === rest[i].gesture);
  const kept = right.filter((reading) => reading?.verdict !== 'none');
  return {right: right.length / rest.length, kept: kept.length / rest.length};
}

/** Share of the motions of a gesture that nobody taught that are refused. */
async function refusedOf(all: readonly Row[], count: number, seed: number): Promise<number> {
  const [templates] = draw(all, count, random(seed));
  let refused = 0;
  for (const out of new Set(all.map(({gesture}) => gesture))) {
    const taught = templates.filter(({gesture}) => gesture !== out);
    const recogniser = new Recogniser(taught.map(templateOf));
    const strange = all.filter(({gesture}) => gesture === out).map(({motion}) => motion);
    const readings = await readAll(strange, (motion) => recogniser.read(motion));
    refused += readings.filter((reading) => reading?.verdict === 'none').length;
  }
  return refused / all.length;
}

const mean = (values: readonly number[]): number =>
  values.reduce((sum, value) => sum + value, 0) / values.length;

describe.skipIf(file === null)('motions of the uWave gesture library', () => {
  const all = file === null ? [] : rows(file);

  it('with five templates a gesture, nine of ten are named rightly', async () => {
    const draws = [];
    for (const seed of [1, 2, 3, 4]) {
      const [templates, rest] = draw(all, 5, random(seed));
      draws.push(await judged(new Recogniser(templates.map(templateOf)), rest));
    }
    const right = mean(draws.map((one) => one.right));
    console.info('five templates:', right, 'not refused:', mean(draws.map(({kept}) => kept)));
    expect(right).toBeGreaterThanOrEqual(0.9);
  }, 300_000);

  it('with all others as templates, 96 % are', async () => {
    const templates = all.map(templateOf);
    const recogniser = new Recogniser(templates);
    const readings = await readAll(
      all.map(({motion}) => motion),
      (motion, i) => recogniser.read(motion, templates[i]),
    );
    const right = readings.filter((reading, i) => reading?.first === all[i].gesture);
    const kept = right.filter((reading) => reading?.verdict !== 'none');
    console.info('leave one out:', right.length / all.length, kept.length / all.length);
    expect(right.length / all.length).toBeGreaterThanOrEqual(0.96);
  }, 300_000);

  it('a motion that is none of them is refused', async () => {
    const ten = await refusedOf(all, 10, 1);
    const twenty = await refusedOf(all, 20, 1);
    console.info('refused with ten templates:', ten, 'with twenty:', twenty);
    expect(ten).toBeGreaterThan(0.5);
    expect(twenty).toBeGreaterThanOrEqual(6 / 7);
  }, 300_000);
});
