// SPDX-License-Identifier: Apache-2.0
import type {RunModel} from '../model/run_model';
import type {PanelContext, Selection} from '../panel_api';
import {nowOf} from '../model/moment';

/** A view that can say and take where it looks from. */
export interface Viewpoint {
  viewpoint(): string;
  lookFrom(text: string): void;
}

/** Puts moment, robot and camera into the address, and the address onto the clipboard. */
export function writeMoment(model: RunModel, selection: Selection, view: Viewpoint | null): void {
  const url = new URL(location.href);
  const parts = new URLSearchParams({t: nowOf(model).toFixed(2)});
  const primary = selection.primary;
  if (primary !== null) parts.set('robot', model.robots[primary].name);
  if (view !== null) parts.set('view', view.viewpoint());
  url.hash = parts.toString().replaceAll('%2C', ',');
  history.replaceState(null, '', url);
  void navigator.clipboard?.writeText(url.href);
}

/** Goes to what the address names. `view` is asked once the page has laid itself out. */
export function readMoment(context: PanelContext, view: () => Viewpoint | null): void {
  const parts = new URLSearchParams(location.hash.slice(1));
  const t = Number(parts.get('t') ?? NaN);
  if (Number.isFinite(t)) context.seek(t);
  const slot = context.model.robots.findIndex((robot) => robot.name === parts.get('robot'));
  if (slot >= 0) context.selection.set([slot]);
  const look = parts.get('view');
  if (look !== null) requestAnimationFrame(() => view()?.lookFrom(look));
}
