// SPDX-License-Identifier: Apache-2.0

/** A name that wants a place beside a thing on the screen. Pixels. */
export interface Label {
  text: string;
  x: number;
  y: number;
  /** Distance that the name keeps from the point. */
  gap: number;
  colour: string;
  weight: number;
  /** Smaller comes first. */
  rank: number;
  /** Below the thing and centred only, as for obstacles. */
  below?: boolean;
  /** Fades what is far away; 1 if left out. */
  alpha?: number;
  /** Drawn even where no place is free, as the person asks for it. */
  always?: boolean;
}

interface Box {
  x0: number;
  y0: number;
  x1: number;
  y1: number;
}

const kHeight = 14;
/** Directions of the eight places, best first; y down. */
const kPlaces: readonly [number, number][] = [
  [1, 0],
  [-1, 0],
  [0, -1],
  [0, 1],
  [0.75, -0.75],
  [0.75, 0.75],
  [-0.75, -0.75],
  [-0.75, 0.75],
];
const kCell = 64;

/** Finds places where no name lies over another or over a thing; who finds none is left out. */
export class LabelPlacer {
  private readonly cells = new Map<number, Box[]>();

  constructor(
    private readonly width: number,
    private readonly height: number,
  ) {}

  /** Keeps a rectangle free. */
  block(x: number, y: number, half_width: number, half_height = half_width): void {
    this.add({x0: x - half_width, y0: y - half_height, x1: x + half_width, y1: y + half_height});
  }

  isFree(x: number, y: number, half_width: number, half_height: number): boolean {
    return this.free({
      x0: x - half_width,
      y0: y - half_height,
      x1: x + half_width,
      y1: y + half_height,
    });
  }

  /** Draws those that find a place, in order of their rank. */
  draw(ctx: CanvasRenderingContext2D, labels: Label[], halo: string): void {
    labels.sort((a, b) => a.rank - b.rank);
    ctx.textBaseline = 'middle';
    ctx.textAlign = 'left';
    ctx.lineJoin = 'round';
    for (const label of labels) {
      if (label.x < -80 || label.y < -40 || label.x > this.width + 80 || label.y > this.height + 40)
        continue;
      ctx.font = `${label.weight} 12px ${kFont}`;
      const w = widthOf(ctx, label);
      const box = this.place(label, w);
      if (box === null) continue;
      this.add(box);
      ctx.globalAlpha = label.alpha ?? 1;
      ctx.strokeStyle = halo;
      ctx.lineWidth = 3;
      ctx.strokeText(label.text, box.x0 + 2, box.y0 + kHeight / 2);
      ctx.fillStyle = label.colour;
      ctx.fillText(label.text, box.x0 + 2, box.y0 + kHeight / 2);
      ctx.globalAlpha = 1;
    }
  }

  private place(label: Label, w: number): Box | null {
    let first: Box | null = null;
    const places = label.below === true ? [kPlaces[3], kPlaces[2]] : kPlaces;
    for (const [dx, dy] of places) {
      const cx = label.x + dx * (label.gap + (dx === 0 ? 0 : w / 2 + 2));
      const cy = label.y + dy * (label.gap + kHeight / 2);
      const box = {
        x0: cx - w / 2 - 2,
        y0: cy - kHeight / 2,
        x1: cx + w / 2 + 2,
        y1: cy + kHeight / 2,
      };
      if (this.free(box)) return box;
      first ??= box;
    }
    return label.always === true ? first : null;
  }

  private free(box: Box): boolean {
    for (const key of keys(box)) {
      for (const other of this.cells.get(key) ?? []) {
        if (box.x0 < other.x1 && other.x0 < box.x1 && box.y0 < other.y1 && other.y0 < box.y1)
          return false;
      }
    }
    return true;
  }

  private add(box: Box): void {
    for (const key of keys(box)) {
      const cell = this.cells.get(key);
      if (cell === undefined) this.cells.set(key, [box]);
      else cell.push(box);
    }
  }
}

/** Measuring a text costs more than drawing it. */
const widths = new Map<string, number>();
const kMostWidths = 5000;

function widthOf(ctx: CanvasRenderingContext2D, label: Label): number {
  const key = `${label.weight} ${label.text}`;
  let width = widths.get(key);
  if (width === undefined) {
    if (widths.size > kMostWidths) widths.clear();
    widths.set(key, (width = ctx.measureText(label.text).width));
  }
  return width;
}

export const kFont = '"Inter Variable", Inter, system-ui, "DejaVu Sans", sans-serif';

function keys(box: Box): number[] {
  const result: number[] = [];
  for (let i = Math.floor(box.x0 / kCell); i <= Math.floor(box.x1 / kCell); ++i) {
    for (let j = Math.floor(box.y0 / kCell); j <= Math.floor(box.y1 / kCell); ++j)
      result.push(i * 4096 + j);
  }
  return result;
}
