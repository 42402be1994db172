// SPDX-License-Identifier: Apache-2.0
import type {Palette} from '../../panel_api';
import type {Body} from '../../protocol/messages';
import type {Camera} from './camera';
import type {Layers} from './layers';
import {addShape} from './outlines';

interface Group {
  path: Path2D;
  bodies: Body[];
}

/** What stands in the world: walls and landmarks solid, virtual obstacles hatched. */
export class BodyLayer {
  readonly groups = new Map<string, Group>();
  private hatch: CanvasPattern | null = null;

  constructor(private readonly palette: Palette) {}

  /** A kind whose bodies are the same objects as before keeps its path: walls are large. */
  refresh(bodies: Iterable<Body>): void {
    const byKind = new Map<string, Body[]>();
    for (const body of bodies) {
      const same = byKind.get(body.kind);
      if (same === undefined) byKind.set(body.kind, [body]);
      else same.push(body);
    }
    for (const kind of [...this.groups.keys()]) if (!byKind.has(kind)) this.groups.delete(kind);
    for (const [kind, members] of byKind) {
      const old = this.groups.get(kind)?.bodies;
      if (old?.length === members.length && old.every((body, i) => body === members[i])) continue;
      const path = new Path2D();
      for (const body of members) for (const shape of body.shapes) addShape(path, shape, body.pose);
      this.groups.set(kind, {path, bodies: members});
    }
    this.hatch = null;
  }

  draw(ctx: CanvasRenderingContext2D, camera: Camera, layers: Layers): void {
    const token = (name: string) => this.palette.token(name);
    for (const kind of ['wall', 'landmark'] as const) {
      const group = this.groups.get(kind);
      if (group === undefined || layers.hidden.includes(kind)) continue;
      inWorld(ctx, camera, () => {
        ctx.fillStyle = token(kind);
        ctx.fill(group.path);
        if (kind === 'wall') return;
        // A tube stays visible from far away.
        const grow_px = 5 - 0.1 * camera.scale;
        if (grow_px <= 0) return;
        ctx.strokeStyle = token(kind);
        ctx.lineWidth = grow_px / camera.scale;
        ctx.stroke(group.path);
      });
    }
    const group = this.groups.get('virtual');
    if (group === undefined || layers.hidden.includes('virtual')) return;
    inWorld(ctx, camera, () => {
      ctx.fillStyle = token('virtual-fill');
      ctx.fill(group.path);
      ctx.strokeStyle = token('virtual-line');
      ctx.lineWidth = 1.5 / camera.scale;
      ctx.stroke(group.path);
      this.fillHatch(ctx, camera, group.path);
    });
  }

  private fillHatch(ctx: CanvasRenderingContext2D, camera: Camera, path: Path2D): void {
    this.hatch ??= makeHatch(ctx, this.palette.token('virtual-line'));
    if (this.hatch === null) return;
    // The pattern counts in pixels of the screen, so it is given the inverse of the camera.
    this.hatch.setTransform(new DOMMatrix().scale(1 / camera.scale, -1 / camera.scale));
    ctx.fillStyle = this.hatch;
    ctx.fill(path);
  }
}

/** Draws in metres; lines are then given in pixels divided by the scale. */
function inWorld(ctx: CanvasRenderingContext2D, camera: Camera, draw: () => void): void {
  ctx.save();
  ctx.translate(
    camera.width / 2 - camera.x * camera.scale,
    camera.height / 2 + camera.y * camera.scale,
  );
  ctx.scale(camera.scale, -camera.scale);
  draw();
  ctx.restore();
}

/** Lines at 45 degrees every 7 pixels. */
function makeHatch(ctx: CanvasRenderingContext2D, colour: string): CanvasPattern | null {
  const size = 10;
  const tile = document.createElement('canvas');
  tile.width = tile.height = size;
  const pen = tile.getContext('2d');
  if (pen === null) return null;
  pen.strokeStyle = colour;
  pen.lineWidth = 1.1;
  pen.globalAlpha = 0.75;
  pen.beginPath();
  for (const shift of [-size, 0, size]) {
    pen.moveTo(shift - 1, size + 1);
    pen.lineTo(shift + size + 1, -1);
  }
  pen.stroke();
  return ctx.createPattern(tile, 'repeat');
}
