// SPDX-License-Identifier: Apache-2.0
import type {Palette, Selection} from '../../panel_api';
import type {Placed} from '../../model/pose_history';
import {RobotFlag} from '../../protocol/frames';
import type {Robot} from '../../protocol/messages';
import type {Camera} from './camera';
import {bodyState, reachOf, type BodyState} from './body_state';
import {kFont} from './labels';
import {isDisc, outlinePath, radiusOf} from './outlines';
import {withAlpha} from './scan_layer';

interface Outline {
  path: Path2D;
  radius: number;
  disc: boolean;
}

/** A robot that matters keeps half of this width from any distance, pixels. */
const kLeast_px = 7.5;
/** A ring about a ghost keeps this distance from it, and from that radius on its inside fades. */
const kRing_px = 12;
const kPlainRing_px = 60;

/** Draws robots one by one, with outline, heading and what is not normal about them. */
export class RobotLayer {
  private outlines: Outline[] = [];

  constructor(
    private readonly palette: Palette,
    private readonly selection: Selection,
  ) {}

  refresh(robots: readonly Robot[]): void {
    this.outlines = robots.map((robot) => ({
      path: outlinePath(robot.shapes),
      radius: radiusOf(robot.shapes),
      disc: isDisc(robot.shapes),
    }));
  }

  radius(slot: number): number {
    return this.outlines[slot]?.radius ?? 0.2;
  }

  /** The outline of a robot as if it were at a place of the screen; `scale`: pixels per metre. */
  strokeOutline(
    ctx: CanvasRenderingContext2D,
    slot: number,
    x: number,
    y: number,
    yaw: number,
    scale: number,
  ): void {
    const outline = this.outlines[slot];
    if (outline === undefined) return;
    const [width, dash] = [ctx.lineWidth, ctx.getLineDash()];
    ctx.save();
    ctx.translate(x, y);
    ctx.rotate(-yaw);
    ctx.scale(scale, -scale);
    ctx.lineWidth = width / scale;
    ctx.setLineDash(dash.map((part) => part / scale));
    ctx.stroke(outline.path);
    ctx.restore();
  }

  draw(
    ctx: CanvasRenderingContext2D,
    camera: Camera,
    placed: Placed,
    slot: number,
    robot: Robot,
    tint: string | null,
  ): void {
    const outline = this.outlines[slot];
    const flags = placed.flags[slot];
    const x = camera.toScreenX(placed.x[slot]);
    const y = camera.toScreenY(placed.y[slot]);
    const grow = Math.max(1, kLeast_px / Math.max(outline.radius * camera.scale, 1e-6));
    const scale = camera.scale * grow;
    const r = outline.radius * scale;
    const hue = this.palette.hue(slot);
    const state = bodyState(robot.kind, flags);
    const stale = state === 'stale';
    if (this.selection.has(slot)) this.drawRing(ctx, x, y, r + 5, true);
    else if (this.selection.hovered === slot) this.drawRing(ctx, x, y, r + 4, false);
    ctx.save();
    ctx.translate(x, y);
    ctx.rotate(-placed.yaw[slot]);
    ctx.save();
    ctx.scale(scale, -scale);
    // In metres: the context is scaled.
    ctx.lineWidth = 1.5 / scale;
    this.fill(ctx, slot, robot, state, tint, scale);
    ctx.stroke(outline.path);
    ctx.restore();
    this.drawHeading(ctx, r, robot, stale ? null : (tint ?? hue.ink));
    ctx.restore();
    if (stale)
      this.drawReach(
        ctx,
        x,
        y,
        r,
        r + reachOf(placed, slot) * camera.scale,
        placed.time_s - placed.freshAt(slot),
      );
    if (state === 'unarmed') this.drawWord(ctx, 'arm', x, y + r + 5, this.palette.token('warn'));
    if ((flags & RobotFlag.stopped) !== 0)
      drawStopped(ctx, x + 0.75 * r, y - 0.75 * r, this.palette);
  }

  /** Its body in the look of its state, and the pen for its outline. */
  private fill(
    ctx: CanvasRenderingContext2D,
    slot: number,
    robot: Robot,
    state: BodyState,
    tint: string | null,
    scale: number,
  ): void {
    const outline = this.outlines[slot];
    const hue = this.palette.hue(slot);
    const stale = state === 'stale';
    if (stale) ctx.setLineDash([3 / scale, 3 / scale]);
    if (robot.kind === 'real' && !stale) {
      const unarmed = state === 'unarmed';
      ctx.globalAlpha = unarmed ? 0.45 : 1;
      ctx.fillStyle = hue.fill;
      ctx.fill(outline.path);
      ctx.globalAlpha = 1;
      ctx.lineWidth = (unarmed ? 2 : 1.25) / scale;
      if (unarmed) ctx.setLineDash([3 / scale, 3 / scale]);
      ctx.strokeStyle = unarmed
        ? this.palette.token('warn')
        : this.palette.theme === 'light'
          ? hue.ink
          : hue.fill;
    } else {
      const name = this.palette.hueName(slot);
      ctx.fillStyle = stale
        ? 'transparent'
        : tint !== null
          ? withAlpha(tint, 0.45)
          : this.palette.token(`${name}-fill`) || this.palette.token('floor');
      ctx.fill(outline.path);
      ctx.strokeStyle = tint ?? hue.ink;
    }
  }

  private drawHeading(
    ctx: CanvasRenderingContext2D,
    r: number,
    robot: Robot,
    ink: string | null,
  ): void {
    if (ink === null) return;
    ctx.beginPath();
    if (robot.kind === 'real') {
      ctx.moveTo(0, 0);
      ctx.arc(0, 0, 0.92 * r, -0.42, 0.42);
      ctx.closePath();
      ctx.fillStyle = '#ffffff';
      ctx.fill();
      return;
    }
    ctx.moveTo(0, 0);
    ctx.lineTo(0.9 * r, 0);
    ctx.strokeStyle = ink;
    ctx.lineWidth = 1.5;
    ctx.stroke();
  }

  private drawRing(
    ctx: CanvasRenderingContext2D,
    x: number,
    y: number,
    r: number,
    selected: boolean,
  ): void {
    const intent = this.palette.token('intent');
    ctx.beginPath();
    ctx.arc(x, y, r, 0, 2 * Math.PI);
    if (selected) {
      ctx.strokeStyle = withAlpha(intent, 0.22);
      ctx.lineWidth = 9;
      ctx.stroke();
    }
    ctx.strokeStyle = selected ? intent : this.palette.token('text-3');
    ctx.lineWidth = selected ? 2 : 1;
    ctx.stroke();
  }

  /** A ghost: how old its pose is, and a circle about where it may be by now, pixels. */
  private drawReach(
    ctx: CanvasRenderingContext2D,
    x: number,
    y: number,
    r: number,
    reach: number,
    age_s: number,
  ): void {
    const ink = this.palette.token('stale-ink');
    ctx.save();
    ctx.setLineDash([2, 4]);
    ctx.strokeStyle = ink;
    const ring = Math.max(r + kRing_px, reach);
    // A large one is a line: it would tint the whole picture.
    ctx.fillStyle = withAlpha(ink, 0.08 * Math.min(1, kPlainRing_px / ring));
    ctx.beginPath();
    ctx.arc(x, y, ring, 0, 2 * Math.PI);
    ctx.fill();
    ctx.stroke();
    ctx.restore();
    this.drawWord(ctx, `${age_s.toFixed(1)} s`, x, y + r + kRing_px + 3, ink);
  }

  /** What is not normal about a robot, under it. */
  private drawWord(
    ctx: CanvasRenderingContext2D,
    text: string,
    x: number,
    y: number,
    ink: string,
  ): void {
    ctx.font = `500 11px ${kFont}`;
    ctx.textAlign = 'center';
    ctx.textBaseline = 'top';
    ctx.lineWidth = 3;
    ctx.strokeStyle = this.palette.token('floor');
    ctx.strokeText(text, x, y);
    ctx.fillStyle = ink;
    ctx.fillText(text, x, y);
  }
}

/** A red octagon with a bar. */
export function drawStopped(
  ctx: CanvasRenderingContext2D,
  x: number,
  y: number,
  palette: Palette,
): void {
  ctx.fillStyle = palette.token('stop-fill');
  ctx.beginPath();
  for (let i = 0; i < 8; ++i) {
    const a = (Math.PI / 4) * (i + 0.5);
    ctx.lineTo(x + 7 * Math.cos(a), y + 7 * Math.sin(a));
  }
  ctx.closePath();
  ctx.fill();
  ctx.fillStyle = '#ffffff';
  ctx.fillRect(x - 3.5, y - 1, 7, 2);
}
