// SPDX-License-Identifier: Apache-2.0
import type {Palette} from '../../panel_api';
import {Camera} from './camera';
import {kFont} from './labels';

const kTimes = 3.5;
const kWidth = 370;
const kHeight = 276;

/** While Z is held: what lies below the pointer, enlarged, in the lower right corner. */
export class Lens {
  on = false;
  x = 0;
  y = 0;
  private readonly camera = new Camera();

  /** `paint` draws the world through another camera. */
  draw(ctx: CanvasRenderingContext2D, main: Camera, palette: Palette, paint: (camera: Camera) => void): void {
    if (!this.on) return;
    const w = Math.min(kWidth, main.width - 24);
    const h = Math.min(kHeight, main.height - 60);
    const left = main.width - w - 12;
    const top = main.height - h - 40;
    const [wx, wy] = main.toWorld(this.x, this.y);
    Object.assign(this.camera, {x: wx, y: wy, scale: main.scale * kTimes, width: w, height: h});
    const seen = [w / kTimes, h / kTimes];
    ctx.strokeStyle = palette.token('intent');
    ctx.lineWidth = 1.5;
    ctx.setLineDash([4, 3]);
    ctx.strokeRect(this.x - seen[0] / 2, this.y - seen[1] / 2, seen[0], seen[1]);
    ctx.setLineDash([]);
    ctx.save();
    ctx.translate(left, top);
    ctx.beginPath();
    ctx.roundRect(0, 0, w, h, 8);
    ctx.save();
    ctx.clip();
    paint(this.camera);
    ctx.restore();
    ctx.strokeStyle = palette.token('intent');
    ctx.beginPath();
    ctx.roundRect(0, 0, w, h, 8);
    ctx.stroke();
    ctx.fillStyle = palette.token('bg-2');
    ctx.beginPath();
    ctx.roundRect(8, 8, 116, 24, 6);
    ctx.fill();
    ctx.font = `500 12px ${kFont}`;
    ctx.fillStyle = palette.token('text-2');
    ctx.textAlign = 'left';
    ctx.textBaseline = 'middle';
    ctx.fillText(`Lens ${kTimes}×  hold Z`, 18, 20.5);
    ctx.restore();
  }
}
