// SPDX-License-Identifier: Apache-2.0

/** A reading that is older than this was not followed by the next one, seconds; of a slow sensor,
 * three periods. */
const kCurrent_s = 1;
/** From this age on a reading is as faint as it gets, seconds. */
export const kOldest_s = 5;
const kFaintest = 0.25;

/** What is drawn as what the sensor reads now. `period_s`: 0 where it is not known. */
export function isCurrent(age_s: number, period_s: number): boolean {
  return age_s <= Math.max(kCurrent_s, 3 * period_s);
}

/** How strong a reading is drawn, from 1 down: nothing old looks new. */
export function strengthOf(age_s: number, period_s: number): number {
  if (isCurrent(age_s, period_s)) return 1;
  const faded = (age_s - Math.max(kCurrent_s, 3 * period_s)) / kOldest_s;
  return Math.max(kFaintest, 0.7 - faded);
}
