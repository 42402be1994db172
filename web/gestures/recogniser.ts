// SPDX-License-Identifier: Apache-2.0
import {evened, featuresOf, kPoints, type Motion} from './motion';
import {warpedDistance} from './warping';

/** One performance of a gesture: `kPoints` points as `evened()` makes them. */
export interface Template {
  readonly gesture: string;
  readonly points: readonly (readonly number[])[];
}

/** What a motion may mean. `sure`: `first`. `unsure`: `first` or `second`, and the person says
 * which. `none`: refused; `first` is only the nearest. */
export interface Reading {
  readonly verdict: 'sure' | 'unsure' | 'none';
  /** Name of the nearest gesture; empty if there is no template with the axes of the motion. */
  readonly first: string;
  /** Of the next one; empty if there is none. */
  readonly second: string;
  /** Distance of the nearest one as a share of the limit beyond which a motion is refused. */
  readonly share: number;
}

interface Known {
  template: Template;
  gesture: string;
  features: Float64Array;
}

/** Where a motion is between two gestures: the nearest, the next, and how far both are. */
interface Place {
  first: string;
  second: string;
  near: number;
  next: number;
}

/** A motion is as far from a gesture as from its nearest templates on average, this many. */
const kNearest = 2;
/** Keeping one's own gesture weighs more than refusing what is none, which is shown before it is
 * sent: this much more where a gesture has one template. Limits that few templates make are
 * guesses. */
const kKeep = 10;
/** Of the motions that belong to a gesture, this share may be unsure. */
const kUnsure = 0.1;

/** Names motions by the nearest of templates. All its limits come from these templates: each is
 * read as if it were not one of them, once with and once without the others of its gesture. So no
 * number is fitted to one person, and more templates make narrower limits. */
export class Recogniser {
  private readonly known: readonly Known[];
  /** By the number of axes: beyond `refuse` a motion is none of the gestures; above `doubt`, the
   * share of the distances of the nearest and the next gesture, it may be either. */
  private readonly limits = new Map<number, {refuse: number; doubt: number}>();

  /** Templates of strokes and of sensors may be mixed; a motion is compared with those that have
   * as many axes. */
  constructor(templates: readonly Template[]) {
    this.known = templates.map((template) => ({
      template,
      gesture: template.gesture,
      features: featuresOf(template.points),
    }));
    for (const width of new Set(this.known.map(({features}) => features.length / kPoints)))
      this.limits.set(width, limitsOf(this.known.filter((one) => widthOf(one) === width)));
  }

  /** What a motion means; null if it is none at all (see `evened`). `without`: a template that does
   * not count, so that templates can be judged by each other. */
  read(motion: Motion, without?: Template): Reading | null {
    const points = evened(motion);
    if (points === null) return null;
    const features = featuresOf(points);
    const width = features.length / kPoints;
    const alike = this.known.filter((one) => widthOf(one) === width && one.template !== without);
    const limits = this.limits.get(width);
    if (limits === undefined) return {verdict: 'none', first: '', second: '', share: Infinity};
    const {first, second, near, next} = placeOf(
      alike.map(({gesture, features: other}) => ({
        gesture,
        distance: warpedDistance(features, other, kPoints, width),
      })),
    );
    const share = near / limits.refuse;
    const verdict = share > 1 ? 'none' : near > limits.doubt * next ? 'unsure' : 'sure';
    return {verdict, first, second, share};
  }
}

const widthOf = (known: Known): number => known.features.length / kPoints;

function placeOf(all: readonly {gesture: string; distance: number}[]): Place {
  const by = new Map<string, number[]>();
  for (const {gesture, distance} of all) by.set(gesture, [...(by.get(gesture) ?? []), distance]);
  const ranked = [...by].map(([gesture, distances]) => ({gesture, far: meanOfNearest(distances)}));
  ranked.sort((a, b) => a.far - b.far);
  return {
    first: ranked[0]?.gesture ?? '',
    second: ranked[1]?.gesture ?? '',
    near: ranked[0]?.far ?? Infinity,
    next: ranked[1]?.far ?? Infinity,
  };
}

function meanOfNearest(distances: readonly number[]): number {
  const nearest = [...distances].sort((a, b) => a - b).slice(0, kNearest);
  return nearest.reduce((sum, value) => sum + value, 0) / nearest.length;
}

/** Reads every template as a motion of its gesture, and as one that is no gesture. */
function limitsOf(known: readonly Known[]): {refuse: number; doubt: number} {
  const width = widthOf(known[0]);
  const distances = known.map(() => new Float64Array(known.length));
  for (let i = 0; i < known.length; ++i)
    for (let j = 0; j < i; ++j)
      distances[i][j] = distances[j][i] = warpedDistance(
        known[i].features,
        known[j].features,
        kPoints,
        width,
      );
  const own: number[] = [];
  const foreign: number[] = [];
  const shares: number[] = [];
  for (const [i, {gesture}] of known.entries()) {
    const all = known.map((other, j) => ({gesture: other.gesture, distance: distances[i][j]}));
    const mine = all.filter((other, j) => j !== i && other.gesture === gesture);
    const without = placeOf(all.filter((other) => other.gesture !== gesture));
    foreign.push(without.near);
    if (mine.length === 0) continue;
    const near = meanOfNearest(mine.map(({distance}) => distance));
    own.push(near);
    if (near < without.near) shares.push(near / without.near);
  }
  shares.sort((a, b) => a - b);
  const doubt = shares[Math.floor((1 - kUnsure) * (shares.length - 1))] ?? 0.5;
  const each = known.length / new Set(known.map(({gesture}) => gesture)).size;
  return {refuse: between(own, foreign, each), doubt};
}

/**
 * The distance that parts two sets best: most of `own` below it, most of `foreign` above.
 * `each`: templates of a gesture. With no other gesture it is twice the largest of one's own;
 * with single templates half of the way to another gesture.
 */
function between(own: number[], foreign: number[], each: number): number {
  const others = foreign.filter(Number.isFinite);
  if (others.length === 0) return 2 * Math.max(...own, 0.25);
  if (own.length === 0) return 0.5 * Math.min(...others);
  const keep = 1 + kKeep / each;
  let [best, limit] = [-Infinity, 0];
  for (const at of [...own, ...others].sort((a, b) => a - b)) {
    const worth =
      (keep * own.filter((value) => value <= at).length) / own.length -
      others.filter((value) => value <= at).length / others.length;
    if (worth >= best) [best, limit] = [worth, at];
  }
  // Where nothing foreign is as near, the sets leave room: half of the way to it.
  const nearest = Math.min(...others);
  return nearest > limit ? 0.5 * (limit + nearest) : limit;
}
