// SPDX-License-Identifier: Apache-2.0
import {Signal} from '../model/signal';
import {
  kPanelApi,
  type Component,
  type PanelContext,
  type PanelElement,
  type PanelKind,
} from '../panel_api';
import type {Component as Named} from '../protocol/messages';
import type {ComponentPanelFrame} from './component_panel';

let made = 0;

/** The module of a component: what it brings, or why it could not be loaded. */
export class LoadedComponent {
  version = '';
  error = '';
  readonly makers = new Map<string, () => PanelElement>();
  titles = new Map<string, string>();
  readonly changed = new Signal();
  private takeBack: (() => void) | void = undefined;
  private tries = 0;
  private readonly url: string;

  constructor(
    readonly name: string,
    url: string,
    private readonly context: PanelContext,
    private readonly fetch: (url: string) => Promise<unknown> = (from) =>
      import(/* @vite-ignore */ from),
  ) {
    this.url = new URL(url, document.baseURI).href;
  }

  /** Whether a text, such as a stack, names the module. */
  wrote(text: string): boolean {
    return text.includes(this.url);
  }

  /** Again it is another address, since a browser keeps modules. Never rejects. */
  async load(): Promise<void> {
    this.error = '';
    try {
      if (typeof this.takeBack === 'function') this.takeBack();
      this.takeBack = undefined;
      const module = (await this.fetch(
        this.tries++ === 0 ? this.url : `${this.url}?again=${this.tries}`,
      )) as {component?: Component};
      this.adopt(module.component);
    } catch (error) {
      this.error = error instanceof Error ? `${error.name}: ${error.message}` : String(error);
    }
    this.changed.emit();
  }

  private adopt(component: Component | undefined): void {
    if (component === undefined) throw new TypeError('the module does not export `component`');
    if (component.api !== kPanelApi)
      throw new TypeError(
        `it was made for interface ${component.api} of panels; this page has ${kPanelApi}`,
      );
    this.version = component.version;
    this.makers.clear();
    this.titles.clear();
    for (const panel of component.panels ?? []) {
      const tag = `rave-x-${++made}`;
      customElements.define(tag, class extends panel.element {});
      this.makers.set(panel.id, () => document.createElement(tag) as PanelElement);
      this.titles.set(panel.id, panel.title);
    }
    this.takeBack = component.extend?.(this.context);
  }

  /** Its panels, or where there are none because of an error, one that says so. */
  kinds(): PanelKind[] {
    const ids =
      this.titles.size > 0 ? [...this.titles] : this.error === '' ? [] : [[this.name, this.name]];
    return ids.map(([id, title]) => ({
      id: `${this.name}/${id}`,
      title,
      icon: 'layers',
      tag: 'rave-component',
      make: () => {
        const frame = document.createElement('rave-component') as ComponentPanelFrame;
        frame.loaded = this;
        frame.panelId = id;
        return frame;
      },
    }));
  }
}

/** Loads what the run brings along, each by itself: one that fails keeps none of the others. */
export async function loadComponents(
  named: readonly Named[],
  context: PanelContext,
): Promise<LoadedComponent[]> {
  await import('./component_panel');
  const all = named.map(({name, url}) => new LoadedComponent(name, url, context));
  await Promise.all(all.map((component) => component.load()));
  return all;
}
