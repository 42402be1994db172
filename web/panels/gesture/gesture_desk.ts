// SPDX-License-Identifier: Apache-2.0
import type {Motion} from '../../gestures/motion';
import {Signal} from '../../model/signal';
import type {PanelContext} from '../../panel_api';
import type {Point} from '../../protocol/messages';
import {kGestures, propose, type GestureName, type Proposal, type Scene} from './meanings';
import {kEnough, Taught} from './taught';

/** From a motion of the hand to what is sent: nothing is, until the person says so, but for a stop
 * of all. */
export class GestureDesk {
  /** What the last motion may mean, one or two; empty if there was none. */
  proposals: readonly Proposal[] = [];
  /** What happened, in words. */
  note = '';
  /** The gesture that is being taught; null: motions are commands. */
  teaching: GestureName | null = null;
  readonly taught: Taught;
  readonly changed = new Signal();

  constructor(private readonly context: PanelContext) {
    this.taught = new Taught(context.kept);
    this.note = this.taught.error;
  }

  /** A motion was made: a stroke over the world, or one of the phone with an empty stroke. */
  take(motion: Motion, scene: Scene): void {
    this.proposals = [];
    if (this.teaching !== null) this.teach(this.teaching, motion);
    else this.read(motion, scene);
    this.changed.emit();
  }

  private teach(gesture: GestureName, motion: Motion): void {
    const {means} = kGestures[gesture];
    if (!this.taught.teach(gesture, motion)) {
      this.note = 'That was too short. Do it again.';
      return;
    }
    const count = this.taught.count(gesture);
    this.note =
      count < kEnough
        ? `"${means}": ${count} of ${kEnough}. Do it again.`
        : `"${means}" is taught, ${count} times.`;
  }

  private read(motion: Motion, scene: Scene): void {
    const reading = this.taught.recogniser.read(motion);
    if (reading === null || reading.first === '') {
      this.note =
        reading === null
          ? 'That was too short. Do it again.'
          : 'No motion of the phone was taught yet: choose Teach.';
      return;
    }
    if (reading.verdict === 'none') {
      this.note = 'None of your gestures. Do it again.';
      return;
    }
    this.note = '';
    if (reading.first === 'stop') {
      this.send(propose('stop', scene));
      return;
    }
    const names = reading.verdict === 'sure' ? [reading.first] : [reading.first, reading.second];
    this.proposals = names.map((name) => propose(name as GestureName, scene));
  }

  /** Sends what was proposed. */
  send(proposal: Proposal): void {
    const {link, commands} = this.context;
    this.proposals = [];
    if (proposal.why !== '') this.note = proposal.why;
    else if (proposal.gesture === 'stop' || proposal.gesture === 'release') {
      link.send({type: 'halt', do: proposal.gesture, slots: []});
      this.note = `${proposal.title}: sent.`;
    } else {
      this.note = `${proposal.title}: sent to ${proposal.slots.length}.`;
      void commands.goal(proposal.slots, [...proposal.points]).then((answer) => {
        if (answer.good) return;
        this.note = answer.text;
        this.changed.emit();
      });
    }
    this.changed.emit();
  }

  /** Drops what was proposed. */
  drop(): void {
    if (this.proposals.length > 0) this.note = 'Nothing was sent.';
    this.proposals = [];
    this.changed.emit();
  }

  /** Begins to teach a gesture, or ends it. */
  choose(gesture: GestureName | null): void {
    this.teaching = gesture;
    this.proposals = [];
    this.note =
      gesture === null
        ? ''
        : `Hold the key and make the gesture for "${kGestures[gesture].means}" ${kEnough} times.`;
    this.changed.emit();
  }

  forget(gesture: GestureName): void {
    this.taught.forget(gesture);
    this.note = `"${kGestures[gesture].means}" is as it came with the page.`;
    this.changed.emit();
  }

  /** The stroke in the world, in metres, and who is there. */
  sceneOf(stroke: readonly Point[], middle: Point, placed: PlacedRobots): Scene {
    const {model, selection} = this.context;
    return {
      members: model.robots.map(({name, shapes}, slot) => ({
        slot,
        name,
        at: [placed.x[slot], placed.y[slot]],
        yaw: placed.yaw[slot],
        radius: placed.radiusOf(shapes),
        obeys: model.whyNotTaken(slot, 'goal') === '' && Number.isFinite(placed.x[slot]),
      })),
      selected: selection.slots,
      stroke,
      middle,
      mayRelease: model.may('release'),
    };
  }
}

/** Where robots are drawn. */
export interface PlacedRobots {
  x: ArrayLike<number>;
  y: ArrayLike<number>;
  yaw: ArrayLike<number>;
  radiusOf: typeof import('../world/outlines').radiusOf;
}
