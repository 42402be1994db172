// SPDX-License-Identifier: Apache-2.0
import type {Point} from '../../protocol/messages';
import {spread} from '../../model/commands';

export type GestureName = 'go' | 'gather' | 'spread' | 'follow' | 'stop' | 'release';

/** What the gestures are called, and what they mean to a team. `shape`: the stroke that comes with
 * the page. */
export const kGestures: Readonly<Record<GestureName, {shape: string; means: string}>> = {
  go: {shape: 'Tick', means: 'go there'},
  gather: {shape: 'Circle', means: 'gather here'},
  spread: {shape: 'W', means: 'spread out'},
  follow: {shape: 'S', means: 'follow'},
  stop: {shape: 'X', means: 'stop all'},
  release: {shape: 'Triangle', means: 'release all'},
};
export const kGestureNames = Object.keys(kGestures) as GestureName[];

/** What a gesture would do. Nothing is sent yet. */
export interface Proposal {
  readonly gesture: GestureName;
  readonly title: string;
  /** Who does it, and where. */
  readonly detail: string;
  /** Robots that are sent to a place of their own. */
  readonly slots: readonly number[];
  readonly points: readonly Point[];
  /** Why it cannot be sent, in words; empty if it can. */
  readonly why: string;
}

/** A robot as a gesture sees it. */
export interface Member {
  readonly slot: number;
  readonly name: string;
  readonly at: Point;
  readonly yaw: number;
  readonly radius: number;
  /** Takes goals from this person. */
  readonly obeys: boolean;
}

/** What a gesture is made over. */
export interface Scene {
  readonly members: readonly Member[];
  /** Slots that are selected; the last one leads. */
  readonly selected: readonly number[];
  /** The stroke in the world, metres; empty for a motion of the hand. */
  readonly stroke: readonly Point[];
  /** The middle of the picture, which a motion points at. */
  readonly middle: Point;
  readonly mayRelease: boolean;
}

/** Between robots that spread out or follow, edge to edge, metres. */
const kApart_m = 1;
const kBehind_m = 0.4;

/** What a gesture means here and now. */
export function propose(gesture: GestureName, scene: Scene): Proposal {
  const {shape, means} = kGestures[gesture];
  const title = scene.stroke.length > 0 ? `${shape}: ${means}` : capital(means);
  const whole = {gesture, title, slots: [], points: []};
  if (gesture === 'stop') return {...whole, detail: 'all robots', why: ''};
  if (gesture === 'release')
    return {
      ...whole,
      detail: 'all robots',
      why: scene.mayRelease ? '' : 'Your rights do not include releasing robots.',
    };
  const team = teamOf(gesture, scene);
  if (gesture === 'follow' && scene.selected.length === 0)
    return {...whole, detail: '', why: 'Select the robot that leads.'};
  if (team.length === 0) return {...whole, detail: '', why: 'No robot here takes goals from you.'};
  const {points, where} = placesOf(gesture, scene, team);
  const slots = team.map(({slot}) => slot);
  return {gesture, title, detail: `${namesOf(team)}${where}`, slots, points, why: ''};
}

/** Who is meant: those in the circle, or the selected ones, or all that obey. The leader does not
 * follow itself; where it is selected alone, everybody else follows. */
function teamOf(gesture: GestureName, scene: Scene): Member[] {
  const obeying = scene.members.filter(({obeys}) => obeys);
  if (gesture === 'gather' && scene.stroke.length > 0) {
    const inside = obeying.filter(({at}) => isInside(at, scene.stroke));
    if (inside.length > 1) return inside;
  }
  const selected = obeying.filter(({slot}) => scene.selected.includes(slot));
  if (gesture !== 'follow') return scene.selected.length > 0 ? selected : obeying;
  const leader = scene.selected[scene.selected.length - 1];
  return (scene.selected.length > 1 ? selected : obeying).filter(({slot}) => slot !== leader);
}

function placesOf(
  gesture: GestureName,
  scene: Scene,
  team: readonly Member[],
): {points: Point[]; where: string} {
  const {stroke, middle} = scene;
  const about = (at: Point) => (team.length === 1 ? [at] : spread(at, team.map(radiusOf)));
  const centre = meanOf(team.map(({at}) => at));
  if (gesture === 'go') {
    // The corner of the tick is its lowest point.
    const to = stroke.length > 0 ? stroke.reduce((a, b) => (b[1] < a[1] ? b : a)) : middle;
    return {points: about(to), where: ` to ${metres(to)}`};
  }
  if (gesture === 'gather') {
    const to = stroke.length > 0 ? meanOf(stroke) : centre;
    return {points: about(to), where: ` about ${metres(to)}`};
  }
  if (gesture === 'spread') return {points: ringOf(team, centre), where: `, ${kApart_m} m apart`};
  const leader = scene.members.find(({slot}) => slot === scene.selected[scene.selected.length - 1]);
  if (leader === undefined) return {points: about(centre), where: ''};
  return {points: columnOf(team, leader), where: ` behind ${leader.name}, where it is now`};
}

/** On a circle, each in the direction in which it is already. */
function ringOf(team: readonly Member[], centre: Point): Point[] {
  const step = kApart_m + 2 * Math.max(...team.map(radiusOf));
  const radius = Math.max(step / 2, (step * team.length) / (2 * Math.PI));
  const angleOf = ({at}: Member) => Math.atan2(at[1] - centre[1], at[0] - centre[0]);
  const order = [...team].sort((a, b) => angleOf(a) - angleOf(b) || a.slot - b.slot);
  return team.map((member) => {
    const angle = angleOf(order[0]) + (2 * Math.PI * order.indexOf(member)) / team.length;
    return [centre[0] + radius * Math.cos(angle), centre[1] + radius * Math.sin(angle)];
  });
}

/** One behind the other behind the leader, the nearest first. */
function columnOf(team: readonly Member[], leader: Member): Point[] {
  const distance = ({at}: Member) => Math.hypot(at[0] - leader.at[0], at[1] - leader.at[1]);
  const order = [...team].sort((a, b) => distance(a) - distance(b) || a.slot - b.slot);
  const step = kBehind_m + 2 * Math.max(leader.radius, ...team.map(radiusOf));
  return team.map((member) => {
    const back = step * (order.indexOf(member) + 1);
    return [leader.at[0] - back * Math.cos(leader.yaw), leader.at[1] - back * Math.sin(leader.yaw)];
  });
}

const radiusOf = ({radius}: Member): number => radius;

function meanOf(points: readonly Point[]): Point {
  const sum = points.reduce(([x, y], point) => [x + point[0], y + point[1]] as Point, [0, 0]);
  return [sum[0] / points.length, sum[1] / points.length];
}

/** Even-odd rule; the last point is joined to the first. */
export function isInside([x, y]: Point, outline: readonly Point[]): boolean {
  let inside = false;
  for (let i = 0, j = outline.length - 1; i < outline.length; j = i++) {
    const [a, b] = [outline[i], outline[j]];
    if (a[1] > y !== b[1] > y && x < ((b[0] - a[0]) * (y - a[1])) / (b[1] - a[1]) + a[0])
      inside = !inside;
  }
  return inside;
}

const metres = ([x, y]: Point): string => `${x.toFixed(1)}, ${y.toFixed(1)}`;
const capital = (text: string): string => text[0].toUpperCase() + text.slice(1);

function namesOf(team: readonly Member[]): string {
  if (team.length > 4) return `${team.length} robots`;
  const names = team.map(({name}) => name);
  return names.length < 2
    ? names.join('')
    : `${names.slice(0, -1).join(', ')} and ${names[names.length - 1]}`;
}
