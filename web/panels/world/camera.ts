// SPDX-License-Identifier: Apache-2.0

/** A rectangle of the world, metres. */
export interface Bounds {
  x0: number;
  y0: number;
  x1: number;
  y1: number;
}

/** How the world lies on the screen seen from above: x to the right, y up, no rotation. */
export class Camera {
  x = 0;
  y = 0;
  /** Pixels (CSS) per metre. */
  scale = 60;
  width = 1;
  height = 1;
  /** Pixels at the edges that something else covers: what is fitted or followed stands in the
   * rest. */
  readonly covered = {left: 0, top: 0, right: 0, bottom: 0};
  private goal: {
    x: number;
    y: number;
    scale: number;
    begin: number;
    from: [number, number, number];
  } | null = null;

  toScreenX(x: number): number {
    return (x - this.x) * this.scale + this.width / 2;
  }
  toScreenY(y: number): number {
    return (this.y - y) * this.scale + this.height / 2;
  }
  toWorld(px: number, py: number): [number, number] {
    return [
      (px - this.width / 2) / this.scale + this.x,
      this.y - (py - this.height / 2) / this.scale,
    ];
  }

  /** Zooms about a point of the screen, which stays where it is. */
  zoom(factor: number, px: number, py: number): void {
    this.goal = null;
    const [wx, wy] = this.toWorld(px, py);
    this.scale = Math.min(Math.max(this.scale * factor, 0.05), 4000);
    this.x = wx - (px - this.width / 2) / this.scale;
    this.y = wy + (py - this.height / 2) / this.scale;
  }

  pan(dx: number, dy: number): void {
    this.goal = null;
    this.x -= dx / this.scale;
    this.y += dy / this.scale;
  }

  /** The camera that shows all of `bounds` with a margin. */
  fitted(bounds: Bounds, margin = 36): {x: number; y: number; scale: number} {
    const w = Math.max(bounds.x1 - bounds.x0, 0.5);
    const h = Math.max(bounds.y1 - bounds.y0, 0.5);
    const {left, top, right, bottom} = this.covered;
    const least = Math.min(
      (this.width - left - right - 2 * margin) / w,
      (this.height - top - bottom - 2 * margin) / h,
    );
    const scale = Math.min(Math.max(least, 0.05), 400);
    const [x, y] = this.middleFor((bounds.x0 + bounds.x1) / 2, (bounds.y0 + bounds.y1) / 2, scale);
    return {x, y, scale};
  }

  /** Where the camera stands so that a place of the world is in the middle of what is not
   * covered. */
  middleFor(x: number, y: number, scale = this.scale): [number, number] {
    const {left, top, right, bottom} = this.covered;
    return [x - (left - right) / 2 / scale, y + (top - bottom) / 2 / scale];
  }

  /** Moves to a place, at once or within `duration_ms` from `now_ms` on. */
  go(to: {x: number; y: number; scale: number}, now_ms: number, animate: boolean): void {
    if (!animate) {
      Object.assign(this, to);
      this.goal = null;
      return;
    }
    this.goal = {...to, begin: now_ms, from: [this.x, this.y, this.scale]};
  }

  /** Continues a movement; true as long as there is one. */
  advance(now_ms: number, duration_ms = 280): boolean {
    const goal = this.goal;
    if (goal === null) return false;
    const share = Math.min((now_ms - goal.begin) / duration_ms, 1);
    const eased = 1 - (1 - share) ** 3;
    this.x = goal.from[0] + eased * (goal.x - goal.from[0]);
    this.y = goal.from[1] + eased * (goal.y - goal.from[1]);
    this.scale = goal.from[2] * (goal.scale / goal.from[2]) ** eased;
    if (share >= 1) this.goal = null;
    return share < 1;
  }
}
