// SPDX-License-Identifier: Apache-2.0
import {CanvasTexture, Group, Mesh, MeshBasicMaterial, NearestFilter, PlaneGeometry} from 'three';
import type {Maps} from '../../../model/maps';
import type {Palette} from '../../../panel_api';
import type {MapTile} from '../../../protocol/frames';
import {kTileCells, pictureOf} from '../draw_map';

/** Between the floor, which takes shadows, and what is drawn on it. */
const kHeight_m = 0.004;

interface Shown {
  tile: MapTile;
  theme: string;
  mesh: Mesh<PlaneGeometry, MeshBasicMaterial>;
}

/** The map that is shown over the world, flat on the floor: a rectangle for each of its tiles. */
export class MapPlane {
  readonly group = new Group();
  private readonly shown = new Map<string, Shown>();
  private key = '';

  /** Cheap as long as nothing changed. */
  update(maps: Maps, palette: Palette): void {
    const {overlay} = maps;
    const key =
      overlay === null
        ? ''
        : [maps.revision, overlay.key, overlay.opacity, palette.theme].join(' ');
    if (key === this.key) return;
    this.key = key;
    const grid = overlay === null ? null : maps.of(overlay.key);
    if (overlay === null || grid === null) return this.clear();
    for (const [place, one] of this.shown) if (!grid.tiles.has(place)) this.drop(place, one);
    for (const [place, tile] of grid.tiles) {
      const before = this.shown.get(place);
      if (before !== undefined && before.tile === tile && before.theme === palette.theme) {
        before.mesh.material.opacity = overlay.opacity;
        continue;
      }
      if (before !== undefined) this.drop(place, before);
      const mesh = makeTile(tile, palette, overlay.opacity);
      if (mesh === null) continue;
      this.group.add(mesh);
      this.shown.set(place, {tile, theme: palette.theme, mesh});
    }
  }

  clear(): void {
    for (const [place, one] of this.shown) this.drop(place, one);
  }

  private drop(place: string, {mesh}: Shown): void {
    this.group.remove(mesh);
    mesh.material.map?.dispose();
    mesh.material.dispose();
    mesh.geometry.dispose();
    this.shown.delete(place);
  }
}

function makeTile(tile: MapTile, palette: Palette, opacity: number): Shown['mesh'] | null {
  const picture = pictureOf(tile, palette);
  if (picture === null) return null;
  const {x0, y0, resolution_m} = tile.frame;
  const [width, height] = [tile.width * resolution_m, tile.height * resolution_m];
  const texture = new CanvasTexture(picture);
  texture.magFilter = NearestFilter;
  texture.generateMipmaps = false;
  texture.minFilter = NearestFilter;
  const material = new MeshBasicMaterial({
    map: texture,
    transparent: true,
    opacity,
    depthWrite: false,
  });
  const mesh = new Mesh(new PlaneGeometry(width, height), material);
  mesh.position.set(
    x0 + tile.column * kTileCells * resolution_m + width / 2,
    y0 + tile.row * kTileCells * resolution_m + height / 2,
    kHeight_m,
  );
  return mesh;
}
