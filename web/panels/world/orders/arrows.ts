// SPDX-License-Identifier: Apache-2.0

/** Where an arrow stands on a line, and where it points: radians of the picture, y down. */
export interface Arrow {
  x: number;
  y: number;
  angle: number;
}

/** Arrows along a line of the picture, at a distance in pixels from each other; the ends stay free
 * for their rings. */
export function arrowsAlong(
  points: readonly (readonly [number, number])[],
  every: number,
  free: number,
): Arrow[] {
  const lengths = points
    .slice(1)
    .map(([x, y], i) => Math.hypot(x - points[i][0], y - points[i][1]));
  const whole = lengths.reduce((sum, length) => sum + length, 0);
  const count = Math.floor((whole - 2 * free) / every);
  if (!(count > 0) || !Number.isFinite(whole)) return [];
  const arrows: Arrow[] = [];
  // About the middle, so that none hugs an end.
  let next = (whole - (count - 1) * every) / 2;
  let passed = 0;
  lengths.forEach((length, i) => {
    const [ax, ay] = points[i];
    const [bx, by] = points[i + 1];
    for (; arrows.length < count && next <= passed + length && length > 0; next += every) {
      const share = (next - passed) / length;
      arrows.push({
        x: ax + share * (bx - ax),
        y: ay + share * (by - ay),
        angle: Math.atan2(by - ay, bx - ax),
      });
    }
    passed += length;
  });
  return arrows;
}
