// SPDX-License-Identifier: Apache-2.0
import type {MapTile} from '../protocol/frames';
import type {MapName} from '../protocol/messages';
import {Signal} from './signal';

/** Slot of the robot whose local map it is, or name of a global map. */
export type MapKey = number | string;

/** Where the cells of a map lie: cell (0, 0) has its lower left corner at the origin. Metres. */
export interface MapFrame {
  x0: number;
  y0: number;
  resolution_m: number;
  columns: number;
  rows: number;
}

/** What is known of a map. */
export interface Grid {
  frame: MapFrame;
  /** Time of the run of the newest reading in it. */
  stamp_s: number;
  /** By row and column. */
  tiles: Map<string, MapTile>;
}

/** Which map is drawn over the World View. */
export interface MapOverlay {
  key: MapKey;
  /** 0 to 1. */
  opacity: number;
}

export function keyOf(name: MapName): MapKey {
  return name.slot ?? name.name;
}

/** The maps of the run: which there are, and the tiles of those that are looked at. */
export class Maps {
  names: readonly MapName[] = [];
  overlay: MapOverlay | null = null;
  readonly namesChanged = new Signal();
  readonly overlayChanged = new Signal();
  /** Another number whenever something of a map came or went. */
  revision = 0;
  private readonly grids = new Map<MapKey, Grid>();

  take(names: readonly MapName[]): void {
    this.names = names;
    this.namesChanged.emit();
  }

  add(tile: MapTile): void {
    const key = tile.slot ?? tile.name;
    let grid = this.grids.get(key);
    if (grid === undefined || !sameFrame(grid.frame, tile.frame)) {
      grid = {frame: tile.frame, stamp_s: tile.stamp_s, tiles: new Map()};
      this.grids.set(key, grid);
    }
    grid.tiles.set(`${tile.row} ${tile.column}`, tile);
    grid.stamp_s = Math.max(grid.stamp_s, tile.stamp_s);
    ++this.revision;
  }

  /** Null: nothing of it has come yet. */
  of(key: MapKey): Grid | null {
    return this.grids.get(key) ?? null;
  }

  show(overlay: MapOverlay | null): void {
    this.overlay = overlay;
    ++this.revision;
    this.overlayChanged.emit();
  }

  /** Only what is looked at is kept, as the server counts it too. */
  keep(keys: readonly MapKey[]): void {
    for (const key of [...this.grids.keys()]) if (!keys.includes(key)) this.grids.delete(key);
    ++this.revision;
  }

  /** Another run, or the same with other rights. */
  clear(): void {
    this.names = [];
    this.grids.clear();
    if (this.overlay !== null) this.show(null);
    ++this.revision;
  }
}

function sameFrame(a: MapFrame, b: MapFrame): boolean {
  return (
    a.x0 === b.x0 &&
    a.y0 === b.y0 &&
    a.resolution_m === b.resolution_m &&
    a.columns === b.columns &&
    a.rows === b.rows
  );
}
