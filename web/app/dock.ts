// SPDX-License-Identifier: Apache-2.0
import {DockviewComponent, type DockviewPanel, type SerializedDockview} from 'dockview-core';
import {Signal} from '../model/signal';
import type {PanelContext, PanelKind} from '../panel_api';
import {DockedPanel} from './docked_panel';
import {HeaderActions} from './header_actions';
import {layoutKey} from '../panel_api/kept_keys';
import {bringHome, type KeptWindow, type WindowBox} from './kept_layout';
import {PanelWindow} from './panel_window';

/** The user who was here last. */
const kUser = 'rave.user';
const kLeave_ms = 2000;
/** From this height on two panels find room in a column beside the stick. */
const kTall_px = 880;
/** Less would cut the stick, its pedals or the state of the line. */
const kStickRoom = {minimumWidth: 300, minimumHeight: 384};
/** Another number makes layouts that were kept void. */
const kVersion = 2;

export type LayoutName = 'Watch' | 'Drive' | 'Analyse' | 'Conduct';
export const kLayouts: readonly LayoutName[] = ['Watch', 'Drive', 'Analyse', 'Conduct'];

/** The docked panels and their layouts, which the browser keeps for each user. */
export class Dock {
  private readonly view: DockviewComponent;
  name: LayoutName = 'Watch';
  /** Windows that were open when the page was left last, until they are open again or the person
   * does without. */
  away: KeptWindow[] = [];
  /** `away` is another one. */
  readonly changed = new Signal();
  /** Places that a kept layout has for panels that are not known, or not yet: the run brings its
   * own along later. */
  private readonly empty = new Map<string, DockedPanel>();
  private restoring = false;
  /** The page goes, and its windows with it: that is no change of the layout. */
  private leaving = false;
  private user = localStorage.getItem(kUser) ?? '';
  private readonly width = document.documentElement.clientWidth;
  private readonly height = document.documentElement.clientHeight;

  constructor(
    host: HTMLElement,
    private readonly kinds: () => readonly PanelKind[],
    private readonly context: PanelContext,
    private readonly bindKeys: (document: Document) => void,
  ) {
    // Before the dock itself hears of it. A download says the same, and the page stays.
    window.addEventListener('beforeunload', () => {
      this.leaving = true;
      setTimeout(() => (this.leaving = false), kLeave_ms);
    });
    this.view = new DockviewComponent(host, {
      theme: {name: 'rave', className: 'dockview-theme-rave', gap: 6},
      disableFloatingGroups: false,
      createRightHeaderActionComponent: (group) =>
        new HeaderActions(group, (panel) => void this.moveOut(panel)),
      createComponent: (options) => {
        const kind = kinds().find((known) => known.id === options.name);
        const docked = new DockedPanel(kind, context);
        if (kind === undefined) this.empty.set(options.id, docked);
        return docked;
      },
    });
    this.name = this.lastName();
    context.kept.belongTo(this.user, this.name);
    if (!this.restore()) this.resetWhenSized(host);
    this.view.onDidLayoutChange(() => {
      if (!this.restoring && !this.leaving) this.keep();
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

  /** Moves a panel to a window of its own, for another monitor. Stays where the browser opens
   * none. */
  async moveOut(id: string, box?: WindowBox): Promise<void> {
    const panel = this.view.panels.find((open) => open.id === id);
    const window = () =>
      panel?.api.location.type === 'popout' ? panel.api.location.getWindow() : null;
    if (panel === undefined || window() !== null) return;
    const opened = await this.view.addPopoutGroup(panel as DockviewPanel, {
      popoutUrl: new URL('assets/popout.html', document.baseURI).href,
      ...(box
        ? {position: new DOMRect(box.left - screenX, box.top - screenY, box.width, box.height)}
        : {}),
    });
    const view = window();
    if (!opened || view === null) return;
    const {group} = panel;
    const there = new PanelWindow(view, this.context, this.bindKeys);
    const entitle = () =>
      there.open &&
      there.entitle(this.kinds().find((kind) => kind.id === group.activePanel?.id)?.title ?? '');
    group.api.onDidActivePanelChange(entitle);
    this.context.model.runChanged.on(entitle);
    entitle();
  }

  /** Opens a window again that was open when the page was left. */
  async reopen(kept: KeptWindow): Promise<void> {
    this.away = this.away.filter((other) => other !== kept);
    this.changed.emit();
    const [first, ...others] = kept.panels.filter((id) =>
      this.view.panels.some((panel) => panel.id === id),
    );
    if (first === undefined) return;
    await this.moveOut(first, kept.box ?? undefined);
    const group = this.view.panels.find((panel) => panel.id === first)?.group;
    if (group?.api.location.type !== 'popout') return;
    for (const id of others) this.view.panels.find((panel) => panel.id === id)?.api.moveTo({group});
  }

  /** The panels of those windows stay in the page. */
  stay(): void {
    this.away = [];
    this.keep();
    this.changed.emit();
  }

  /** What the panels of a window are called. */
  titleOf({panels}: KeptWindow): string {
    return panels.map((id) => this.kinds().find((kind) => kind.id === id)?.title ?? id).join(', ');
  }

  /** Takes everything away, the windows too. */
  close(): void {
    this.leaving = true;
    this.view.dispose();
  }

  /** A panel that came while the page was open: in the place that was kept for it, otherwise beside
   * the Sensor Display. */
  offer(id: string): void {
    const kind = this.kinds().find((known) => known.id === id);
    if (kind !== undefined) this.empty.get(id)?.fill(kind);
    this.empty.delete(id);
    if (this.view.panels.some((panel) => panel.id === id)) return;
    const beside = this.view.panels.find(
      (panel) => panel.id === 'sensors' || panel.id === 'robot',
    )?.id;
    this.add(id, beside === undefined ? undefined : {referencePanel: beside, direction: 'within'}, {
      inactive: true,
    });
  }

  /** Everything that the run brings is here: what is still empty belongs to another run. */
  closeEmpty(): void {
    for (const id of this.empty.keys())
      this.view.panels.find((panel) => panel.id === id)?.api.close();
    this.empty.clear();
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

  /** Another layout, as the person has arranged it. */
  choose(layout: LayoutName): void {
    if (layout === this.name) return;
    this.name = layout;
    this.takeKept();
  }

  /** Lays the panels out anew: what the person has arranged in this layout goes. */
  reset(layout: LayoutName = this.name): void {
    this.name = layout;
    this.away = [];
    this.restoring = true;
    this.view.clear();
    this.empty.clear();
    this.add('world');
    if (this.width >= 1280) this.layOutWide(layout);
    else if (this.width >= 900) {
      this.layOutMiddle(layout);
    } else {
      const first = layout === 'Drive' ? 'joystick' : layout === 'Conduct' ? 'rights' : 'robots';
      this.add(first, {referencePanel: 'world', direction: 'below'});
      for (const id of ['robots', 'sensors', 'log', 'hosts'])
        if (id !== first)
          this.add(id, {referencePanel: first, direction: 'within'}, {inactive: true});
    }
    const first =
      layout === 'Drive'
        ? ['robots', 'joystick']
        : layout === 'Conduct'
          ? ['robots', 'rights']
          : this.width >= 900
            ? ['sensors', 'robots']
            : ['robots'];
    const alone = this.width < 900 && first.length > 1 ? first.slice(1) : first;
    for (const id of [...alone, 'world']) this.show(id);
    this.restoring = false;
    this.keep();
  }

  /** Watch: the world in the middle. Drive: the robot at the left, stick and chat at the right.
   * Analyse: sensors and log have the room. Conduct: rights are at hand. */
  private layOutWide(layout: LayoutName): void {
    if (layout === 'Watch') {
      this.add('robots', {referencePanel: 'world', direction: 'left'}, {initialWidth: 292});
      this.add('sensors', {referencePanel: 'world', direction: 'right'}, {initialWidth: 392});
      this.add('log', {referencePanel: 'sensors', direction: 'below'}, {initialHeight: 340});
    } else if (layout === 'Drive') {
      this.layOutDrive();
    } else if (layout === 'Conduct') {
      this.add('robots', {referencePanel: 'world', direction: 'right'}, {initialWidth: 392});
      for (const id of ['log', 'sensors'])
        this.add(id, {referencePanel: 'robots', direction: 'within'}, {inactive: true});
      // Over the whole width, which the classes of rights need.
      this.add('rights', {direction: 'above'}, {initialHeight: this.height < kTall_px ? 300 : 400});
    } else {
      this.add(
        'sensors',
        {referencePanel: 'world', direction: 'right'},
        {initialWidth: Math.round(0.45 * this.width)},
      );
      this.add('log', {referencePanel: 'sensors', direction: 'below'}, {initialHeight: 280});
      this.add('robots', {referencePanel: 'world', direction: 'below'});
    }
    this.add(
      'hosts',
      {
        referencePanel: layout === 'Drive' && this.height < kTall_px ? 'world' : 'robots',
        direction: 'within',
      },
      {inactive: true},
    );
    this.add('map', {referencePanel: 'sensors', direction: 'within'}, {inactive: true});
  }

  /** On a laptop the stick has its column for itself, and what belongs to the robot lies behind
   * it. */
  private layOutDrive(): void {
    const tall = this.height >= kTall_px;
    this.add(
      'robots',
      {referencePanel: 'world', direction: 'left'},
      {initialWidth: tall ? 304 : 220},
    );
    this.add(
      'joystick',
      {referencePanel: 'world', direction: 'right'},
      {initialWidth: tall ? 376 : 350},
    );
    if (tall) {
      this.add('robot', {referencePanel: 'robots', direction: 'below'}, {initialHeight: 420});
      this.add('chat', {referencePanel: 'joystick', direction: 'below'}, {initialHeight: 340});
      this.add('log', {referencePanel: 'chat', direction: 'within'});
      this.add('sensors', {referencePanel: 'robot', direction: 'within'});
      this.show('robot');
      this.show('chat');
      return;
    }
    for (const id of ['robot', 'chat'])
      this.add(id, {referencePanel: 'joystick', direction: 'within'}, {inactive: true});
    for (const id of ['sensors', 'log'])
      this.add(id, {referencePanel: 'world', direction: 'within'}, {inactive: true});
  }

  /** Two columns. */
  private layOutMiddle(layout: LayoutName): void {
    const right = layout === 'Drive' ? 'joystick' : 'robots';
    this.add(
      right,
      {referencePanel: 'world', direction: 'right'},
      {initialWidth: Math.round(0.38 * this.width)},
    );
    if (layout === 'Drive') {
      for (const id of ['robot', 'chat', 'log'])
        this.add(id, {referencePanel: 'joystick', direction: 'within'}, {inactive: true});
      this.add('robots', {referencePanel: 'world', direction: 'below'}, {initialHeight: 180});
      this.add('sensors', {referencePanel: 'robots', direction: 'within'}, {inactive: true});
    } else {
      this.add('sensors', {referencePanel: 'robots', direction: 'below'});
      this.add('log', {referencePanel: 'sensors', direction: 'within'}, {inactive: true});
    }
    this.add('hosts', {referencePanel: 'robots', direction: 'within'}, {inactive: true});
    if (layout === 'Conduct') this.add('rights', {direction: 'above'}, {initialHeight: 300});
  }

  private add(id: string, position?: object, size?: object): void {
    const title = this.kinds().find((kind) => kind.id === id)?.title ?? id;
    this.view.addPanel({
      id,
      component: id,
      title,
      ...(position ? {position} : {}),
      ...(id === 'joystick' ? kStickRoom : {}),
      ...size,
    } as never);
  }

  private keep(): void {
    // Until the user is known nothing is kept: it would belong to no user.
    if (this.user === '') return;
    const {layout, windows} = bringHome(this.view.toJSON());
    const about = this.about;
    localStorage.setItem(
      layoutKey(about, this.name),
      JSON.stringify({version: kVersion, layout, windows: [...windows, ...this.away]}),
    );
    localStorage.setItem(layoutKey(about), this.name);
  }

  /** Whose layouts these are, once the server has told who the user is: until then those of the
   * last one. */
  belongTo(user: string): void {
    if (user === this.user) return;
    this.user = user;
    localStorage.setItem(kUser, user);
    this.name = this.lastName();
    this.takeKept();
  }

  private get about(): {user: string; width_px: number} {
    return {user: this.user, width_px: this.width};
  }

  /** The kept arrangement of the present layout, or that which it has at first. */
  private takeKept(): void {
    this.context.kept.belongTo(this.user, this.name);
    this.away = [];
    this.empty.clear();
    this.restoring = true;
    const restored = this.restore();
    this.restoring = false;
    if (restored) this.keep();
    else this.reset();
    this.changed.emit();
  }

  /** The layout that the person had last. */
  private lastName(): LayoutName {
    const kept = localStorage.getItem(layoutKey(this.about)) as LayoutName;
    return kLayouts.includes(kept) ? kept : 'Watch';
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
      const kept = JSON.parse(localStorage.getItem(layoutKey(this.about, this.name)) ?? 'null') as {
        version: number;
        layout: SerializedDockview;
        windows?: KeptWindow[];
      } | null;
      if (kept?.version === kVersion) {
        // Of before the stick had it.
        if (kept.layout.panels['joystick'] !== undefined)
          Object.assign(kept.layout.panels['joystick'], kStickRoom);
        this.view.fromJSON(kept.layout);
        this.away = kept.windows ?? [];
        return true;
      }
    } catch {
      // A layout of another version: the one that comes with the page is better than none.
    }
    return false;
  }
}
