// SPDX-License-Identifier: Apache-2.0
import type {SerializedDockview} from 'dockview-core';

/** Where a window of panels stood, in pixels of the screen. */
export interface WindowBox {
  left: number;
  top: number;
  width: number;
  height: number;
}

/** Panels that were in a window of their own. */
export interface KeptWindow {
  panels: string[];
  box: WindowBox | null;
}

interface Leaf {
  type: string;
  data: Leaf[] | {id: string; views: string[]; activeView?: string};
  visible?: boolean;
}

function leavesOf(node: Leaf): Leaf[] {
  return Array.isArray(node.data) ? node.data.flatMap(leavesOf) : [node];
}

/** The layout with all panels in the page, and apart from that which of them had windows: a browser
 * opens none unless the person presses something, so a page cannot begin with them. */
export function bringHome(layout: SerializedDockview): {
  layout: SerializedDockview;
  windows: KeptWindow[];
} {
  const home = JSON.parse(JSON.stringify(layout)) as SerializedDockview;
  const windows: KeptWindow[] = [];
  const leaves = leavesOf(home.grid.root as unknown as Leaf);
  for (const {data, gridReferenceGroup, position} of home.popoutGroups ?? []) {
    windows.push({panels: [...data.views], box: position});
    const leaf =
      leaves.find((known) => (known.data as {id: string}).id === gridReferenceGroup) ?? leaves[0];
    if (leaf === undefined) continue;
    const group = leaf.data as {views: string[]; activeView?: string};
    group.views.push(...data.views.filter((id) => !group.views.includes(id)));
    group.activeView ??= data.activeView;
    delete leaf.visible;
  }
  delete home.popoutGroups;
  if (
    home.activeGroup !== undefined &&
    !leaves.some((leaf) => (leaf.data as {id: string}).id === home.activeGroup)
  )
    delete home.activeGroup;
  return {layout: home, windows};
}
