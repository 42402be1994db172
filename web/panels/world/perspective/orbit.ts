// SPDX-License-Identifier: Apache-2.0
import {PerspectiveCamera, Vector3} from 'three';
import type {Bounds} from '../camera';

const kFov_deg = 38;
const kSteepest = 1.54;
const kFlattest = 0.06;
const kNearest_m = 0.4;
const kFarthest_m = 3000;

/** Where the eye is: about a point of the floor, at a distance, turned and tilted. */
interface Eye {
  x: number;
  y: number;
  distance: number;
  yaw: number;
  pitch: number;
}

/** A camera that goes about a point of the floor. z is up. */
export class Orbit {
  readonly camera = new PerspectiveCamera(kFov_deg, 1, 0.05, 4000);
  width = 1;
  height = 1;
  eye: Eye = {x: 0, y: 0, distance: 10, yaw: -1.83, pitch: 0.6};
  private goal: {to: Eye; from: Eye; begin_ms: number} | null = null;
  private readonly point = new Vector3();

  constructor() {
    this.camera.up.set(0, 0, 1);
  }

  resize(width: number, height: number): void {
    this.width = width;
    this.height = height;
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
  }

  rotate(dx: number, dy: number): void {
    this.goal = null;
    this.eye.yaw -= 0.006 * dx;
    this.eye.pitch = Math.min(Math.max(this.eye.pitch + 0.005 * dy, kFlattest), kSteepest);
  }

  /** Moves the floor with the pointer. */
  pan(dx: number, dy: number): void {
    this.goal = null;
    const {eye} = this;
    const metres = (2 * eye.distance * Math.tan((kFov_deg * Math.PI) / 360)) / this.height;
    const c = Math.cos(eye.yaw);
    const s = Math.sin(eye.yaw);
    const along = (dy * metres) / Math.max(Math.sin(eye.pitch), 0.25);
    eye.x += dx * metres * s - along * c;
    eye.y += -dx * metres * c - along * s;
  }

  zoom(factor: number): void {
    this.goal = null;
    this.eye.distance = Math.min(Math.max(this.eye.distance / factor, kNearest_m), kFarthest_m);
  }

  /** The eye that sees all of `bounds`. */
  fitted(bounds: Bounds): Eye {
    const half = Math.max(bounds.x1 - bounds.x0, (bounds.y1 - bounds.y0) * 0.9, 1) / 2;
    const wide = Math.min(this.width / this.height, 1.5);
    const distance = (1.15 * half) / Math.tan((kFov_deg * Math.PI) / 360) / Math.max(wide, 0.5);
    return {...this.eye, x: (bounds.x0 + bounds.x1) / 2, y: (bounds.y0 + bounds.y1) / 2, distance};
  }

  go(to: Eye, now_ms: number, animate: boolean): void {
    this.goal = animate ? {to, from: {...this.eye}, begin_ms: now_ms} : null;
    if (!animate) this.eye = to;
  }

  /** Continues a movement and places the camera; true as long as there is one. */
  advance(now_ms: number, duration_ms = 280): boolean {
    const {goal} = this;
    if (goal !== null) {
      const share = Math.min((now_ms - goal.begin_ms) / duration_ms, 1);
      const eased = 1 - (1 - share) ** 3;
      for (const key of ['x', 'y', 'distance', 'yaw', 'pitch'] as const)
        this.eye[key] = goal.from[key] + eased * (goal.to[key] - goal.from[key]);
      if (share >= 1) this.goal = null;
    }
    const {x, y, distance, yaw, pitch} = this.eye;
    const flat = distance * Math.cos(pitch);
    this.camera.position.set(
      x + flat * Math.cos(yaw),
      y + flat * Math.sin(yaw),
      distance * Math.sin(pitch),
    );
    this.camera.lookAt(x, y, 0);
    this.camera.updateMatrixWorld();
    return this.goal !== null;
  }

  /** Pixels, and the distance from the eye; null behind it. */
  project(x: number, y: number, z: number): {x: number; y: number; distance: number} | null {
    this.point.set(x, y, z);
    const distance = this.point.distanceTo(this.camera.position);
    this.point.project(this.camera);
    if (this.point.z > 1 || this.point.z < -1) return null;
    return {
      x: (this.point.x * 0.5 + 0.5) * this.width,
      y: (0.5 - this.point.y * 0.5) * this.height,
      distance,
    };
  }

  /** Pixels that a metre takes at this distance. */
  pixelsPerMetre(distance: number): number {
    return this.height / (2 * Math.max(distance, 1e-3) * Math.tan((kFov_deg * Math.PI) / 360));
  }
}
