// SPDX-License-Identifier: Apache-2.0
import type {Placed} from '../../model/pose_history';
import type {PanelContext} from '../../panel_api';
import type {Layers} from './layers';
import type {OrderDesk} from './orders/order_desk';

/** `room`: robots, bodies, and the walls around them. `more`: that, and what was shown. `all`:
 * everything. `closer`: that too, or the selection where all of it is shown already. */
export type Extent = 'room' | 'more' | 'all' | 'closer';

/** `nothing`: there is nothing to show yet. */
export type Fitted = 'nothing' | 'all' | 'selection';

/** What a stage is given by the World View. */
export interface StageContext extends PanelContext {
  /** Where everybody is in the picture that is drawn. */
  readonly placed: Placed;
  /** True poses to mark beside those, empty if there are none. */
  readonly truth: Placed;
  layers(): Layers;
  /** Asks for another picture. */
  redraw(): void;
  /** What the person draws for robots and of obstacles. */
  readonly desk: OrderDesk;
  /** Opens the menu of what is at this place of the stage, pixels. */
  menu(px: number, py: number): void;
  /** The person moved the camera: it is not fitted again by itself. */
  moved(): void;
}

/** One way to look at the world: from above, or in perspective. */
export interface Stage {
  /** Fills the place of the World View. */
  readonly element: HTMLElement;
  /** The roster, the bodies or the theme changed. */
  refresh(): void;
  /** Draws; true as long as something moves by itself. */
  paint(now_ms: number): boolean;
  resize(width: number, height: number): void;
  /** Shows what is there, and says which. */
  fit(animate: boolean, what: Extent): Fitted;
  /** Where it looks from, as the address of the page says it. */
  viewpoint(): string;
  lookFrom(text: string): void;
  /** Drops what the person has begun; false if there was nothing. */
  drop(): boolean;
  /** At the keyboard: looks this number of pixels farther to the right and down. */
  nudge(dx: number, dy: number): void;
  /** Zooms about the middle. */
  zoomBy(factor: number): void;
  /** Goes about what it looks at. */
  turn?(dx: number, dy: number): void;
  /** Enter: begins a measure where the last one ends; false if nothing is measured. */
  mark?(): boolean;
  /** The picture with everything on it. */
  snapshot(): HTMLCanvasElement;
  /** Where a robot is on the screen, relative to the element. */
  screenOf(slot: number): [number, number];
  /** Where a place of the world is on the screen, relative to the element; null: this stage cannot
   * say. */
  screenAt?(x: number, y: number): [number, number];
  dispose(): void;
}
