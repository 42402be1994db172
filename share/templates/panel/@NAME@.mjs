// SPDX-License-Identifier: Apache-2.0
// A panel of the page: it shows how fast each robot goes. Plain JavaScript, which the page loads as it is.

/** The fastest robots first: what the panel shows, apart from how. `model` is that of the page. */
export function fastest(model, count = 8) {
  const speeds = model.poses.newest?.speed ?? [];
  return model.robots
    .map((robot, slot) => ({slot, name: robot.name, speed: Math.abs(speeds[slot] ?? 0)}))
    .sort((a, b) => b.speed - a.speed)
    .slice(0, count);
}

// Tests run without a browser, which has no such class.
const Element = globalThis.HTMLElement ?? class {};

/** The element of the panel. The page sets `context` before it puts the element in its place. */
class @CLASS@ extends Element {
  connectedCallback() {
    this.style.cssText = 'display: block; height: 100%; overflow: auto; padding: 8px 12px; background: var(--bg-1); color: var(--text-1)';
    this.timer = setInterval(() => this.show(), 250);
    this.show();
  }

  disconnectedCallback() {
    clearInterval(this.timer);
  }

  show() {
    const {model, selection} = this.context;
    const rows = fastest(model).map(({slot, name, speed}) => {
      const row = this.ownerDocument.createElement('button');
      row.textContent = `${name}  ${speed.toFixed(2)} m/s`;
      row.style.cssText = 'display: block; width: 100%; padding: 5px 0; border: 0; background: none; color: inherit; font: inherit; text-align: left; cursor: pointer';
      row.addEventListener('click', () => selection.set([slot]));
      return row;
    });
    this.replaceChildren(...rows);
  }
}

/** What the page asks a component for. `api` is the number of the interface that it was made for. */
export const component = {
  api: 1,
  name: '@NAME@',
  version: '0.1',
  panels: [{id: '@NAME@', title: '@TITLE@', element: @CLASS@}],
};
