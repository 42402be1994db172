// SPDX-License-Identifier: Apache-2.0
import type {Placed} from '../../model/pose_history';
import {RobotFlag} from '../../protocol/frames';
import type {Camera} from './camera';
import {bytesOf} from './ramp';

const kCell_px = 14;
/** The number of robots in a cell at which the shade is densest. */
const kFull = 2.5;
const kDarkest = 46;

/** A soft grey below crowds: robots per cell of the screen, blurred by the enlargement. */
export class Density {
  private readonly tile = document.createElement('canvas');

  draw(ctx: CanvasRenderingContext2D, camera: Camera, placed: Placed, colour: string): void {
    const w = Math.ceil(camera.width / kCell_px) + 2;
    const h = Math.ceil(camera.height / kCell_px) + 2;
    const counts = new Float32Array(w * h);
    for (let i = 0; i < placed.count; ++i) {
      if ((placed.flags[i] & RobotFlag.known) === 0) continue;
      const x = camera.toScreenX(placed.x[i]) / kCell_px + 0.5;
      const y = camera.toScreenY(placed.y[i]) / kCell_px + 0.5;
      if (x < 1 || y < 1 || x >= w - 1 || y >= h - 1) continue;
      splat(counts, w, x, y);
    }
    this.fill(counts, w, h, bytesOf(colour));
    ctx.imageSmoothingEnabled = true;
    ctx.imageSmoothingQuality = 'high';
    ctx.drawImage(this.tile, -kCell_px, -kCell_px, w * kCell_px, h * kCell_px);
  }

  private fill(
    counts: Float32Array,
    w: number,
    h: number,
    [red, green, blue]: [number, number, number],
  ): void {
    if (this.tile.width !== w || this.tile.height !== h)
      [this.tile.width, this.tile.height] = [w, h];
    const pen = this.tile.getContext('2d');
    if (pen === null) return;
    const image = pen.createImageData(w, h);
    counts.forEach((count, i) => {
      image.data.set([red, green, blue, kDarkest * Math.min(count / kFull, 1)], 4 * i);
    });
    pen.putImageData(image, 0, 0);
  }
}

/** One robot over its cell and the eight about it. */
function splat(counts: Float32Array, w: number, x: number, y: number): void {
  const at = Math.floor(y) * w + Math.floor(x);
  for (let dy = -1; dy <= 1; ++dy) {
    for (let dx = -1; dx <= 1; ++dx)
      counts[at + dy * w + dx] += dx === 0 && dy === 0 ? 0.4 : dx === 0 || dy === 0 ? 0.15 : 0.05;
  }
}
