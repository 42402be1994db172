// SPDX-License-Identifier: Apache-2.0
import type {PanelContext, PanelElement} from './index';

/** Draws over the World View seen from above. `toScreen`: from metres to pixels of the picture. */
export type WorldLayer = (
  ctx: CanvasRenderingContext2D,
  toScreen: (x: number, y: number) => [number, number],
) => void;

/** A panel that a component brings along. */
export interface ComponentPanel {
  id: string;
  title: string;
  /** Class of the element. It is not defined as a custom element: the page does that, under a name
   * of its own. */
  element: new () => PanelElement;
}

/** What the module of a component exports as `component`. */
export interface Component {
  /** kPanelApi of the page that it was made for. */
  api: number;
  name: string;
  version: string;
  panels?: ComponentPanel[];
  /** Extends existing panels; returns a function that undoes it. */
  extend?(context: PanelContext): (() => void) | void;
}
