// SPDX-License-Identifier: Apache-2.0
import {
  BufferAttribute,
  BufferGeometry,
  DoubleSide,
  DynamicDrawUsage,
  Group,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshBasicMaterial,
} from 'three';
import type {Placed} from '../../../model/pose_history';
import {RobotFlag} from '../../../protocol/frames';
import type {Robot} from '../../../protocol/messages';
import type {Tone} from '../swarm';
import {addPrism, topOf, type Solid} from './prism';

const kFine = 24;
const kCoarse = 8;
const kCoarseFrom = 150;
/** From this number of robots on they have edges only: faces would cost more than they show. */
const kFacesUpTo = 2000;
const kFill = 0.16;
const kGhostEdge = 60;
/** Of a robot whose pose is not known, far below the floor. */
const kNowhere = -1e6;

/** One robot's share of a merged geometry. */
interface Part {
  slot: number;
  local: Float32Array;
  /** First vertex. */
  from: number;
}

/** Many bodies that move, in one geometry with one draw call. */
class Merged {
  readonly geometry = new BufferGeometry();
  private parts: Part[] = [];
  private places = new BufferAttribute(new Float32Array(0), 3);
  private tones = new BufferAttribute(new Uint8Array(0), 4, true);

  rebuild(solids: readonly {slot: number; local: Float32Array}[]): void {
    let vertices = 0;
    this.parts = solids.map(({slot, local}) => {
      const from = vertices;
      vertices += local.length / 3;
      return {slot, local, from};
    });
    this.places = new BufferAttribute(new Float32Array(3 * vertices), 3).setUsage(DynamicDrawUsage);
    this.tones = new BufferAttribute(new Uint8Array(4 * vertices), 4, true).setUsage(
      DynamicDrawUsage,
    );
    this.geometry.setAttribute('position', this.places);
    this.geometry.setAttribute('color', this.tones);
  }

  place(placed: Placed, shown: (slot: number) => boolean): void {
    const out = this.places.array as Float32Array;
    for (const {slot, local, from} of this.parts) {
      const here =
        slot < placed.count && (placed.flags[slot] & RobotFlag.known) !== 0 && shown(slot);
      const c = Math.cos(placed.yaw[slot]);
      const s = Math.sin(placed.yaw[slot]);
      const x = here ? placed.x[slot] : 0;
      const y = here ? placed.y[slot] : 0;
      for (let i = 0, at = 3 * from; i < local.length; i += 3, at += 3) {
        out[at] = x + c * local[i] - s * local[i + 1];
        out[at + 1] = y + s * local[i] + c * local[i + 1];
        out[at + 2] = here ? local[i + 2] : kNowhere;
      }
    }
    this.places.needsUpdate = true;
  }

  tint(toneOf: (slot: number) => Tone, alphaOf: (slot: number) => number): void {
    const out = this.tones.array as Uint8Array;
    for (const {slot, local, from} of this.parts) {
      const [red, green, blue] = toneOf(slot);
      const alpha = alphaOf(slot);
      for (let v = from; v < from + local.length / 3; ++v)
        out.set([red, green, blue, alpha], 4 * v);
    }
    this.tones.needsUpdate = true;
  }
}

/** Simulated robots: glass with edges, and a line to the front. */
export class GlassRobots {
  readonly group = new Group();
  private readonly faces = new Merged();
  private readonly edges = new Merged();

  constructor() {
    const mesh = new Mesh(
      this.faces.geometry,
      new MeshBasicMaterial({
        vertexColors: true,
        transparent: true,
        depthWrite: false,
        side: DoubleSide,
      }),
    );
    const lines = new LineSegments(
      this.edges.geometry,
      new LineBasicMaterial({vertexColors: true, transparent: true}),
    );
    mesh.frustumCulled = lines.frustumCulled = false;
    mesh.renderOrder = 4;
    lines.renderOrder = 5;
    this.group.add(mesh, lines);
  }

  refresh(robots: readonly Robot[]): void {
    const simulated = robots.flatMap((robot, slot) =>
      robot.kind === 'simulated' ? [{robot, slot}] : [],
    );
    const sides = simulated.length > kCoarseFrom ? kCoarse : kFine;
    const solids = simulated.map(({robot, slot}) => ({slot, solid: solidOf(robot, sides)}));
    this.edges.rebuild(
      solids.map(({slot, solid}) => ({slot, local: Float32Array.from(solid.edges)})),
    );
    this.faces.rebuild(
      simulated.length > kFacesUpTo
        ? []
        : solids.map(({slot, solid}) => ({slot, local: Float32Array.from(solid.faces)})),
    );
  }

  update(placed: Placed, shown: (slot: number) => boolean): void {
    this.faces.place(placed, shown);
    this.edges.place(placed, shown);
  }

  /** Colours, and who is a ghost: empty, with edges that hardly show below its dashes. Needed only
   * when they change. */
  tint(toneOf: (slot: number) => Tone, ghost: (slot: number) => boolean): void {
    this.faces.tint(toneOf, (slot) => (ghost(slot) ? 0 : Math.round(255 * kFill)));
    this.edges.tint(toneOf, (slot) => (ghost(slot) ? kGhostEdge : 255));
  }
}

function solidOf(robot: Robot, sides: number): Solid {
  const solid: Solid = {faces: [], edges: []};
  let reach = 0;
  for (const shape of robot.shapes) {
    addPrism(solid, shape, sides);
    reach = Math.max(
      reach,
      shape.disc ? shape.disc[2] : Math.max(...(shape.polygon ?? []).map(([x]) => x)),
    );
  }
  const top = topOf(robot.shapes);
  solid.edges.push(0, 0, top, 0.9 * reach, 0, top);
  return solid;
}
