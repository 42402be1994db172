// SPDX-License-Identifier: Apache-2.0

/** Points of a motion in their order, one number for each axis: a stroke has two (any unit of
 * length), an accelerometer three (m/s²). Sampled at equal times, or nearly. */
export type Motion = readonly (readonly number[])[];

/** Points of a motion that can be compared. */
export const kPoints = 48;
/** A motion of fewer samples is a slip of the hand. */
export const kFewestSamples = 8;
/** How much of the place of a point is by the way that the motion has made, the rest by time: half
 * a gesture is then near the middle, also for a hand that waits before it moves. */
const kByWay = 0.35;
/** Share of the changes from point to point, beside the points themselves. */
const kChanges = 1.2;

/** A motion as `kPoints` points about 0, of the mean square 1 over all axes together; rotation and
 * direction count. null: fewer than `kFewestSamples` samples, axes that change, numbers that are
 * not finite, or nothing moves. */
export function evened(motion: Motion): number[][] | null {
  const axes = motion[0]?.length ?? 0;
  if (motion.length < kFewestSamples || axes === 0) return null;
  if (motion.some((point) => point.length !== axes || !point.every(Number.isFinite))) return null;
  const scaled = normalised(motion);
  return scaled === null ? null : normalised(resampled(scaled));
}

/** What is compared of an evened motion: per point its coordinates, then its change, one point
 * after the other. The changes are scaled as the points are; they tell apart what differs in its
 * bends only. E. Keogh, M. Pazzani: "Derivative Dynamic Time Warping", SDM 2001. */
export function featuresOf(points: readonly (readonly number[])[]): Float64Array {
  const last = points.length - 1;
  const changes = points.map((point, i) => {
    const before = points[Math.max(0, i - 1)];
    const after = points[Math.min(last, i + 1)];
    return point.map((_, axis) => after[axis] - before[axis]);
  });
  const scaled = normalised(changes) ?? changes;
  return Float64Array.from(
    points.flatMap((point, i) => [...point, ...scaled[i].map((value) => kChanges * value)]),
  );
}

function normalised(points: Motion): number[][] | null {
  const axes = points[0].length;
  const mean = Array.from(
    {length: axes},
    (_, axis) => points.reduce((sum, point) => sum + point[axis], 0) / points.length,
  );
  const centred = points.map((point) => point.map((value, axis) => value - mean[axis]));
  const square =
    centred.reduce((sum, point) => sum + point.reduce((s, v) => s + v * v, 0), 0) /
    (points.length * axes);
  if (!(square > 0) || !Number.isFinite(square)) return null;
  const scale = 1 / Math.sqrt(square);
  return centred.map((point) => point.map((value) => value * scale));
}

function resampled(motion: Motion): number[][] {
  const last = motion.length - 1;
  const way = [0];
  for (let i = 1; i <= last; ++i) way.push(way[i - 1] + stepOf(motion[i - 1], motion[i]));
  const at = way.map((w, i) => (kByWay * w) / way[last] + ((1 - kByWay) * i) / last);
  const points: number[][] = [];
  for (let k = 0, i = 0; k < kPoints; ++k) {
    const wanted = k / (kPoints - 1);
    while (i < last - 1 && at[i + 1] < wanted) ++i;
    const share = Math.min(1, Math.max(0, (wanted - at[i]) / (at[i + 1] - at[i])));
    points.push(motion[i].map((value, axis) => value + share * (motion[i + 1][axis] - value)));
  }
  return points;
}

function stepOf(a: readonly number[], b: readonly number[]): number {
  return Math.hypot(...a.map((value, axis) => b[axis] - value));
}
