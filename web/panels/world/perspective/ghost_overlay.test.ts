// SPDX-License-Identifier: Apache-2.0
import {expect, it} from 'vitest';
import {Placed} from '../../../model/pose_history';
import type {Variance} from '../../../protocol/frames';
import {RobotFlag} from '../../../protocol/frames';
import type {Robot} from '../../../protocol/messages';
import {kLayers, type Layers} from '../layers';
import type {StageContext} from '../stage';
import {writeDoubts} from './doubt_marks';
import {FlatLayer} from './flat_layer';
import {GhostOverlay} from './ghost_overlay';
import {GlassRobots} from './glass_robots';
import type {Orbit} from './orbit';

const robot = (kind: Robot['kind']) =>
  ({name: kind, kind, word: '', shapes: [{disc: [0, 0, 0.5], z: [0, 0.3]}]}) as unknown as Robot;

/** Robots in a row, one metre apart. */
function contextOf(
  robots: Robot[],
  flags: number[],
  more: {
    layers?: Partial<Layers>;
    drives?: [number, object][];
    variances?: [number, Variance][];
    selected?: number[];
  } = {},
): StageContext {
  const placed = new Placed();
  placed.resize(robots.length);
  placed.flags = Uint16Array.from(flags);
  placed.x.set(robots.map((_, i) => i));
  placed.fresh = new Float64Array(robots.length);
  placed.fastest = new Float32Array(robots.length).fill(0.25);
  placed.time_s = 4;
  return {
    placed,
    model: {robots, drives: new Map(more.drives), variances: new Map(more.variances)},
    palette: {
      token: (name: string) => name,
      hue: (slot: number) => ({ink: `#00000${slot}`, fill: ''}),
    },
    selection: {has: (slot: number) => more.selected?.includes(slot) ?? false},
    layers: () => ({...kLayers, ...more.layers}),
  } as unknown as StageContext;
}

const orbit = {
  project: (x: number, y: number) => ({x: 100 * x, y: 100 * y, distance: 5}),
  pixelsPerMetre: () => 100,
} as unknown as Orbit;

/** What is stroked and written on a canvas that keeps no pixels. */
function drawn(context: StageContext): {
  strokes: {colour: string; dash: string; far: number}[];
  texts: string[];
} {
  const strokes: {colour: string; dash: string; far: number}[] = [];
  const texts: string[] = [];
  let [dash, far] = ['', 0];
  const to = (x: number, y: number) => (far = Math.max(far, Math.hypot(x, y)));
  const ctx = {
    strokeStyle: '',
    save() {},
    restore() {},
    fill() {},
    strokeText() {},
    beginPath: () => (far = 0),
    moveTo: to,
    lineTo: to,
    setLineDash: (parts: number[]) => (dash = parts.join()),
    stroke() {
      strokes.push({colour: this.strokeStyle, dash, far});
    },
    fillText: (text: string) => texts.push(text),
  };
  new GhostOverlay(context, orbit).draw(ctx as unknown as CanvasRenderingContext2D, () => true);
  return {strokes, texts};
}

it('a stale robot is a dashed ghost inside a ring of what it may have reached', () => {
  const {strokes} = drawn(contextOf([robot('simulated')], [RobotFlag.known | RobotFlag.stale]));
  expect(strokes).toMatchObject([
    {colour: '#000000', dash: '4,3'},
    {colour: 'stale-ink', dash: '2,4'},
  ]);
  expect(strokes[0].far).toBeCloseTo(50);
  // 1.3 radii, and 4 s at 0.25 m/s.
  expect(strokes[1].far).toBeCloseTo(165);
});

it('a real robot that waits to be armed has amber dashes; a simulated one does not wait', () => {
  const {strokes} = drawn(
    contextOf(
      [robot('real'), robot('simulated')],
      [1, 1].map((flag) => flag | RobotFlag.unarmed),
    ),
  );
  expect(strokes).toMatchObject([{colour: 'warn', dash: '4,3'}]);
  expect(drawn(contextOf([robot('real')], [RobotFlag.known])).strokes).toEqual([]);
});

it('the shadow of a real robot is where it is, joined by its gap, and can be switched off', () => {
  const drives: [number, object][] = [[0, {shadow: {running: true, offset: [0.3, 0.4, 0]}}]];
  const {strokes, texts} = drawn(contextOf([robot('real')], [RobotFlag.known], {drives}));
  expect(strokes.map(({dash}) => dash)).toEqual(['4,3', '']);
  expect(strokes[1].far).toBeCloseTo(50);
  expect(texts).toEqual(['50.0 cm']);
  expect(
    drawn(contextOf([robot('real')], [RobotFlag.known], {drives, layers: {shadows: false}}))
      .strokes,
  ).toEqual([]);
});

/** The corners that a layer of the floor has. */
function corners(context: StageContext): number[][] {
  const layer = new FlatLayer(0, 1);
  writeDoubts(layer, context, orbit);
  const {geometry} = layer.mesh;
  const place = geometry.getAttribute('position');
  return Array.from({length: geometry.drawRange.count}, (_, i) => [place.getX(i), place.getY(i)]);
}

it('the ellipse of a selected robot has two standard deviations, on the floor', () => {
  const variances: [number, Variance][] = [
    [0, {xy_m2: 0.25, yaw_rad2: 0}],
    [1, {xy_m2: 0.25, yaw_rad2: 0}],
  ];
  const known = [RobotFlag.known, RobotFlag.known];
  const found = corners(
    contextOf([robot('real'), robot('real')], known, {variances, selected: [0]}),
  );
  expect(found.length).toBeGreaterThan(100);
  expect(Math.max(...found.map(([x, y]) => Math.hypot(x, y)))).toBeCloseTo(1);
  expect(
    corners(
      contextOf([robot('real')], known, {variances, selected: [0], layers: {uncertainty: false}}),
    ),
  ).toEqual([]);
});

it('glass of a ghost is empty', () => {
  const glass = new GlassRobots();
  glass.refresh([robot('simulated'), robot('simulated')]);
  glass.tint(
    () => [9, 9, 9],
    (slot) => slot === 1,
  );
  const faces = (glass.group.children[0] as unknown as FlatLayer['mesh']).geometry.getAttribute(
    'color',
  );
  // Bytes, as shares of one.
  expect(faces.getW(0)).toBeCloseTo(0.16, 1);
  expect(faces.getW(faces.count - 1)).toBe(0);
});
