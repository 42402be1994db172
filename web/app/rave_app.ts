// SPDX-License-Identifier: Apache-2.0
import {LitElement, html, nothing, type TemplateResult} from 'lit';
import {Commands} from '../model/commands';
import {DirectLines} from '../model/direct_lines';
import {Link} from '../model/link';
import {RunModel} from '../model/run_model';
import type {PanelContext, PanelKind} from '../panel_api';
import {Kept} from '../panel_api/kept';
import {Palette} from '../panel_api/palette';
import {Selection} from '../panel_api/selection';
import {Windows} from '../model/windows';
import type {JoystickPanel} from '../panels/joystick/joystick_panel';
import type {SuperUserPanel} from '../panels/people/super_user_panel';
import type {WorldPanel} from '../panels/world/world_panel';
import {renderAway} from './away_strip';
import {Dock, type LayoutName} from './dock';
import './find_box';
import './foxglove_sheet';
import './trust_sheet';
import {icon} from '../ui/icons';
import {keySheetStyles, renderKeys} from './key_sheet';
import {userKey} from '../panel_api/kept_keys';
import {KeptSelection} from './kept_selection';
import {bindKeys, type KeyAction} from './keys';
import {readMoment, writeMoment} from './moment_link';
import {addPanelKind, allPanels, panelsFor} from './panels';
import {pageKeys} from './page_keys';
import {Phone, phoneStyles} from './phone';
import {
  renderLost,
  renderNoRun,
  renderOpening,
  renderRefused,
  renderSeenBy,
  renderWaits,
  stateStyles,
} from './page_states';
import type {RunBar} from './run_bar';
import {controls} from '../ui/styles';
import './start_page';
import './top_bar';
import {pageStyles} from './page_styles';

/** From this width on there are layouts to choose from. */
const kLayouts_px = 700;
const kTheme = 'rave.theme';

/** The whole page. */
export class RaveApp extends LitElement {
  private readonly model = new RunModel();
  private readonly windows = new Windows();
  private readonly link = new Link(
    this.model,
    socketUrl(),
    new DirectLines(new URL('ticket', document.baseURI).href),
    this.windows,
  );
  private readonly selection = new Selection();
  private readonly keptSelection = new KeptSelection(this.model, this.selection);
  private readonly palette = new Palette(document.documentElement);
  private dock: Dock | null = null;
  private readonly commands = new Commands(this.model, this.link);
  private readonly phone = new Phone({
    context: () => this.context,
    update: () => this.requestUpdate(),
    world: () => this.world,
    joystick: () => this.joystick,
    kind: (id) => this.kind(id),
  });
  /** Addresses of components that were loaded. */
  private readonly brought = new Set<string>();
  /** Components that are on their way. */
  private bringing = 0;
  private finding = false;
  private showingKeys = false;
  private showingFoxglove = false;
  private showingTrust = false;
  /** The link that opened the page was followed. */
  private arrived = false;
  /** What the server refused last, in its words. */
  private refusal = '';

  private readonly context: PanelContext = {
    model: this.model,
    link: this.link,
    selection: this.selection,
    palette: this.palette,
    commands: this.commands,
    windows: this.windows,
    kept: new Kept(),
    worldLayers: new Set(),
    seek: (time_s) => {
      if (this.model.may('seek')) this.link.send({type: 'transport', do: 'seek', value: time_s});
    },
    show: (panel) => this.showPanel(panel),
    copyLink: () => writeMoment(this.model, this.selection, this.world),
  };

  override connectedCallback(): void {
    super.connectedCallback();
    // That of the last user, until the present one is known.
    const kept = localStorage.getItem(kTheme);
    const light =
      kept === null ? matchMedia('(prefers-color-scheme: light)').matches : kept === 'light';
    this.palette.set(light ? 'light' : 'dark');
    this.model.runChanged.on(() => {
      const own = localStorage.getItem(userKey('theme', this.model.user));
      if ((own === 'light' || own === 'dark') && own !== this.palette.theme) this.palette.set(own);
    });
    if (matchMedia('(prefers-contrast: more)').matches)
      document.documentElement.dataset['contrast'] = 'more';
    this.listen();
    bindKeys(() => this.actions());
    this.link.open();
    // A lost link counts its seconds.
    setInterval(() => {
      if (this.link.state === 'lost') this.requestUpdate();
    }, 250);
  }

  private listen(): void {
    const {model} = this;
    const update = () => this.requestUpdate();
    for (const signal of [
      model.runChanged,
      model.timeChanged,
      model.hostsChanged,
      this.link.changed,
    ])
      signal.on(update);
    model.rosterChanged.on(() => {
      // In this order: an address names robots, and the selection must know them.
      this.palette.assign(model.robots);
      this.selection.adopt(model.robots.map((robot) => robot.name));
      this.arrive();
      this.keptSelection.restore();
      this.retitle();
    });
    // A direct line bypasses the rights that the server applies, so not while looking as another
    // user.
    model.runChanged.on(() =>
      this.link.direct?.want(model.live && model.may('stop') && model.hello?.seen_by === undefined),
    );
    model.runChanged.on(() => void this.bringComponents());
    model.answered.on((answer) => {
      // What has a number is answered where it was asked.
      if (answer.request !== undefined) return;
      this.refusal = answer.good ? '' : answer.text;
      update();
    });
    this.windows.changed.on(() => this.link.queueLook());
    this.addEventListener('tool', () => this.phone.toolChosen());
    model.linesChanged.on(update);
    this.phone.listen(() => {
      // A phone has one panel and no dock; the dock is made anew where there is room again.
      this.dock?.close();
      this.dock = null;
      update();
    });
  }

  /** Loads the panels that the run brings along; once, since a module stays. */
  private async bringComponents(): Promise<void> {
    if (this.model.hello === null) return;
    const named = (this.model.hello.components ?? []).filter(({url}) => !this.brought.has(url));
    // Before the first await: a second call meanwhile must not load them again.
    for (const {url} of named) this.brought.add(url);
    this.bringing += named.length;
    if (named.length > 0) {
      // A chunk of its own, which most runs never need.
      const {loadComponents} = await import('./component_loader');
      for (const component of await loadComponents(named, this.context)) {
        for (const kind of component.kinds()) {
          addPanelKind(kind);
          this.dock?.offer(kind.id);
        }
      }
    }
    this.bringing -= named.length;
    if (this.bringing === 0) this.dock?.closeEmpty();
    this.requestUpdate();
  }

  /** Goes to the moment, the robot and the camera that the address names; once. */
  private arrive(): void {
    if (this.arrived) return;
    this.arrived = true;
    readMoment(this.context, () => this.world);
  }

  override updated(): void {
    const host = this.renderRoot.querySelector<HTMLElement>('.dock');
    if (host && this.dock === null) this.openDock(host);
    if (this.phone.is) this.context.kept.belongTo(this.model.user, '');
    if (this.model.user !== '') this.dock?.belongTo(this.model.user);
    this.querySelector(':scope > .dock-host')?.classList.toggle('old', this.link.state === 'lost');
    this.retitle();
    const phone = this.renderRoot.querySelector<HTMLElement>('.phone');
    if (phone) this.phone.fill(phone);
  }

  private openDock(place: HTMLElement): void {
    const keys = (there: Document) => bindKeys(() => this.actions(), there);
    this.dock = new Dock(this.dockHost(place), allPanels, this.context, keys);
    this.dock.changed.on(() => this.requestUpdate());
    if (this.model.hello !== null && this.bringing === 0) this.dock.closeEmpty();
    if (this.dock.away.length > 0) this.requestUpdate();
  }

  /** The dock stands in the page itself, where its style sheet is, and shows through a slot. */
  private dockHost(place: HTMLElement): HTMLElement {
    for (const old of this.querySelectorAll(':scope > .dock-host')) old.remove();
    const host = document.createElement('div');
    host.className = 'dock-host';
    host.slot = 'dock';
    host.style.height = '100%';
    place.hidden = false;
    this.append(host);
    return host;
  }

  private kind(id: string): PanelKind {
    return allPanels().find((kind) => kind.id === id) ?? allPanels()[0];
  }

  private retitle(): void {
    const titles = new Map(
      allPanels().map((kind) => {
        const count = kind.count?.(this.context);
        return [kind.id, count ? `${kind.title}  ${count}` : kind.title];
      }),
    );
    this.dock?.retitle(titles);
  }

  private showPanel(id: string): void {
    if (this.phone.is) this.phone.show(id);
    else this.dock?.show(id);
  }

  /** The list of people, which is a part of the panel of super-users. */
  private showPeople(): void {
    this.showPanel('rights');
    void this.updateComplete.then(() =>
      this.panel<SuperUserPanel>('rave-super-user')?.choose('people'),
    );
  }

  private get world(): WorldPanel | null {
    return this.panel<WorldPanel>('rave-world');
  }

  /** A panel, in whichever window it is. */
  private panel<T extends Element>(tag: string): T | null {
    for (const {document: there} of this.windows.all) {
      const found = there.querySelector<T>(tag);
      if (found !== null) return found;
    }
    return this.renderRoot.querySelector<T>(tag);
  }

  private get bar(): RunBar | null {
    return this.renderRoot.querySelector('rave-run-bar');
  }

  private actions(): KeyAction[] {
    return pageKeys({
      model: this.model,
      selection: this.selection,
      bar: () => this.bar,
      world: () => this.world,
      joystick: () => this.joystick,
      show: (panel) => this.showPanel(panel),
      find: () => this.open('finding'),
      list: () => this.open('showingKeys'),
      escape: () => this.escape(),
    });
  }

  private get joystick(): JoystickPanel | null {
    return this.panel<JoystickPanel>('rave-joystick');
  }

  private open(what: 'finding' | 'showingKeys' | 'showingFoxglove' | 'showingTrust'): void {
    this[what] = !this[what];
    // The keys may have been pressed in another window.
    if (this[what]) window.focus();
    this.requestUpdate();
  }

  private escape(): void {
    if (this.finding || this.showingKeys || this.showingFoxglove || this.showingTrust) {
      this.finding = false;
      this.showingFoxglove = false;
      this.showingTrust = false;
      this.showingKeys = false;
    } else if (this.world?.drop()) return;
    else if (this.phone.driving) this.phone.drive(false);
    else if (this.selection.following) this.selection.follow(false);
    else this.selection.set([]);
    this.requestUpdate();
  }

  private toggleTheme(): void {
    const theme = this.palette.theme === 'dark' ? 'light' : 'dark';
    localStorage.setItem(kTheme, theme);
    localStorage.setItem(userKey('theme', this.model.user), theme);
    this.palette.set(theme);
    this.requestUpdate();
  }

  override render(): TemplateResult {
    const {link, model} = this;
    if (link.state === 'refused') return renderRefused(link.refusal);
    if (link.state === 'empty') return renderNoRun();
    const old = link.state === 'lost';
    const none = model.hello?.run.source === 'none';
    return html` <rave-top-bar
        .context=${this.context}
        .layout=${none || this.phone.is || innerWidth < kLayouts_px
          ? ''
          : (this.dock?.name ?? 'Watch')}
        @layout=${(event: CustomEvent<LayoutName>) => {
          this.dock?.choose(event.detail);
          this.requestUpdate();
        }}
        @resetlayout=${() => {
          this.dock?.reset();
          this.requestUpdate();
        }}
        @find=${() => this.open('finding')}
        @theme=${() => this.toggleTheme()}
        @foxglove=${() => this.open('showingFoxglove')}
        @people=${() => this.showPeople()}
        @trust=${() => this.open('showingTrust')}></rave-top-bar>
      ${old ? renderLost(model, link) : renderWaits(model)}
      ${renderSeenBy(model, () => link.send({type: 'see_as'}))}
      ${this.refusal === ''
        ? nothing
        : html`<div class="strip refused" role="alert">
            ${icon('circleX', 16)}<span>${this.refusal}</span>
            <button
              @click=${() => {
                this.refusal = '';
                this.requestUpdate();
              }}>
              Close
            </button>
          </div>`}
      ${none ? html`<rave-start .context=${this.context}></rave-start>` : this.renderPanels(old)}
      ${this.renderSheets()}`;
  }

  /** The run, in panels. */
  private renderPanels(old: boolean): TemplateResult {
    return html`${renderAway(this.dock)}
      ${!this.model.rosterCame && !old ? renderOpening() : nothing}
      <main class=${old ? 'old' : ''}>
        ${this.phone.is
          ? this.phone.render()
          : html`<div class="dock"><slot name="dock"></slot></div>`}
      </main>
      ${this.phone.is
        ? this.phone.renderBars()
        : html`<rave-run-bar .context=${this.context}></rave-run-bar>`}`;
  }

  /** What lies over the page while it is open. */
  private renderSheets(): TemplateResult {
    return html`${this.finding
      ? html`<rave-find
          .context=${this.context}
          .panels=${panelsFor(this.model)}
          @theme=${() => this.toggleTheme()}
          @foxglove=${() => this.open('showingFoxglove')}
          @done=${() => this.open('finding')}></rave-find>`
      : nothing}
    ${this.showingFoxglove
      ? html`<rave-foxglove @done=${() => this.open('showingFoxglove')}></rave-foxglove>`
      : nothing}
    ${this.showingTrust
      ? html`<rave-trust
          .context=${this.context}
          @done=${() => this.open('showingTrust')}></rave-trust>`
      : nothing}
    ${this.showingKeys ? renderKeys(this.actions(), () => this.escape()) : nothing}`;
  }

  static override styles = [controls, stateStyles, keySheetStyles, phoneStyles, pageStyles];
}

function socketUrl(): string {
  const url = new URL('ws', document.baseURI);
  url.protocol = url.protocol === 'https:' ? 'wss:' : 'ws:';
  url.hash = '';
  return url.href;
}

customElements.define('rave-app', RaveApp);
