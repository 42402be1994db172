// SPDX-License-Identifier: Apache-2.0
// What a panel is given: all that a panel of a component has. The panels that come with RAVE are
// given the same, and are made and opened in the same way. They are compiled with the page, so they
// import its modules as well: those that the table in web/README.md allows. The page asks some of
// them for more than PanelElement, such as the World View for its keys; a component cannot take
// their place.
import type {Commands} from '../model/commands';
import type {Link} from '../model/link';
import type {RunModel} from '../model/run_model';
import type {Windows} from '../model/windows';
import type {Power} from '../protocol/messages';
import type {WorldLayer} from './component';
import type {Kept} from './kept';
import type {Palette} from './palette';
import type {Selection} from './selection';

export type {Component, ComponentPanel, WorldLayer} from './component';
export type {Kept} from './kept';
export type {Palette} from './palette';
export type {Selection} from './selection';
export type {Windows} from '../model/windows';

/** Number of this interface. A component says for which one it was made; another one is not
 * loaded. */
export const kPanelApi = 1;

/** What all panels share. Owned by the page; lives as long as it. */
export interface PanelContext {
  readonly model: RunModel;
  readonly link: Link;
  readonly selection: Selection;
  readonly palette: Palette;
  /** Orders, leases, parameters, obstacles and words, each with the answer of the run. */
  readonly commands: Commands;
  /** The windows that show the page: panels may be in windows of their own. */
  readonly windows: Windows;
  /** Values that panels keep in the browser for this user. */
  readonly kept: Kept;
  /** Functions of components that draw over the World View. A layer that throws is removed. */
  readonly worldLayers: Set<WorldLayer>;
  /** Moves the replay; does nothing where the time cannot be moved. */
  seek(time_s: number): void;
  /** Brings a panel to the front. */
  show(panel: string): void;
  /** Puts this moment and camera into the address and onto the clipboard. */
  copyLink(): void;
}

/** An element that shows a panel. `context` is set before the element is connected. */
export interface PanelElement extends HTMLElement {
  context: PanelContext;
}

/** A kind of panel. */
export interface PanelKind {
  id: string;
  title: string;
  icon: string;
  /** Name of its custom element. */
  tag: string;
  /** Makes the element of a kind whose tag several share. */
  make?(): PanelElement;
  /** Title of its tab on a phone; without it the panel has no tab there. */
  short?: string;
  /** Right that a user needs to see the panel. */
  needs?: Power;
  /** Panel beside which it is opened as another tab; if that is not open, beside the panel in
   * use. */
  beside?: string;
  /** Only for a run in progress; a replay does not show it. */
  live?: boolean;
  /** Number beside the title; none if undefined. */
  count?(context: PanelContext): number;
}
