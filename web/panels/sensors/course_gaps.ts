// SPDX-License-Identifier: Apache-2.0

/** From when to when, seconds from now: none is later than 0. */
export type Gap = readonly [number, number];

/** Shorter ones are no gaps, seconds. */
const kLeast_s = 1;
/** In usual spacings: at a high pace readings are farther from each other. */
const kSpacings = 5;

/** The spans of a plot without readings, from `begin_s` to 0; `times_s` in order. A server sends
 * readings while a panel shows the sensor only, so what was before is not known, and must not look
 * like a value. */
export function gapsOf(times_s: readonly number[], begin_s: number, period_s: number): Gap[] {
  const spacings = times_s
    .slice(1)
    .map((t, i) => t - times_s[i])
    .sort((a, b) => a - b);
  const usual_s = spacings[Math.floor(spacings.length / 2)] ?? 0;
  const least_s = Math.max(kLeast_s, 3 * period_s, kSpacings * usual_s);
  const edges = [begin_s, ...times_s, 0];
  return edges
    .slice(1)
    .map((t, i): Gap => [edges[i], t])
    .filter(([from, to]) => to - from > least_s);
}

/** `15 to 4 s ago, 2 to 0 s ago`. */
export function gapsText(gaps: readonly Gap[]): string {
  return gaps.map(([from, to]) => `${Math.round(-from)} to ${Math.round(-to)} s ago`).join(', ');
}
