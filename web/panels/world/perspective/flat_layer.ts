// SPDX-License-Identifier: Apache-2.0
import {
  BufferAttribute,
  BufferGeometry,
  DoubleSide,
  DynamicDrawUsage,
  Mesh,
  MeshBasicMaterial,
} from 'three';
import type {Tone} from '../swarm';

const kFirst = 3 * 256;

/** Coloured triangles on the floor, written anew for every picture: scans, trails, rings. */
export class FlatLayer {
  readonly mesh: Mesh;
  private readonly geometry = new BufferGeometry();
  private places = new Float32Array(3 * kFirst);
  private tones = new Uint8Array(4 * kFirst);
  private vertices = 0;

  constructor(
    private readonly z: number,
    order: number,
  ) {
    const material = new MeshBasicMaterial({
      vertexColors: true,
      transparent: true,
      depthWrite: false,
      side: DoubleSide,
    });
    this.mesh = new Mesh(this.geometry, material);
    this.mesh.frustumCulled = false;
    this.mesh.renderOrder = order;
    this.attach();
  }

  begin(): void {
    this.vertices = 0;
  }

  /** One corner; three make a triangle. `alpha` in bytes. */
  corner(x: number, y: number, tone: Tone, alpha: number): void {
    if (3 * (this.vertices + 1) > this.places.length) this.grow();
    const v = this.vertices++;
    this.places[3 * v] = x;
    this.places[3 * v + 1] = y;
    this.places[3 * v + 2] = this.z;
    this.tones[4 * v] = tone[0];
    this.tones[4 * v + 1] = tone[1];
    this.tones[4 * v + 2] = tone[2];
    this.tones[4 * v + 3] = alpha;
  }

  /** A line of a width in metres, with an alpha at each end. */
  line(
    ax: number,
    ay: number,
    bx: number,
    by: number,
    width: number,
    tone: Tone,
    from: number,
    to: number,
  ): void {
    const length = Math.hypot(bx - ax, by - ay);
    if (length < 1e-6) return;
    const nx = (-(by - ay) / length) * (width / 2);
    const ny = ((bx - ax) / length) * (width / 2);
    this.corner(ax + nx, ay + ny, tone, from);
    this.corner(ax - nx, ay - ny, tone, from);
    this.corner(bx + nx, by + ny, tone, to);
    this.corner(bx + nx, by + ny, tone, to);
    this.corner(ax - nx, ay - ny, tone, from);
    this.corner(bx - nx, by - ny, tone, to);
  }

  /** The band between two circles. */
  ring(x: number, y: number, inner: number, outer: number, tone: Tone, alpha: number): void {
    const steps = 40;
    for (let i = 0; i < steps; ++i) {
      const [a, b] = [(2 * Math.PI * i) / steps, (2 * Math.PI * (i + 1)) / steps];
      const at = (angle: number, r: number) =>
        this.corner(x + r * Math.cos(angle), y + r * Math.sin(angle), tone, alpha);
      at(a, inner);
      at(a, outer);
      at(b, outer);
      at(a, inner);
      at(b, outer);
      at(b, inner);
    }
  }

  end(): void {
    this.geometry.setDrawRange(0, this.vertices);
    for (const name of ['position', 'color']) this.geometry.getAttribute(name).needsUpdate = true;
  }

  private grow(): void {
    const places = new Float32Array(2 * this.places.length);
    const tones = new Uint8Array(2 * this.tones.length);
    places.set(this.places);
    tones.set(this.tones);
    this.places = places;
    this.tones = tones;
    this.attach();
  }

  private attach(): void {
    this.geometry.dispose();
    this.geometry.setAttribute(
      'position',
      new BufferAttribute(this.places, 3).setUsage(DynamicDrawUsage),
    );
    this.geometry.setAttribute(
      'color',
      new BufferAttribute(this.tones, 4, true).setUsage(DynamicDrawUsage),
    );
  }
}
