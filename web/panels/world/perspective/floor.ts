// SPDX-License-Identifier: Apache-2.0
import {
  BufferAttribute,
  BufferGeometry,
  Group,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshBasicMaterial,
  PlaneGeometry,
  ShadowMaterial,
} from 'three';
import type {Palette} from '../../../panel_api';
import type {Bounds} from '../camera';
import {roundStep} from '../ticks';
import {clear} from './solid_robots';

const kMargin_m = 30;
const kLines = 120;
/** Cells that a piece of a line is long. */
const kPiece = 4;

/** The floor, which takes shadows, and its grid. */
export class Floor {
  readonly group = new Group();
  private grid: LineSegments | null = null;

  refresh(bounds: Bounds, palette: Palette): void {
    clear(this.group);
    const width = bounds.x1 - bounds.x0 + 2 * kMargin_m;
    const height = bounds.y1 - bounds.y0 + 2 * kMargin_m;
    const x = (bounds.x0 + bounds.x1) / 2;
    const y = (bounds.y0 + bounds.y1) / 2;
    const size = 4 * Math.max(width, height);
    const plane = new Mesh(
      new PlaneGeometry(size, size),
      new MeshBasicMaterial({color: palette.token('floor')}),
    );
    plane.position.set(x, y, -0.01);
    const shade = new Mesh(
      new PlaneGeometry(width, height),
      new ShadowMaterial({opacity: palette.theme === 'dark' ? 0.55 : 0.18}),
    );
    shade.position.set(x, y, 0.001);
    shade.receiveShadow = true;
    this.grid = makeGrid(bounds, Math.max(width, height), palette);
    this.group.add(plane, this.grid, shade);
  }

  show(grid: boolean): void {
    if (this.grid !== null) this.grid.visible = grid;
  }
}

function makeGrid(bounds: Bounds, extent: number, palette: Palette): LineSegments {
  const step = Math.max(roundStep(extent / kLines), 1);
  const ends: number[] = [];
  const [x0, x1, y0, y1] = [
    bounds.x0 - kMargin_m,
    bounds.x1 + kMargin_m,
    bounds.y0 - kMargin_m,
    bounds.y1 + kMargin_m,
  ];
  // In pieces: some renderers lose a whole line if one of its ends is behind the eye.
  const piece = kPiece * step;
  for (let x = Math.ceil(x0 / step) * step; x <= x1; x += step) {
    for (let y = y0; y < y1; y += piece) ends.push(x, y, 0, x, Math.min(y + piece, y1), 0);
  }
  for (let y = Math.ceil(y0 / step) * step; y <= y1; y += step) {
    for (let x = x0; x < x1; x += piece) ends.push(x, y, 0, Math.min(x + piece, x1), y, 0);
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(Float32Array.from(ends), 3));
  return new LineSegments(geometry, new LineBasicMaterial({color: palette.token('grid-2')}));
}
