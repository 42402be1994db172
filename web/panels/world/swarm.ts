// SPDX-License-Identifier: Apache-2.0
import type {Camera} from './camera';

/** A colour in bytes: red, green, blue. */
export type Tone = readonly [number, number, number];

/** Draws any number of robots as arrowheads, with tails. Pixels of the screen, headings
 * clockwise. */
export interface Swarm {
  readonly canvas: HTMLCanvasElement;
  readonly empty: boolean;
  /** Begins a picture of at most `most` robots, seen through `camera`. */
  begin(most: number, camera: Camera): void;
  /** From the oldest of the points, x and y by turns, to the newest. */
  addTail(points: Float32Array, count: number, tone: Tone): void;
  /** An arrowhead of radius `r`; its inside has the second colour. */
  add(x: number, y: number, heading: number, r: number, edge: Tone, inside: Tone): void;
  draw(): void;
  dispose(): void;
}

/** Parts that a tail has at most. */
export const kTailParts = 4;
