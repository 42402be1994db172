// SPDX-License-Identifier: Apache-2.0
import {describe, expect, it} from 'vitest';
import type {MapTile} from '../protocol/frames';
import {Maps, keyOf} from './maps';

const kFrame = {x0: 0, y0: 0, resolution_m: 0.1, columns: 128, rows: 64};

function tile(
  slot: number | null,
  column: number,
  stamp_s: number,
  more: Partial<MapTile> = {},
): MapTile {
  return {
    slot,
    name: slot === null ? 'all' : '',
    stamp_s,
    frame: kFrame,
    column,
    row: 0,
    width: 1,
    height: 1,
    cells: new Uint8Array(1),
    ...more,
  };
}

describe('maps', () => {
  it('keep the newest tile of each place, of each map by itself', () => {
    const maps = new Maps();
    expect(maps.of(1)).toBeNull();
    maps.add(tile(1, 0, 5));
    const newer = tile(1, 0, 6);
    maps.add(newer);
    maps.add(tile(1, 1, 4));
    maps.add(tile(null, 0, 1));
    expect(maps.of(1)?.tiles.size).toBe(2);
    expect(maps.of(1)?.tiles.get('0 0')).toBe(newer);
    expect(maps.of(1)?.stamp_s).toBe(6);
    expect(maps.of('all')?.tiles.size).toBe(1);
  });

  it('begin anew with another frame, and forget what nobody looks at', () => {
    const maps = new Maps();
    maps.add(tile(1, 0, 5));
    maps.add(tile(1, 1, 6, {frame: {...kFrame, x0: 3}}));
    expect(maps.of(1)?.tiles.size).toBe(1);
    maps.add(tile(2, 0, 5));
    maps.keep([2]);
    expect(maps.of(1)).toBeNull();
    expect(maps.of(2)).not.toBeNull();
  });

  it('another run takes the map from the world', () => {
    const maps = new Maps();
    maps.take([{name: 'a', slot: 3}, {name: 'all'}]);
    expect(maps.names.map(keyOf)).toEqual([3, 'all']);
    maps.show({key: 3, opacity: 0.5});
    let told = 0;
    maps.overlayChanged.on(() => ++told);
    maps.clear();
    expect(maps.overlay).toBeNull();
    expect(told).toBe(1);
  });
});
