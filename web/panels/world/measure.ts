// SPDX-License-Identifier: Apache-2.0
import type {Palette} from '../../panel_api';
import type {Camera} from './camera';
import {kFont} from './labels';

/** A straight line of the person over the floor, with its length and direction. */
export class Measure {
  on = false;
  private line: [number, number, number, number] | null = null;

  toggle(): void {
    this.on = !this.on;
    this.line = null;
  }

  begin(x: number, y: number): void {
    this.line = [x, y, x, y];
  }

  extend(x: number, y: number): void {
    if (this.line !== null) [this.line[2], this.line[3]] = [x, y];
  }

  /** Moves the end, metres; a line that is not there yet begins at `from`. */
  nudge(dx: number, dy: number, from: readonly [number, number]): void {
    const [ax, ay, bx, by] = this.line ?? [...from, ...from];
    this.line = [ax, ay, bx + dx, by + dy];
  }

  /** Begins anew where the line ends, or at `from`. */
  goOn(from: readonly [number, number]): void {
    this.begin(...((this.line?.slice(2) as [number, number] | undefined) ?? from));
  }

  /** Length and direction in words; empty without a line. */
  get text(): string {
    if (this.line === null) return '';
    const [ax, ay, bx, by] = this.line;
    const degrees = Math.round((Math.atan2(by - ay, bx - ax) * 180) / Math.PI);
    return `${Math.hypot(bx - ax, by - ay).toFixed(2)} m, ${degrees}°`.replace('-', '−');
  }

  draw(ctx: CanvasRenderingContext2D, camera: Camera, palette: Palette): void {
    if (this.line === null) return;
    const [ax, ay, bx, by] = this.line;
    const [x0, y0] = [camera.toScreenX(ax), camera.toScreenY(ay)];
    const [x1, y1] = [camera.toScreenX(bx), camera.toScreenY(by)];
    ctx.strokeStyle = palette.token('intent');
    ctx.lineWidth = 1.5;
    ctx.beginPath();
    ctx.moveTo(x0, y0);
    ctx.lineTo(x1, y1);
    ctx.stroke();
    const {text} = this;
    ctx.font = `500 12px ${kFont}`;
    const w = ctx.measureText(text).width + 12;
    ctx.fillStyle = palette.token('bg-2');
    ctx.fillRect(x1 + 8, y1 - 24, w, 20);
    ctx.fillStyle = palette.token('intent');
    ctx.textAlign = 'left';
    ctx.textBaseline = 'middle';
    ctx.fillText(text, x1 + 14, y1 - 14);
  }
}
