// SPDX-License-Identifier: Apache-2.0
import type {Stage} from './stage';

/** One press, pixels of the screen; with Ctrl a small one. */
const kStep_px = 48;
const kSmallStep_px = 6;
const kZoom = 1.25;
const kDirections: Readonly<Record<string, readonly [number, number]>> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, -1],
  ArrowDown: [0, 1],
};

/** What the focused picture does with its keys, for the sheet that `?` shows. */
export const kWorldKeys: readonly {keys: string[]; what: string}[] = [
  {keys: ['← ↑ → ↓'], what: 'move the focused picture, or the end of a measure'},
  {keys: ['Ctrl ← ↑ → ↓'], what: 'the same in small steps; turn in 3-D'},
  {keys: ['+', '−'], what: 'zoom the focused picture'},
  {keys: ['Shift drag'], what: 'select all robots in a box'},
];

/** Moves and zooms the picture that has the focus. False: the key means nothing to it. Shift and
 * arrows drive robots. */
export function pressWorldKey(event: KeyboardEvent, stage: Stage): boolean {
  // With Ctrl, plus and minus are of the browser.
  if (event.altKey || event.metaKey || (event.ctrlKey && !(event.key in kDirections))) return false;
  if (event.key === '+' || event.key === '=') stage.zoomBy(kZoom);
  else if (event.key === '-' || event.key === '_') stage.zoomBy(1 / kZoom);
  else if (event.key === 'Enter') return stage.mark?.() ?? false;
  else {
    const direction = kDirections[event.key];
    if (direction === undefined || event.shiftKey) return false;
    const step = event.ctrlKey ? kSmallStep_px : kStep_px;
    const [dx, dy] = [direction[0] * step, direction[1] * step];
    if (event.ctrlKey && stage.turn !== undefined)
      stage.turn(direction[0] * kStep_px, direction[1] * kStep_px);
    else stage.nudge(dx, dy);
  }
  return true;
}
