// SPDX-License-Identifier: Apache-2.0
import type {Grid} from '../../model/maps';
import type {Palette} from '../../panel_api';
import type {MapTile} from '../../protocol/frames';
import type {Camera} from './camera';
import {bytesOf} from './ramp';

/** Cells along a side of a tile. */
export const kTileCells = 64;
/** A cell of which nothing is known. */
export const kUnknown = 255;
/** How strong a cell is that is certainly free. */
const kFree = 0.2;

interface Picture {
  theme: string;
  canvas: HTMLCanvasElement;
}

/** Pictures of tiles in the colours of the theme; they go with their tiles. */
const pictures = new WeakMap<MapTile, Picture>();

/** Red, green, blue and opacity of a cell: what is free is faint, what is occupied has the colour
 * of walls. */
export function cellColour(
  percent: number,
  free: readonly [number, number, number],
  wall: readonly [number, number, number],
): [number, number, number, number] {
  if (percent > 100) return [0, 0, 0, 0];
  const sure = Math.abs(percent - 50) / 50;
  return percent < 50
    ? [...free, Math.round(255 * kFree * sure)]
    : [...wall, Math.round(255 * sure)];
}

/** The cells of a tile in the colours of the theme, a pixel each; null: there is no canvas. */
export function pictureOf(tile: MapTile, palette: Palette): HTMLCanvasElement | null {
  const known = pictures.get(tile);
  if (known?.theme === palette.theme) return known.canvas;
  const canvas = document.createElement('canvas');
  [canvas.width, canvas.height] = [tile.width, tile.height];
  const ctx = canvas.getContext('2d');
  if (ctx === null) return null;
  const free = bytesOf(palette.token('text-3'));
  const wall = bytesOf(palette.token('wall'));
  const image = ctx.createImageData(tile.width, tile.height);
  for (let y = 0; y < tile.height; ++y) {
    for (let x = 0; x < tile.width; ++x) {
      // Rows of a map go up, those of a picture down.
      const percent = tile.cells[(tile.height - 1 - y) * tile.width + x];
      image.data.set(cellColour(percent, free, wall), 4 * (y * tile.width + x));
    }
  }
  ctx.putImageData(image, 0, 0);
  pictures.set(tile, {theme: palette.theme, canvas});
  return canvas;
}

/** Draws a map over what is there. Unknown cells leave it as it is. */
export function drawMap(
  ctx: CanvasRenderingContext2D,
  camera: Camera,
  grid: Grid,
  palette: Palette,
  opacity = 1,
): void {
  const {frame} = grid;
  ctx.save();
  ctx.globalAlpha = opacity;
  ctx.imageSmoothingEnabled = camera.scale * frame.resolution_m < 1;
  for (const tile of grid.tiles.values()) {
    const x = frame.x0 + tile.column * kTileCells * frame.resolution_m;
    const y = frame.y0 + tile.row * kTileCells * frame.resolution_m;
    // Whole pixels, so that no seam is left between tiles.
    const left = Math.round(camera.toScreenX(x));
    const right = Math.round(camera.toScreenX(x + tile.width * frame.resolution_m));
    const bottom = Math.round(camera.toScreenY(y));
    const top = Math.round(camera.toScreenY(y + tile.height * frame.resolution_m));
    if (right < 0 || bottom < 0 || left > camera.width || top > camera.height) continue;
    const picture = pictureOf(tile, palette);
    if (picture !== null) ctx.drawImage(picture, left, top, right - left, bottom - top);
  }
  ctx.restore();
}

/** What is known of a map, in the world; null: no cell. */
export function boundsOf(grid: Grid): {x0: number; y0: number; x1: number; y1: number} | null {
  const {frame} = grid;
  const bounds = {x0: Infinity, y0: Infinity, x1: -Infinity, y1: -Infinity};
  for (const tile of grid.tiles.values()) {
    for (let i = 0; i < tile.cells.length; ++i) {
      if (tile.cells[i] === kUnknown) continue;
      const x = frame.x0 + (tile.column * kTileCells + (i % tile.width)) * frame.resolution_m;
      const y =
        frame.y0 + (tile.row * kTileCells + Math.floor(i / tile.width)) * frame.resolution_m;
      bounds.x0 = Math.min(bounds.x0, x);
      bounds.y0 = Math.min(bounds.y0, y);
      bounds.x1 = Math.max(bounds.x1, x + frame.resolution_m);
      bounds.y1 = Math.max(bounds.y1, y + frame.resolution_m);
    }
  }
  return bounds.x0 <= bounds.x1 ? bounds : null;
}
