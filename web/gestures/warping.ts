// SPDX-License-Identifier: Apache-2.0

/** The most points that one motion may be ahead of the other. */
const kBand = 10;

/** How far two motions are apart by dynamic time warping within a band (H. Sakoe, S. Chiba:
 * "Dynamic programming algorithm optimization for spoken word recognition", IEEE Transactions on
 * Acoustics, Speech, and Signal Processing, 1978): the root of the mean square along the best
 * alignment. Both have `count` points of `width` numbers, one point after the other. */
export function warpedDistance(
  a: Float64Array,
  b: Float64Array,
  count: number,
  width: number,
): number {
  let before = new Float64Array(count + 1).fill(Infinity);
  let row = new Float64Array(count + 1);
  before[0] = 0;
  for (let i = 1; i <= count; ++i) {
    row.fill(Infinity);
    for (let j = Math.max(1, i - kBand); j <= Math.min(count, i + kBand); ++j) {
      let square = 0;
      for (let k = 0; k < width; ++k) {
        const gap = a[(i - 1) * width + k] - b[(j - 1) * width + k];
        square += gap * gap;
      }
      row[j] = square + Math.min(before[j], before[j - 1], row[j - 1]);
    }
    [before, row] = [row, before];
  }
  return Math.sqrt(before[count] / count);
}
