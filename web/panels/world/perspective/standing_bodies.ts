// SPDX-License-Identifier: Apache-2.0
import {Group, Mesh, MeshLambertMaterial, Vector2, type ShaderMaterial} from 'three';
import {LineMaterial} from 'three/addons/lines/LineMaterial.js';
import {LineSegments2} from 'three/addons/lines/LineSegments2.js';
import {LineSegmentsGeometry} from 'three/addons/lines/LineSegmentsGeometry.js';
import type {Palette} from '../../../panel_api';
import type {Body} from '../../../protocol/messages';
import type {Kind, Layers} from '../layers';
import {hatchMaterial, scaleHatch} from './hatch_material';
import {addPrism, type Solid} from './prism';
import {clear, lit, makeTube, shadowed} from './solid_robots';

const kSides = 28;
const kEdge_px = 2;

/** Walls and landmarks are solid; virtual obstacles are hatched, with thick edges and no shadow. */
export class StandingBodies {
  readonly group = new Group();
  private readonly kinds = new Map<Kind, Group>();
  private hatch: ShaderMaterial | null = null;
  private ratio = 1;
  private readonly edge = new LineMaterial({linewidth: kEdge_px});

  refresh(bodies: Iterable<Body>, palette: Palette): void {
    for (const part of this.kinds.values()) clear(part);
    this.group.clear();
    this.kinds.clear();
    const byKind = new Map<Kind, Body[]>();
    for (const body of bodies) byKind.set(body.kind, [...(byKind.get(body.kind) ?? []), body]);
    for (const [kind, members] of byKind) {
      const part =
        kind === 'virtual'
          ? this.hatched(members, palette)
          : kind === 'wall'
            ? walls(members, palette)
            : landmarks(members, palette);
      this.kinds.set(kind, part);
      this.group.add(part);
    }
  }

  /** The size of the picture: thick lines are in its pixels. */
  resize(width: number, height: number): void {
    this.edge.resolution = new Vector2(width, height);
  }

  /** Pixels of the picture to a pixel of the screen: the hatch keeps its width there. */
  setRatio(ratio: number): void {
    this.ratio = ratio;
    if (this.hatch !== null) scaleHatch(this.hatch, ratio);
  }

  show(layers: Layers): void {
    for (const [kind, part] of this.kinds) part.visible = !layers.hidden.includes(kind);
  }

  private hatched(bodies: readonly Body[], palette: Palette): Group {
    const part = new Group();
    const solid = merged(bodies);
    this.hatch = hatchMaterial(palette.token('virtual'), palette.theme === 'light');
    scaleHatch(this.hatch, this.ratio);
    const faces = new Mesh(lit(solid.faces), this.hatch);
    faces.renderOrder = 2;
    this.edge.color.set(palette.token('virtual-line'));
    const edges = new LineSegments2(
      new LineSegmentsGeometry().setPositions(solid.edges),
      this.edge.clone(),
    );
    edges.material.resolution = this.edge.resolution;
    edges.renderOrder = 3;
    part.add(faces, edges);
    return part;
  }
}

function merged(bodies: readonly Body[]): Solid {
  const solid: Solid = {faces: [], edges: []};
  for (const body of bodies)
    for (const shape of body.shapes) addPrism(solid, shape, kSides, body.pose);
  return solid;
}

function walls(bodies: readonly Body[], palette: Palette): Group {
  const part = new Group();
  part.add(
    shadowed(
      new Mesh(lit(merged(bodies).faces), new MeshLambertMaterial({color: palette.token('wall')})),
    ),
  );
  return part;
}

function landmarks(bodies: readonly Body[], palette: Palette): Group {
  const part = new Group();
  const paint = new MeshLambertMaterial({color: '#e9ecf1'});
  const plain: Body[] = [];
  for (const body of bodies) {
    const [shape] = body.shapes;
    if (body.barcode === undefined || shape?.disc === undefined) {
      plain.push(body);
      continue;
    }
    const stand = new Group();
    stand.position.set(body.pose[0], body.pose[1], 0);
    stand.rotation.z = body.pose[2];
    stand.add(makeTube(shape, body.barcode, paint));
    part.add(stand);
  }
  if (plain.length > 0)
    part.add(
      shadowed(
        new Mesh(
          lit(merged(plain).faces),
          new MeshLambertMaterial({color: palette.token('landmark')}),
        ),
      ),
    );
  return part;
}
