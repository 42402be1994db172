// SPDX-License-Identifier: Apache-2.0
import type {Camera} from './camera';
import type {Swarm, Tone} from './swarm';

const kHeadings = 64;
/** A radius is rounded to this, so that zooming does not make a sprite for every step. */
const kRadiusStep_px = 0.5;
/** Fainter than this a pixel of a sprite is left out. */
const kLeastAlpha = 40;
const kMostKinds = 64;

/** Pixels of one arrowhead: their distance from its middle in the image, and the colour, by
 * turns. */
type Sprite = Int32Array;

/** Copies arrowheads that were drawn once, pixel by pixel, into one image. */
export class SwarmSprites implements Swarm {
  readonly canvas = document.createElement('canvas');
  private readonly ctx = this.canvas.getContext('2d', {willReadFrequently: true});
  private readonly pen = document
    .createElement('canvas')
    .getContext('2d', {willReadFrequently: true});
  private image: ImageData | null = null;
  private pixels = new Uint32Array(0);
  private width = 0;
  private height = 0;
  private count = 0;
  private readonly kinds = new Map<string, (Sprite | undefined)[]>();
  private lastKind: {edge: Tone; inside: Tone; r: number; sprites: (Sprite | undefined)[]} | null =
    null;

  get empty(): boolean {
    return this.count === 0;
  }

  begin(most: number, camera: Camera): void {
    this.count = 0;
    if (most === 0) return;
    const [w, h] = [
      Math.max(1, Math.round(camera.width * devicePixelRatio)),
      Math.max(1, Math.round(camera.height * devicePixelRatio)),
    ];
    if (this.image === null || this.width !== w || this.height !== h) {
      [this.canvas.width, this.canvas.height] = [w, h];
      [this.width, this.height] = [w, h];
      this.image = new ImageData(w, h);
      this.pixels = new Uint32Array(this.image.data.buffer);
      // Sprites count in rows of the image.
      this.kinds.clear();
      this.lastKind = null;
    }
    this.pixels.fill(0);
  }

  addTail(points: Float32Array, count: number, tone: Tone): void {
    for (let i = 0; i + 1 < count; ++i) {
      const alpha = 30 + Math.round((100 * (i + 1)) / count);
      this.line(
        points[2 * i],
        points[2 * i + 1],
        points[2 * i + 2],
        points[2 * i + 3],
        packed(tone, alpha),
      );
    }
  }

  add(x: number, y: number, heading: number, r: number, edge: Tone, inside: Tone): void {
    ++this.count;
    const rounded = Math.round((r * devicePixelRatio) / kRadiusStep_px) * kRadiusStep_px;
    const sprites = this.spritesOf(rounded, edge, inside);
    const turn = Math.round((heading / (2 * Math.PI)) * kHeadings) % kHeadings;
    const index = turn < 0 ? turn + kHeadings : turn;
    const sprite = (sprites[index] ??= this.cut(
      rounded,
      (index / kHeadings) * 2 * Math.PI,
      edge,
      inside,
    ));
    const px = Math.round(x * devicePixelRatio);
    const py = Math.round(y * devicePixelRatio);
    const reach = Math.ceil(rounded) + 2;
    if (px < reach || py < reach || px >= this.width - reach || py >= this.height - reach) return;
    const at = py * this.width + px;
    const {pixels} = this;
    for (let i = 0; i < sprite.length; i += 2) pixels[at + sprite[i]] = sprite[i + 1];
  }

  draw(): void {
    if (this.image !== null) this.ctx?.putImageData(this.image, 0, 0);
  }

  dispose(): void {
    this.image = null;
    this.pixels = new Uint32Array(0);
  }

  private spritesOf(r: number, edge: Tone, inside: Tone): (Sprite | undefined)[] {
    const last = this.lastKind;
    if (last !== null && last.r === r && last.edge === edge && last.inside === inside)
      return last.sprites;
    const key = `${r} ${edge.join()} ${inside.join()}`;
    let sprites = this.kinds.get(key);
    if (sprites === undefined) {
      if (this.kinds.size >= kMostKinds) this.kinds.clear();
      this.kinds.set(key, (sprites = new Array<Sprite | undefined>(kHeadings)));
    }
    this.lastKind = {edge, inside, r, sprites};
    return sprites;
  }

  /** Draws an arrowhead once, and keeps its pixels. */
  private cut(r: number, heading: number, edge: Tone, inside: Tone): Sprite {
    const {pen} = this;
    if (pen === null) return new Int32Array(0);
    const half = Math.ceil(r) + 2;
    const size = 2 * half + 1;
    [pen.canvas.width, pen.canvas.height] = [size, size];
    pen.translate(half + 0.5, half + 0.5);
    pen.rotate(heading);
    pen.beginPath();
    pen.moveTo(r, 0);
    pen.lineTo(-0.8 * r, 0.65 * r);
    pen.lineTo(-0.45 * r, 0);
    pen.lineTo(-0.8 * r, -0.65 * r);
    pen.closePath();
    pen.fillStyle = `rgb(${inside.join()})`;
    pen.fill();
    pen.strokeStyle = `rgb(${edge.join()})`;
    pen.lineWidth = devicePixelRatio;
    pen.stroke();
    const data = new Uint32Array(pen.getImageData(0, 0, size, size).data.buffer);
    const kept: number[] = [];
    data.forEach((pixel, i) => {
      if (pixel >>> 24 >= kLeastAlpha)
        kept.push((Math.floor(i / size) - half) * this.width + (i % size) - half, pixel);
    });
    return Int32Array.from(kept);
  }

  /** One pixel wide; never over what is drawn already. */
  private line(ax: number, ay: number, bx: number, by: number, pixel: number): void {
    const {pixels, width, height} = this;
    const k = devicePixelRatio;
    let x = k * ax + 0.5;
    let y = k * ay + 0.5;
    const steps = Math.ceil(Math.max(Math.abs(bx - ax), Math.abs(by - ay)) * k);
    if (steps === 0 || steps > 400 * k) return;
    const dx = (k * (bx - ax)) / steps;
    const dy = (k * (by - ay)) / steps;
    for (let i = 0; i <= steps; ++i, x += dx, y += dy) {
      if (x < 0 || y < 0 || x >= width || y >= height) continue;
      const at = (y | 0) * width + (x | 0);
      if (pixels[at] === 0) pixels[at] = pixel;
    }
  }
}

/** As image data holds it: red in the lowest byte. */
function packed([red, green, blue]: Tone, alpha: number): number {
  return ((alpha << 24) | (blue << 16) | (green << 8) | red) >>> 0;
}
