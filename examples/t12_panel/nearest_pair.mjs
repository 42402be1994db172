// SPDX-License-Identifier: Apache-2.0
// A panel of the page: the two robots that are nearest to each other. Made from the template of `rave new panel`.

const KNOWN = 1;

/** The two nearest robots and the distance of their origins; null if fewer than two have a pose. `model` is that of the page. */
export function nearestPair(model) {
  const frame = model.poses.newest;
  if (frame === null) return null;
  const known = model.robots.map((_, slot) => slot).filter((slot) => frame.flags[slot] & KNOWN);
  let best = null;
  for (const [i, a] of known.entries()) {
    for (const b of known.slice(i + 1)) {
      const distance_m = Math.hypot(frame.x[a] - frame.x[b], frame.y[a] - frame.y[b]);
      if (best === null || distance_m < best.distance_m) best = {slots: [a, b], distance_m};
    }
  }
  return best;
}

// Tests run without a browser, which has no such class.
const Element = globalThis.HTMLElement ?? class {};

/** The element of the panel. The page sets `context` before it puts the element in its place. */
class NearestPair extends Element {
  connectedCallback() {
    this.style.cssText = 'display: block; padding: 8px 12px; background: var(--bg-1); color: var(--text-1)';
    this.button = this.ownerDocument.createElement('button');
    this.button.style.cssText = 'padding: 5px 0; border: 0; background: none; color: inherit; font: inherit; cursor: pointer';
    // A click selects both, so that the World View shows them.
    this.button.addEventListener('click', () => this.pair && this.context.selection.set(this.pair.slots));
    this.replaceChildren(this.button);
    this.timer = setInterval(() => this.show(), 250);
    this.show();
  }

  disconnectedCallback() {
    clearInterval(this.timer);
  }

  show() {
    const {model} = this.context;
    this.pair = nearestPair(model);
    this.button.textContent = this.pair
      ? `${this.pair.slots.map((slot) => model.robots[slot].name).join(' and ')}: ${this.pair.distance_m.toFixed(2)} m`
      : 'fewer than two robots have a pose';
  }
}

/** What the page asks a component for. `api` is the number of the interface that it was made for. */
export const component = {
  api: 1,
  name: 'nearest_pair',
  version: '0.1',
  panels: [{id: 'nearest_pair', title: 'Nearest pair', element: NearestPair}],
};
