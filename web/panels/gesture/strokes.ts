// SPDX-License-Identifier: Apache-2.0
import {evened} from '../../gestures/motion';
import type {Template} from '../../gestures/recogniser';
import type {Point} from '../../protocol/messages';
import type {GestureName} from './meanings';

/** Corners of the strokes that come with the page, y upwards, in a square of 1. */
const kCorners: Readonly<Record<Exclude<GestureName, 'gather'>, readonly Point[]>> = {
  go: [
    [0, 0.4],
    [0.35, 0],
    [1, 1],
  ],
  spread: [
    [0, 1],
    [0.25, 0],
    [0.5, 1],
    [0.75, 0],
    [1, 1],
  ],
  follow: [
    [1, 0.85],
    [0.7, 1],
    [0.3, 1],
    [0, 0.8],
    [0.25, 0.58],
    [0.75, 0.42],
    [1, 0.2],
    [0.7, 0],
    [0.3, 0],
    [0, 0.15],
  ],
  stop: [
    [0, 1],
    [1, 0],
    [1, 1],
    [0, 0],
  ],
  release: [
    [0, 0],
    [0, 1],
    [1, 0.5],
    [0, 0],
  ],
};
/** Each is drawn wide, square and tall. */
const kWidths = [0.65, 1, 1.5];
/** A circle may begin at these angles. */
const kStarts_rad = [Math.PI / 4, Math.PI / 2, (3 * Math.PI) / 4, Math.PI];
const kSamples = 60;

/** The strokes that come with the page; what a person teaches is added to them. */
export function builtInStrokes(): Template[] {
  const corners = Object.entries(kCorners).flatMap(([gesture, line]) =>
    kWidths.map((width) => templateOf(gesture, along(line.map(([x, y]) => [width * x, y])))),
  );
  const circles = kStarts_rad.flatMap((start) =>
    [1, -1].map((sense) => templateOf('gather', circle(start, sense))),
  );
  return [...corners, ...circles];
}

const templateOf = (gesture: string, line: Point[]): Template => ({
  gesture,
  points: evened(line) ?? [],
});

function circle(start: number, sense: number): Point[] {
  return Array.from({length: kSamples}, (_, i) => {
    const angle = start + (sense * 2 * Math.PI * i) / (kSamples - 1);
    return [Math.cos(angle), Math.sin(angle)];
  });
}

/** Points at equal distances along a line of corners. */
function along(line: readonly Point[]): Point[] {
  const lengths = line.slice(1).map((b, i) => Math.hypot(b[0] - line[i][0], b[1] - line[i][1]));
  const whole = lengths.reduce((a, b) => a + b, 0);
  return Array.from({length: kSamples}, (_, k) => {
    let left = (whole * k) / (kSamples - 1);
    let i = 0;
    while (i < lengths.length - 1 && left > lengths[i]) left -= lengths[i++];
    const share = Math.min(1, left / lengths[i]);
    const [a, b] = [line[i], line[i + 1]];
    return [a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])];
  });
}
