// SPDX-License-Identifier: Apache-2.0
import type {DockviewGroupPanel, IGroupHeaderProps, IHeaderActionsRenderer} from 'dockview-core';
import {html, nothing, render} from 'lit';
import {icon, type IconName} from '../ui/icons';

/** At the right of the tabs: a window of its own for the panel, one panel over the whole dock, and
 * back. */
export class HeaderActions implements IHeaderActionsRenderer {
  readonly element = document.createElement('div');
  private readonly ends: {dispose(): void}[] = [];

  constructor(
    private readonly group: DockviewGroupPanel,
    private readonly moveOut: (panel: string) => void,
  ) {}

  init({api, containerApi}: IGroupHeaderProps): void {
    this.element.className = 'group-buttons';
    const show = () => this.show(api);
    this.ends.push(containerApi.onDidMaximizedGroupChange(show), api.onDidLocationChange(show));
    show();
  }

  private show(api: IGroupHeaderProps['api']): void {
    const {location} = api;
    const button = (name: IconName, text: string, act: () => void) =>
      html`<button class=${name} title=${text} aria-label=${text} @click=${act}>
        ${icon(name, 14)}
      </button>`;
    const out = () => {
      const panel = this.group.activePanel;
      if (panel) this.moveOut(panel.id);
    };
    render(
      location.type === 'popout'
        ? button('undo', 'Back into the page', () => location.getWindow().close())
        : html`${location.type === 'grid' && !api.isMaximized()
            ? button('appWindow', 'Open in a new window', out)
            : nothing}
          ${api.isMaximized()
            ? button('minimize2', 'Restore', () => api.exitMaximized())
            : button('maximize2', 'Maximise', () => api.maximize())}`,
      this.element,
    );
  }

  dispose(): void {
    for (const end of this.ends) end.dispose();
  }
}
