// SPDX-License-Identifier: Apache-2.0
import {
  BufferAttribute,
  BufferGeometry,
  CylinderGeometry,
  DoubleSide,
  Group,
  Mesh,
  MeshBasicMaterial,
  MeshLambertMaterial,
  type Material,
} from 'three';
import type {Placed} from '../../../model/pose_history';
import type {Palette} from '../../../panel_api';
import {RobotFlag} from '../../../protocol/frames';
import type {Robot, Shape} from '../../../protocol/messages';
import {bodyState, type BodyState} from '../body_state';
import {addPrism, type Solid} from './prism';
import {stripes} from './stripes';

const kSides = 32;
/** A disc so narrow and so high is a tube with a barcode. */
const kTubeRadius_m = 0.09;
const kTubeHeight_m = 0.15;
const kWedge_rad = 0.42;
const kOpacity: Readonly<Record<BodyState, number>> = {plain: 1, unarmed: 0.45, stale: 0.08};

/** Real robots: opaque, lit, with a white wedge to the front. */
export class SolidRobots {
  readonly group = new Group();
  private readonly bodies = new Map<number, Group>();

  refresh(robots: readonly Robot[], palette: Palette): void {
    clear(this.group);
    this.bodies.clear();
    robots.forEach((robot, slot) => {
      if (robot.kind !== 'real') return;
      const body = makeBody(robot, palette.hue(slot).fill);
      this.bodies.set(slot, body);
      this.group.add(body);
    });
  }

  update(placed: Placed, shown: (slot: number) => boolean): void {
    for (const [slot, body] of this.bodies) {
      body.visible =
        slot < placed.count && (placed.flags[slot] & RobotFlag.known) !== 0 && shown(slot);
      if (!body.visible) continue;
      body.position.set(placed.x[slot], placed.y[slot], 0);
      body.rotation.z = placed.yaw[slot];
      const state = bodyState('real', placed.flags[slot]);
      if (body.userData['state'] !== state) fade(body, state);
    }
  }
}

/** What is old does not look new, and who waits to be armed is not ready: both have less of their
 * colour. */
function fade(body: Group, state: BodyState): void {
  const plain = state === 'plain';
  body.userData['state'] = state;
  body.traverse((part) => {
    if (!(part instanceof Mesh)) return;
    part.castShadow = plain;
    for (const material of Array.isArray(part.material) ? part.material : [part.material]) {
      (material as Material).transparent = !plain;
      (material as Material).opacity = kOpacity[state];
    }
  });
}

function makeBody(robot: Robot, colour: string): Group {
  const body = new Group();
  const paint = new MeshLambertMaterial({color: colour});
  let widest: Shape | null = null;
  for (const shape of robot.shapes) {
    if (isTube(shape) && robot.barcode !== undefined) {
      body.add(makeTube(shape, robot.barcode, paint));
      continue;
    }
    body.add(shadowed(new Mesh(facesOf(shape), paint)));
    if (widest === null || reach(shape) > reach(widest)) widest = shape;
  }
  if (widest !== null) body.add(makeWedge(0.92 * reach(widest), widest.z[1] + 0.004));
  return body;
}

function isTube(shape: Shape): boolean {
  return (
    shape.disc !== undefined &&
    shape.disc[2] <= kTubeRadius_m &&
    shape.z[1] - shape.z[0] >= kTubeHeight_m
  );
}

/** A cylinder with the bands of its code and a lid. */
export function makeTube(shape: Shape, code: number, lid: Material): Mesh {
  const [x, y, r] = shape.disc ?? [0, 0, 0.05];
  const height = shape.z[1] - shape.z[0];
  const geometry = new CylinderGeometry(r, r, height, 24).rotateX(Math.PI / 2);
  const tube = shadowed(
    new Mesh(geometry, [new MeshLambertMaterial({map: stripes(code)}), lid, lid]),
  );
  tube.position.set(x, y, shape.z[0] + height / 2);
  return tube;
}

export function shadowed(mesh: Mesh): Mesh {
  mesh.castShadow = true;
  return mesh;
}

/** The faces of a prism with their normals. */
export function facesOf(...shapes: readonly Shape[]): BufferGeometry {
  const solid: Solid = {faces: [], edges: []};
  for (const shape of shapes) addPrism(solid, shape, kSides);
  return lit(solid.faces);
}

export function lit(faces: readonly number[]): BufferGeometry {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(Float32Array.from(faces), 3));
  geometry.computeVertexNormals();
  return geometry;
}

function makeWedge(r: number, z: number): Mesh {
  const steps = 6;
  const corners: number[] = [];
  for (let i = 0; i < steps; ++i) {
    const a = -kWedge_rad + (2 * kWedge_rad * i) / steps;
    const b = a + (2 * kWedge_rad) / steps;
    corners.push(0, 0, z, r * Math.cos(a), r * Math.sin(a), z, r * Math.cos(b), r * Math.sin(b), z);
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(Float32Array.from(corners), 3));
  return new Mesh(geometry, new MeshBasicMaterial({color: '#ffffff', side: DoubleSide}));
}

function reach(shape: Shape): number {
  return shape.disc
    ? shape.disc[2]
    : Math.max(...(shape.polygon ?? []).map(([x, y]) => Math.hypot(x, y)));
}

/** Takes everything out of a group and frees what the graphics card holds of it. */
export function clear(group: Group): void {
  group.traverse((part) => {
    const owner = part as Partial<Mesh>;
    owner.geometry?.dispose();
    for (const material of owner.material === undefined
      ? []
      : Array.isArray(owner.material)
        ? owner.material
        : [owner.material]) {
      (material as MeshLambertMaterial).map?.dispose();
      material.dispose();
    }
  });
  group.clear();
}
