// SPDX-License-Identifier: Apache-2.0
import {spread} from '../../../model/commands';
import {Signal} from '../../../model/signal';
import type {PanelContext} from '../../../panel_api';
import type {Body, Point} from '../../../protocol/messages';
import {radiusOf} from '../outlines';
import {outlineOf, outlineText, thinned, type Outline, type OutlineKind} from './outline';

/** What a press in the World View does. */
export type Tool = 'select' | 'goal' | 'path' | 'obstacle' | 'place';

/** What is being drawn, before it is asked for. */
export type Draft =
  | {kind: 'goal'; point: Point; yaw: number | null}
  | {kind: 'path'; points: Point[]}
  | {kind: 'place'; point: Point; yaw: number | null}
  | {kind: 'outline'; shape: OutlineKind; points: Point[]};

/** Something that was answered and has no place of its own in the picture. */
export interface Note {
  text: string;
  good: boolean;
  at: Point;
}

const kNote_ms = 6000;

/** What a person draws for robots and of obstacles: from the first press until it is asked for. */
export class OrderDesk {
  tool: Tool = 'select';
  shape: OutlineKind = 'box';
  draft: Draft | null = null;
  /** The obstacle that has handles. */
  body: number | null = null;
  /** Where that obstacle is dragged to. */
  moved: [number, number, number] | null = null;
  note: Note | null = null;
  readonly changed = new Signal();

  constructor(private readonly context: PanelContext) {}

  choose(tool: Tool): void {
    this.tool = tool;
    this.draft = null;
    if (tool !== 'select') this.body = null;
    this.changed.emit();
  }

  /** Drops what is begun, then the tool; false if there was nothing. */
  drop(): boolean {
    if (this.draft !== null) this.draft = null;
    else if (this.body !== null) this.body = null;
    else if (this.note !== null) this.note = null;
    else if (this.tool !== 'select') this.tool = 'select';
    else return false;
    this.changed.emit();
    return true;
  }

  /** The selected robots that take something from this person. */
  slotsFor(what: 'goal' | 'path' | 'place'): number[] {
    const {model, selection} = this.context;
    if (what === 'place')
      return selection.slots.filter(
        (slot) => model.may('edit') && model.live && model.robots[slot]?.kind === 'simulated',
      );
    return selection.slots.filter((slot) => model.whyNotTaken(slot, what) === '');
  }

  /** Why a tool is of no use now; empty if it is. */
  whyNot(tool: Tool): string {
    const {model, selection} = this.context;
    if (tool === 'select') return '';
    if (tool === 'obstacle') return model.live ? model.whyNot('edit') : 'This is a recording.';
    const primary = selection.primary;
    if (primary === null) return 'Select a robot first.';
    if (this.slotsFor(tool).length > 0) return '';
    if (tool === 'place')
      return model.may('edit') ? 'Only simulated robots can be placed.' : model.whyNot('edit');
    return model.whyNotTaken(primary, tool);
  }

  /** Whether a drag that begins at a robot draws its path. */
  drawsFrom(slot: number | null): boolean {
    return (
      slot !== null &&
      this.context.selection.has(slot) &&
      (this.slotsFor('path').length > 0 || this.slotsFor('goal').length > 0)
    );
  }

  begin(draft: Draft): void {
    this.draft = draft;
    this.note = null;
    this.changed.emit();
  }

  /** Another point of a path or of a polygon. */
  extend(point: Point): void {
    const draft = this.draft;
    if (draft?.kind === 'path') draft.points = thinned([...draft.points, point]);
    else if (draft?.kind === 'outline')
      draft.points =
        draft.shape === 'polygon' ? [...draft.points, point] : [draft.points[0], point];
    this.changed.emit();
  }

  /** Asks for what is drawn. */
  async send(): Promise<void> {
    const draft = this.draft;
    if (draft === null) return;
    this.draft = null;
    this.changed.emit();
    if (draft.kind === 'goal') await this.sendGoal(draft.point, draft.yaw ?? undefined);
    else if (draft.kind === 'path') await this.sendPath(draft.points);
    else if (draft.kind === 'place') await this.sendPlace(draft.point, draft.yaw ?? undefined);
    else await this.add(draft.shape, draft.points);
  }

  private async sendGoal(point: Point, yaw?: number): Promise<void> {
    const slots = this.slotsFor('goal');
    if (slots.length === 0) return this.say(this.whyNot('goal'), false, point);
    const points =
      slots.length === 1
        ? [point]
        : spread(
            point,
            slots.map((slot) => radiusOf(this.context.model.robots[slot].shapes)),
          );
    await this.context.commands.goal(slots, points, yaw);
  }

  private async sendPath(points: Point[]): Promise<void> {
    if (points.length < 2) return;
    const along = this.slotsFor('path');
    const end = points[points.length - 1];
    // A program that takes only goals is sent to the end of the line.
    if (along.length === 0)
      return this.slotsFor('goal').length > 0
        ? this.sendGoal(end)
        : this.say(this.whyNot('path'), false, end);
    await this.context.commands.path(along, points);
  }

  private async sendPlace(point: Point, yaw?: number): Promise<void> {
    const slot = this.slotsFor('place').pop();
    if (slot === undefined) return this.say(this.whyNot('place'), false, point);
    await this.context.commands.place(slot, point, yaw);
  }

  private async add(shape: OutlineKind, points: Point[]): Promise<void> {
    const made = outlineOf(shape, points);
    if (made === null) return;
    const name = this.freeName(shape);
    const answer = await this.context.commands.ask({
      type: 'edit',
      do: 'add',
      name,
      pose: made.pose,
      ...asked(made),
    });
    this.say(answer.good ? `${name}: ${outlineText(made)}` : answer.text, answer.good, [
      made.pose[0],
      made.pose[1],
    ]);
  }

  private freeName(shape: OutlineKind): string {
    const names = new Set([...this.context.model.bodies.values()].map((body) => body.name));
    for (let i = 1; ; ++i) if (!names.has(`${shape}-${i}`)) return `${shape}-${i}`;
  }

  /** The obstacle with handles, where it is drawn now. */
  get chosen(): {body: Body; pose: readonly [number, number, number]} | null {
    const body = this.body === null ? undefined : this.context.model.bodies.get(this.body);
    return body === undefined ? null : {body, pose: this.moved ?? body.pose};
  }

  pickBody(id: number | null): void {
    this.body = id;
    this.moved = null;
    this.changed.emit();
  }

  /** While it is dragged or turned. */
  carry(pose: [number, number, number]): void {
    this.moved = pose;
    this.changed.emit();
  }

  async put(): Promise<void> {
    const {chosen} = this;
    if (chosen === null || this.moved === null) return;
    const answer = await this.context.commands.ask({
      type: 'edit',
      do: 'move',
      name: chosen.body.name,
      pose: this.moved,
    });
    this.moved = null;
    this.say(answer.good ? '' : answer.text, answer.good, [chosen.pose[0], chosen.pose[1]]);
  }

  async turn(by_rad: number): Promise<void> {
    const {chosen} = this;
    if (chosen === null) return;
    this.moved = [chosen.pose[0], chosen.pose[1], wrapped(chosen.pose[2] + by_rad)];
    await this.put();
  }

  async remove(): Promise<void> {
    const {chosen} = this;
    if (chosen === null) return;
    const answer = await this.context.commands.ask({
      type: 'edit',
      do: 'remove',
      name: chosen.body.name,
    });
    if (answer.good) this.body = null;
    this.say(answer.good ? '' : answer.text, answer.good, [chosen.pose[0], chosen.pose[1]]);
  }

  say(text: string, good: boolean, at: Point): void {
    const note = text === '' ? null : {text, good, at};
    this.note = note;
    this.changed.emit();
    if (note !== null) {
      setTimeout(() => {
        if (this.note !== note) return;
        this.note = null;
        this.changed.emit();
      }, kNote_ms);
    }
  }
}

function asked(outline: Outline): {disc: number} | {polygon: Point[]} {
  return outline.radius === undefined ? {polygon: outline.polygon ?? []} : {disc: outline.radius};
}

export function wrapped(angle: number): number {
  return Math.atan2(Math.sin(angle), Math.cos(angle));
}
