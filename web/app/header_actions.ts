// SPDX-License-Identifier: Apache-2.0
import type {IGroupHeaderProps, IHeaderActionsRenderer} from 'dockview-core';
import {render} from 'lit';
import {icon} from './icons';

/** At the right of the tabs: one panel over the whole dock, and back. */
export class HeaderActions implements IHeaderActionsRenderer {
  readonly element = document.createElement('button');
  private readonly ends: {dispose(): void}[] = [];

  init({api, containerApi}: IGroupHeaderProps): void {
    this.element.className = 'maximise';
    this.element.addEventListener('click', () => {
      if (api.isMaximized()) api.exitMaximized();
      else api.maximize();
    });
    this.ends.push(containerApi.onDidMaximizedGroupChange(() => this.show(api.isMaximized())));
    this.show(false);
  }

  private show(maximised: boolean): void {
    const name = maximised ? 'Beside the others again' : 'Over all others';
    this.element.title = name;
    this.element.setAttribute('aria-label', name);
    render(icon(maximised ? 'minimize2' : 'maximize2', 14), this.element);
  }

  dispose(): void {
    for (const end of this.ends) end.dispose();
  }
}
