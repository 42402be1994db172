// SPDX-License-Identifier: Apache-2.0
import type {Parameter} from '../protocol/messages';

/** A range may end at a billion, and then a slider is of no use: one about the value is. */
export function usefulRange(parameter: Pick<Parameter, 'range'>, value: number): [number, number] {
  const [low, high] = parameter.range ?? [0, Infinity];
  const about = Math.max(1, Math.abs(value));
  return [Math.max(low, -4 * about), Math.min(high, 4 * about)];
}
