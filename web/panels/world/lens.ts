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
  /** Where the pointer is, pixels; null: it looks at the middle, as at the keyboard. */
  at: [number, number] | null = null;
  private readonly camera = new Camera();

  toMiddle(): void {
    this.at = null;
  }

  /** `paint` draws the world through another camera. */
  draw(
    ctx: CanvasRenderingContext2D,
    main: Camera,
    palette: Palette,
    paint: (camera: Camera) => void,
  ): void {
    if (!this.on) return;
    const w = Math.min(kWidth, main.width - 24);
    const h = Math.min(kHeight, main.height - 60);
    const left = main.width - w - 12;
    const top = main.height - h - 40;
    const [px, py] = this.at ?? [main.width / 2, main.height / 2];
    const [wx, wy] = main.toWorld(px, py);
    Object.assign(this.camera, {x: wx, y: wy, scale: main.scale * kTimes, width: w, height: h});
    const seen = [w / kTimes, h / kTimes];
    ctx.strokeStyle = palette.token('intent');
    ctx.lineWidth = 1.5;
    ctx.setLineDash([4, 3]);
    ctx.strokeRect(px - seen[0] / 2, py - seen[1] / 2, seen[0], seen[1]);
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
