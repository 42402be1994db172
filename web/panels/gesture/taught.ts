// SPDX-License-Identifier: Apache-2.0
import {evened, type Motion} from '../../gestures/motion';
import {Recogniser, type Template} from '../../gestures/recogniser';
import {readTemplates, writeTemplates} from '../../gestures/template_file';
import type {Kept} from '../../panel_api';
import {kGestureNames, type GestureName} from './meanings';
import {builtInStrokes} from './strokes';

const kKept = 'gestures';
/** Of one gesture and kind of motion; the oldest goes. */
const kMost = 20;
/** Enough to begin with. */
export const kEnough = 5;

/** The templates of the person at this page: those that come with it, and those that they taught,
 * which stay in this browser. */
export class Taught {
  private own: Template[] = [];
  private made: Recogniser | null = null;
  /** What is wrong with what was kept; it is left out then. */
  error = '';

  constructor(private readonly kept: Kept) {
    this.load();
  }

  /** Another person is at the page. */
  load(): void {
    const text = this.kept.read(kKept);
    const file = typeof text === 'string' ? readTemplates(text, kGestureNames) : {templates: []};
    this.own = 'error' in file ? [] : file.templates;
    this.error = 'error' in file ? `Your gestures cannot be read: ${file.error}` : '';
    this.made = null;
  }

  get recogniser(): Recogniser {
    this.made ??= new Recogniser([...builtInStrokes(), ...this.own]);
    return this.made;
  }

  /** Adds a performance; false if it is none. */
  teach(gesture: GestureName, motion: Motion): boolean {
    const points = evened(motion);
    if (points === null) return false;
    const axes = points[0].length;
    const alike = this.own.filter(
      (one) => one.gesture === gesture && one.points[0].length === axes,
    );
    const oldest = alike.length >= kMost ? alike[0] : null;
    this.keep([...this.own.filter((one) => one !== oldest), {gesture, points}]);
    return true;
  }

  forget(gesture: GestureName): void {
    this.keep(this.own.filter((one) => one.gesture !== gesture));
  }

  count(gesture: GestureName): number {
    return this.own.filter((one) => one.gesture === gesture).length;
  }

  private keep(own: Template[]): void {
    this.own = own;
    this.made = null;
    this.error = '';
    this.kept.write(kKept, writeTemplates(own));
  }
}
