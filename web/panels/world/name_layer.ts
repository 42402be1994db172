// SPDX-License-Identifier: Apache-2.0
import type {Palette, Selection} from '../../panel_api';
import type {Placed} from '../../model/pose_history';
import type {Body, Robot} from '../../protocol/messages';
import {bodyState} from './body_state';
import type {Camera} from './camera';
import {LabelPlacer, type Label} from './labels';
import type {Kind, Layers} from './layers';
import {boxOf} from './outlines';

const kNearNames_px = 60;
const kFewRobots = 40;

/** Whether there is room for the names of everybody. */
export function namesFit(camera: Camera, robots: number): boolean {
  return camera.scale >= kNearNames_px || robots <= kFewRobots;
}

/** The name of a robot, and how early it gets its place. */
export function robotLabel(
  robot: Robot,
  slot: number,
  flags: number,
  x: number,
  y: number,
  r: number,
  selection: Selection,
  palette: Palette,
): Label {
  const marked = robot.kind === 'real' || robot.word !== '';
  // Its state may be part of the label, so it comes before the names of robots that are well.
  const troubled = bodyState(robot.kind, flags) !== 'plain';
  return {
    text: robot.name,
    x,
    y,
    gap: r + (selection.has(slot) ? 9 : 4),
    colour: marked ? palette.hue(slot).ink : palette.token('sim-ink'),
    weight: marked ? 600 : 400,
    always: selection.hovered === slot,
    rank:
      selection.hovered === slot
        ? -1
        : slot === selection.primary
          ? 0
          : troubled
            ? 0.5
            : robot.kind === 'real'
              ? 1
              : robot.word !== ''
                ? 2
                : 5,
  };
}

/** The names of bodies; tubes only where there is room. */
export function bodyLabels(
  groups: ReadonlyMap<string, {bodies: readonly Body[]}>,
  camera: Camera,
  layers: Layers,
  near: boolean,
  palette: Palette,
  placer: LabelPlacer,
): Label[] {
  const labels: Label[] = [];
  for (const [kind, group] of groups) {
    if (layers.hidden.includes(kind as Kind) || kind === 'wall') continue;
    if (kind === 'landmark' && !near) continue;
    for (const body of group.bodies) {
      const box = boxOf(body);
      const x = camera.toScreenX(box.x);
      const y = camera.toScreenY(box.y);
      const virtual = kind === 'virtual';
      labels.push({
        text: virtual ? body.name : shortName(body.name),
        x,
        y,
        gap: virtual ? box.hy * camera.scale : Math.max(box.hx * camera.scale, 4) + 3,
        colour: palette.token(virtual ? 'virtual-ink' : 'landmark-ink'),
        weight: 500,
        rank: virtual ? 4 : 6,
        below: virtual,
      });
      if (!virtual) placer.block(x, y, 4);
    }
  }
  return labels;
}

/** Whom to name, in the picture `placed`. `whole` says who is drawn with an outline. */
export function robotLabels(
  robots: readonly Robot[],
  slots: readonly number[],
  camera: Camera,
  placed: Placed,
  radius: (slot: number) => number,
  selection: Selection,
  palette: Palette,
  placer: LabelPlacer,
): Label[] {
  return slots.map((slot) => {
    const x = camera.toScreenX(placed.x[slot]);
    const y = camera.toScreenY(placed.y[slot]);
    const r = Math.max(radius(slot) * camera.scale, 5);
    placer.block(x, y, 0.8 * r);
    // The word below it.
    if (bodyState(robots[slot].kind, placed.flags[slot]) !== 'plain')
      placer.block(x, y + r + 13, 14, 8);
    return robotLabel(robots[slot], slot, placed.flags[slot], x, y, r, selection, palette);
  });
}

/** `tube-14` is `14` where there are many of them. */
export function shortName(name: string): string {
  return /-(\d+)$/.exec(name)?.[1] ?? name;
}
