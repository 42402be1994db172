// SPDX-License-Identifier: Apache-2.0
import {RobotFlag} from '../../../protocol/frames';
import type {Robot} from '../../../protocol/messages';
import {bodyState, reachOf} from '../body_state';
import {radiusOf} from '../outlines';
import {withAlpha} from '../scan_layer';
import {drawGap, gapText, ghostsOf, kApart_px} from '../shadow_layer';
import type {StageContext} from '../stage';
import type {Orbit} from './orbit';
import {addPrism, type Solid} from './prism';

const kSides = 16;
const kRing = 48;
/** Beyond this number at a time edges would cost more than they tell: the rest is pale. */
const kMostDashed = 300;

/** What is not there as it seems, over the picture in perspective: ghosts of stale robots, real
 * ones that wait to be armed, and the shadows of real robots with their gap. All of them are dashed
 * edges. */
export class GhostOverlay {
  /** Edges in the frame of the robot, made when they are first asked for. */
  private readonly edges = new Map<Robot, number[]>();

  constructor(
    private readonly context: StageContext,
    private readonly orbit: Pick<Orbit, 'project'>,
  ) {}

  refresh(): void {
    this.edges.clear();
  }

  draw(ctx: CanvasRenderingContext2D, shown: (slot: number) => boolean): void {
    ctx.save();
    ctx.lineWidth = 1.5;
    this.drawStates(ctx, shown);
    if (this.context.layers().shadows) this.drawShadows(ctx, shown);
    ctx.restore();
  }

  private drawStates(ctx: CanvasRenderingContext2D, shown: (slot: number) => boolean): void {
    const {model, placed, palette} = this.context;
    let left = kMostDashed;
    for (let slot = 0; slot < placed.count && left > 0; ++slot) {
      const robot = model.robots[slot];
      const state = bodyState(robot.kind, placed.flags[slot]);
      if (state === 'plain' || (placed.flags[slot] & RobotFlag.known) === 0 || !shown(slot))
        continue;
      --left;
      const amber = palette.token('stale-ink');
      ctx.strokeStyle = state === 'unarmed' ? palette.token('warn') : palette.hue(slot).ink;
      ctx.setLineDash([4, 3]);
      this.strokeBody(ctx, robot, placed.x[slot], placed.y[slot], placed.yaw[slot]);
      if (state !== 'stale') continue;
      ctx.strokeStyle = amber;
      ctx.setLineDash([2, 4]);
      this.strokeRing(
        ctx,
        placed.x[slot],
        placed.y[slot],
        1.3 * radiusOf(robot.shapes) + reachOf(placed, slot),
      );
      ctx.fillStyle = withAlpha(amber, 0.06);
      ctx.fill();
    }
  }

  private drawShadows(ctx: CanvasRenderingContext2D, shown: (slot: number) => boolean): void {
    const {model, placed, palette, selection} = this.context;
    for (const ghost of ghostsOf(model, placed)) {
      if (!shown(ghost.slot)) continue;
      const {ink} = palette.hue(ghost.slot);
      const robot = model.robots[ghost.slot];
      ctx.strokeStyle = ink;
      ctx.setLineDash([4, 3]);
      this.strokeBody(ctx, robot, ghost.x, ghost.y, ghost.yaw);
      const twin = this.orbit.project(ghost.x, ghost.y, 0);
      const own = this.orbit.project(placed.x[ghost.slot], placed.y[ghost.slot], 0);
      if (twin === null || own === null) continue;
      const apart = Math.hypot(twin.x - own.x, twin.y - own.y);
      ctx.setLineDash([]);
      if (apart >= kApart_px) {
        ctx.beginPath();
        ctx.moveTo(own.x, own.y);
        ctx.lineTo(twin.x, twin.y);
        ctx.stroke();
      }
      if (apart < kApart_px && !selection.has(ghost.slot)) continue;
      drawGap(
        ctx,
        gapText(ghost.gap_m),
        (twin.x + own.x) / 2,
        Math.max(twin.y, own.y) + 8,
        ink,
        palette.token('floor'),
      );
      ctx.lineWidth = 1.5;
    }
  }

  private strokeBody(
    ctx: CanvasRenderingContext2D,
    robot: Robot,
    x: number,
    y: number,
    yaw: number,
  ): void {
    let edges = this.edges.get(robot);
    if (edges === undefined) this.edges.set(robot, (edges = edgesOf(robot)));
    const [c, s] = [Math.cos(yaw), Math.sin(yaw)];
    const at = (i: number) =>
      this.orbit.project(
        x + c * edges[i] - s * edges[i + 1],
        y + s * edges[i] + c * edges[i + 1],
        edges[i + 2],
      );
    ctx.beginPath();
    let end: {x: number; y: number} | null = null;
    for (let i = 0; i < edges.length; i += 6) {
      const [a, b] = [at(i), at(i + 3)];
      if (a === null || b === null) continue;
      // Dashes continue around a rim: each piece by itself would begin with a new one.
      if (end === null || Math.hypot(end.x - a.x, end.y - a.y) > 1e-6) ctx.moveTo(a.x, a.y);
      ctx.lineTo(b.x, b.y);
      end = b;
    }
    ctx.stroke();
  }

  private strokeRing(ctx: CanvasRenderingContext2D, x: number, y: number, r: number): void {
    ctx.beginPath();
    for (let i = 0; i <= kRing; ++i) {
      const a = (2 * Math.PI * i) / kRing;
      const at = this.orbit.project(x + r * Math.cos(a), y + r * Math.sin(a), 0);
      // A ring that goes behind the eye is left out where it does.
      if (at !== null) ctx.lineTo(at.x, at.y);
    }
    ctx.stroke();
  }
}

/** Rims one after the other, then what joins them. */
function edgesOf(robot: Robot): number[] {
  const edges: number[] = [];
  for (const shape of robot.shapes) {
    const solid: Solid = {faces: [], edges: []};
    addPrism(solid, shape, kSides);
    const low: number[] = [];
    const high: number[] = [];
    const posts: number[] = [];
    for (let i = 0; i < solid.edges.length; i += 6) {
      const edge = solid.edges.slice(i, i + 6);
      (edge[2] !== edge[5] ? posts : edge[2] === shape.z[0] ? low : high).push(...edge);
    }
    edges.push(...low, ...high, ...posts);
  }
  return edges;
}
