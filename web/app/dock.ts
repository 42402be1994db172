// SPDX-License-Identifier: Apache-2.0
import {DockviewComponent, type IContentRenderer, type GroupPanelPartInitParameters, type SerializedDockview} from 'dockview-core';
import {HeaderActions} from './header_actions';
import type {PanelContext, PanelElement, PanelKind} from '../panel_api';

/** Each class of widths has a layout of its own. */
const kKept = 'rave.layout';
/** Another number makes layouts that were kept void. */
const kVersion = 2;

export type LayoutName = 'Watch' | 'Drive' | 'Analyse' | 'Conduct';
export const kLayouts: readonly LayoutName[] = ['Watch', 'Drive', 'Analyse', 'Conduct'];

/** A panel in the dock: makes the element and gives it its context. */
class DockedPanel implements IContentRenderer {
  readonly element = document.createElement('div');

  constructor(private readonly kind: PanelKind, private readonly context: PanelContext) {
    this.element.style.height = '100%';
  }

  init(_parameters: GroupPanelPartInitParameters): void {
    const panel = this.kind.make?.() ?? (document.createElement(this.kind.tag) as PanelElement);
    panel.context = this.context;
    this.element.append(panel);
  }
}

/** The docked panels and their layout, which is kept in the browser. */
export class Dock {
  private readonly view: DockviewComponent;
  name: LayoutName = 'Watch';
  private restoring = false;
  private readonly kept: string;
  private readonly width = document.documentElement.clientWidth;

  constructor(host: HTMLElement, private readonly kinds: () => readonly PanelKind[], context: PanelContext) {
    this.view = new DockviewComponent(host, {
      theme: {name: 'rave', className: 'dockview-theme-rave', gap: 6},
      disableFloatingGroups: false,
      createRightHeaderActionComponent: () => new HeaderActions(),
      createComponent: (options) => {
        const kind = kinds().find((known) => known.id === options.name);
        if (kind === undefined) throw new Error(`unknown panel ${options.name}`); // Caught by restore().
        return new DockedPanel(kind, context);
      },
    });
    this.kept = `${kKept}.${this.width >= 1280 ? 'wide' : this.width >= 900 ? 'middle' : 'narrow'}`;
    if (!this.restore()) this.resetWhenSized(host);
    this.view.onDidLayoutChange(() => {
      if (!this.restoring) this.keep();
    });
  }

  /** Brings a panel to the front; makes it if it was closed. */
  show(id: string): void {
    const panel = this.view.panels.find((open) => open.id === id);
    if (panel) {
      panel.api.setActive();
      return;
    }
    const kind = this.kinds().find((known) => known.id === id);
    const beside = this.view.panels.find((open) => open.id === kind?.beside);
    if (kind) this.add(id, beside && {referencePanel: beside.id, direction: 'within'});
  }

  /** A panel that came while the page was open, beside the Sensor Display; not where it was closed or kept. */
  offer(id: string): void {
    if (this.view.panels.some((panel) => panel.id === id)) return;
    const beside = this.view.panels.find((panel) => panel.id === 'sensors' || panel.id === 'robot')?.id;
    this.add(id, beside === undefined ? undefined : {referencePanel: beside, direction: 'within'}, {inactive: true});
  }

  /** Titles with their numbers, such as `Robots 16`. */
  retitle(titles: ReadonlyMap<string, string>): void {
    this.restoring = true;
    for (const panel of this.view.panels) {
      const title = titles.get(panel.id);
      if (title !== undefined && title !== panel.title) panel.api.setTitle(title);
    }
    this.restoring = false;
  }

  /** Lays the panels out anew. */
  reset(layout: LayoutName = this.name): void {
    this.name = layout;
    this.restoring = true;
    this.view.clear();
    this.add('world');
    if (this.width >= 1280) this.layOutWide(layout);
    else if (this.width >= 900) {
      this.add('robots', {referencePanel: 'world', direction: 'right'}, {initialWidth: Math.round(0.38 * this.width)});
      this.add('hosts', {referencePanel: 'robots', direction: 'within'});
      this.add('sensors', {referencePanel: 'robots', direction: 'below'});
      this.add('log', {referencePanel: 'sensors', direction: 'within'});
    } else {
      this.add('robots', {referencePanel: 'world', direction: 'below'});
      for (const id of ['sensors', 'log', 'hosts']) this.add(id, {referencePanel: 'robots', direction: 'within'});
    }
    for (const id of layout === 'Drive' ? ['robots', 'joystick', 'world'] : this.width >= 900 ? ['sensors', 'robots', 'world'] : ['robots', 'world']) this.show(id);
    this.restoring = false;
    this.keep();
  }

  /** Watch: the world in the middle. Drive: the robot at the left, stick and chat at the right. Analyse: sensors and log have the room. Conduct: rights are at hand. */
  private layOutWide(layout: LayoutName): void {
    if (layout === 'Watch') {
      this.add('robots', {referencePanel: 'world', direction: 'left'}, {initialWidth: 292});
      this.add('sensors', {referencePanel: 'world', direction: 'right'}, {initialWidth: 392});
      this.add('log', {referencePanel: 'sensors', direction: 'below'}, {initialHeight: 340});
    } else if (layout === 'Drive') {
      this.add('robots', {referencePanel: 'world', direction: 'left'}, {initialWidth: 304});
      this.add('robot', {referencePanel: 'robots', direction: 'below'}, {initialHeight: 420});
      this.add('joystick', {referencePanel: 'world', direction: 'right'}, {initialWidth: 376});
      this.add('chat', {referencePanel: 'joystick', direction: 'below'}, {initialHeight: 360});
      this.add('log', {referencePanel: 'chat', direction: 'within'});
      this.add('sensors', {referencePanel: 'robot', direction: 'within'});
      this.show('robot');
      this.show('chat');
    } else if (layout === 'Conduct') {
      this.add('robots', {referencePanel: 'world', direction: 'right'}, {initialWidth: 392});
      this.add('log', {referencePanel: 'robots', direction: 'below'}, {initialHeight: 340});
      this.add('sensors', {referencePanel: 'log', direction: 'within'});
      this.add('rights', {referencePanel: 'world', direction: 'above'}, {initialHeight: 380});
    } else {
      this.add('sensors', {referencePanel: 'world', direction: 'right'}, {initialWidth: Math.round(0.45 * this.width)});
      this.add('log', {referencePanel: 'sensors', direction: 'below'}, {initialHeight: 280});
      this.add('robots', {referencePanel: 'world', direction: 'below'});
    }
    this.add('hosts', {referencePanel: 'robots', direction: 'within'});
    this.add('map', {referencePanel: 'sensors', direction: 'within'}, {inactive: true});
  }

  private add(id: string, position?: object, size?: object): void {
    const title = this.kinds().find((kind) => kind.id === id)?.title ?? id;
    this.view.addPanel({id, component: id, title, ...(position ? {position} : {}), ...size} as never);
  }

  private keep(): void {
    localStorage.setItem(this.kept, JSON.stringify({version: kVersion, name: this.name, layout: this.view.toJSON()}));
  }

  /** Columns can be given a width only once the dock has its own. */
  private resetWhenSized(host: HTMLElement): void {
    const watch = new ResizeObserver(() => {
      if (host.clientWidth < 100) return;
      watch.disconnect();
      this.view.layout(host.clientWidth, host.clientHeight);
      this.reset();
    });
    watch.observe(host);
  }

  private restore(): boolean {
    try {
      const kept = JSON.parse(localStorage.getItem(this.kept) ?? 'null') as {version: number; name?: LayoutName; layout: SerializedDockview} | null;
      if (kept?.version === kVersion) {
        this.name = kept.name ?? 'Watch';
        this.view.fromJSON(kept.layout);
        return true;
      }
    } catch {
      // A layout of another version: the one that comes with the page is better than none.
    }
    return false;
  }
}
