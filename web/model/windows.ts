// SPDX-License-Identifier: Apache-2.0
import {Signal} from './signal';

/** The windows that show the page: its own, and those that panels were moved to. All share one
 * model and one thread. */
export class Windows {
  /** A window was added or removed, hidden, or shown again. */
  readonly changed = new Signal();
  /** A window lost the keyboard focus, is hidden or was closed: stop what a held key or button does
   * there. */
  readonly left = new Signal();
  private readonly windows: Window[] = [];

  constructor(page: Window = window) {
    this.add(page);
  }

  get all(): readonly Window[] {
    return this.windows;
  }

  /** A window that is not hidden; undefined if there is none. */
  get visible(): Window | undefined {
    return this.windows.find((known) => known.document.visibilityState !== 'hidden');
  }

  /** Adds a window; returns a function that removes it. */
  add(view: Window): () => void {
    const left = () => this.left.emit();
    const shown = () => {
      if (view.document.visibilityState === 'hidden') left();
      this.changed.emit();
    };
    view.addEventListener('blur', left);
    view.addEventListener('pagehide', left);
    view.document.addEventListener('visibilitychange', shown);
    this.windows.push(view);
    this.changed.emit();
    return () => {
      view.removeEventListener('blur', left);
      view.removeEventListener('pagehide', left);
      view.document.removeEventListener('visibilitychange', shown);
      this.windows.splice(this.windows.indexOf(view), 1);
      left();
      this.changed.emit();
    };
  }
}

/** The window that shows `node`. Browsers draw each window by itself: what is drawn waits for the
 * picture of its own. */
export function viewOf(node: Node): Window {
  return node.ownerDocument?.defaultView ?? window;
}
