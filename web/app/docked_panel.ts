// SPDX-License-Identifier: Apache-2.0
import type {GroupPanelPartInitParameters, IContentRenderer} from 'dockview-core';
import type {PanelContext, PanelElement, PanelKind} from '../panel_api';

/** A panel in the dock: makes the element and gives it its context. Without a kind it is an empty
 * place. */
export class DockedPanel implements IContentRenderer {
  readonly element = document.createElement('div');

  constructor(
    private readonly kind: PanelKind | undefined,
    private readonly context: PanelContext,
  ) {
    this.element.style.height = '100%';
  }

  init(_parameters: GroupPanelPartInitParameters): void {
    if (this.kind !== undefined) this.fill(this.kind);
  }

  fill(kind: PanelKind): void {
    const panel = kind.make?.() ?? (document.createElement(kind.tag) as PanelElement);
    panel.context = this.context;
    this.element.replaceChildren(panel);
  }
}
