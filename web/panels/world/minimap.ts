// SPDX-License-Identifier: Apache-2.0
import type {Palette} from '../../panel_api';
import type {Placed} from '../../model/pose_history';
import {RobotFlag} from '../../protocol/frames';
import type {Robot} from '../../protocol/messages';
import type {Bounds, Camera} from './camera';

const kWidth = 190;
const kHeight = 124;
const kMargin = 12;
const kDots_ms = 250;

/** Whether more than half of the robots are outside of what is shown. */
export function mostAreOutside(camera: Camera, placed: Placed): boolean {
  let known = 0;
  let inside = 0;
  for (let i = 0; i < placed.count; ++i) {
    if ((placed.flags[i] & RobotFlag.known) === 0) continue;
    ++known;
    const x = camera.toScreenX(placed.x[i]);
    const y = camera.toScreenY(placed.y[i]);
    if (x >= 0 && y >= 0 && x <= camera.width && y <= camera.height) ++inside;
  }
  return known > 0 && 2 * inside < known;
}

/** All of the world in the lower left corner, with a frame about what is shown. */
export class Minimap {
  private readonly dots = document.createElement('canvas');
  private dotsAt_ms = -Infinity;
  private place: {x: number; y: number; scale: number; bounds: Bounds} | null = null;

  hide(): void {
    this.place = null;
  }

  draw(
    ctx: CanvasRenderingContext2D,
    camera: Camera,
    placed: Placed,
    robots: readonly Robot[],
    bounds: Bounds,
    palette: Palette,
  ): void {
    const scale = Math.min(
      (kWidth - 16) / (bounds.x1 - bounds.x0),
      (kHeight - 16) / (bounds.y1 - bounds.y0),
    );
    const left = kMargin;
    const top = camera.height - kMargin - kHeight;
    const ox = left + kWidth / 2 - (scale * (bounds.x0 + bounds.x1)) / 2;
    const oy = top + kHeight / 2 + (scale * (bounds.y0 + bounds.y1)) / 2;
    this.place = {x: ox, y: oy, scale, bounds};
    ctx.fillStyle = palette.token('bg-2');
    ctx.strokeStyle = palette.token('line-2');
    ctx.lineWidth = 1;
    ctx.globalAlpha = 0.94;
    ctx.beginPath();
    ctx.roundRect(left + 0.5, top + 0.5, kWidth, kHeight, 8);
    ctx.fill();
    ctx.globalAlpha = 1;
    ctx.stroke();
    ctx.save();
    ctx.clip();
    this.drawDots(ctx, placed, robots, palette, left, top, [ox - left, oy - top], scale);
    robots.forEach((robot, slot) => {
      if (robot.kind !== 'real' || (placed.flags[slot] & RobotFlag.known) === 0) return;
      ctx.fillStyle = palette.hue(slot).fill;
      ctx.fillRect(ox + scale * placed.x[slot] - 2, oy - scale * placed.y[slot] - 2, 4, 4);
    });
    const [x0, y1] = camera.toWorld(0, 0);
    const [x1, y0] = camera.toWorld(camera.width, camera.height);
    ctx.strokeStyle = palette.token('intent');
    ctx.lineWidth = 1.5;
    ctx.strokeRect(ox + scale * x0, oy - scale * y1, scale * (x1 - x0), scale * (y1 - y0));
    ctx.restore();
  }

  /** Simulated robots as dots, drawn anew a few times a second: thousands of them cost more than
   * they move. */
  private drawDots(
    ctx: CanvasRenderingContext2D,
    placed: Placed,
    robots: readonly Robot[],
    palette: Palette,
    left: number,
    top: number,
    [ox, oy]: [number, number],
    scale: number,
  ): void {
    const now_ms = performance.now();
    const pen = this.dots.getContext('2d');
    if (pen !== null && Math.abs(now_ms - this.dotsAt_ms) > kDots_ms) {
      this.dotsAt_ms = now_ms;
      [this.dots.width, this.dots.height] = [kWidth * devicePixelRatio, kHeight * devicePixelRatio];
      pen.scale(devicePixelRatio, devicePixelRatio);
      pen.fillStyle = palette.token('sim-ink');
      pen.globalAlpha = placed.count > 400 ? 0.5 : 0.9;
      for (let slot = 0; slot < placed.count; ++slot) {
        if ((placed.flags[slot] & RobotFlag.known) === 0 || robots[slot].kind === 'real') continue;
        pen.fillRect(
          ox + scale * placed.x[slot] - 0.5,
          oy - scale * placed.y[slot] - 0.5,
          1.2,
          1.2,
        );
      }
    }
    ctx.drawImage(this.dots, left, top, kWidth, kHeight);
  }

  /** The place of the world under a pixel of the map; null beside it. */
  at(camera: Camera, px: number, py: number): [number, number] | null {
    const {place} = this;
    const top = camera.height - kMargin - kHeight;
    if (place === null || px < kMargin || px > kMargin + kWidth || py < top || py > top + kHeight)
      return null;
    return [(px - place.x) / place.scale, (place.y - py) / place.scale];
  }
}
