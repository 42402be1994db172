// SPDX-License-Identifier: Apache-2.0
import {describe, expect, it} from 'vitest';
import type {MapTile} from '../../protocol/frames';
import {boundsOf, cellColour} from './draw_map';

const kFrame = {x0: -1, y0: 2, resolution_m: 0.5, columns: 70, rows: 2};

describe('a map', () => {
  it('shows what is sure strongly, and nothing of what is unknown', () => {
    const free = [1, 2, 3] as const;
    const wall = [4, 5, 6] as const;
    expect(cellColour(100, free, wall)).toEqual([4, 5, 6, 255]);
    expect(cellColour(50, free, wall)[3]).toBe(0);
    expect(cellColour(255, free, wall)[3]).toBe(0);
    expect(cellColour(0, free, wall).slice(0, 3)).toEqual([1, 2, 3]);
    expect(cellColour(0, free, wall)[3]).toBeGreaterThan(cellColour(30, free, wall)[3]);
  });

  it('is as large as what is known of it', () => {
    const tile: MapTile = {
      slot: 0,
      name: '',
      stamp_s: 0,
      frame: kFrame,
      column: 1,
      row: 0,
      width: 6,
      height: 2,
      cells: new Uint8Array([255, 255, 255, 255, 255, 255, 255, 3, 255, 100, 255, 255]),
    };
    expect(boundsOf({frame: kFrame, stamp_s: 0, tiles: new Map([['0 1', tile]])})).toEqual({
      x0: 31.5,
      y0: 2.5,
      x1: 33,
      y1: 3,
    });
    expect(boundsOf({frame: kFrame, stamp_s: 0, tiles: new Map()})).toBeNull();
  });
});
