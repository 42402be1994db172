// SPDX-License-Identifier: Apache-2.0
import {LitElement, css, html, nothing, type TemplateResult} from 'lit';
import {Link} from '../model/link';
import {RunModel} from '../model/run_model';
import type {PanelContext, PanelElement, PanelKind} from '../panel_api';
import {Palette} from '../panel_api/palette';
import {Selection} from '../panel_api/selection';
import type {WorldPanel} from '../panels/world/world_panel';
import {clockText} from './clock';
import {Dock} from './dock';
import './find_box';
import {icon, type IconName} from './icons';
import {bindKeys, type KeyAction} from './keys';
import type {RunBar} from './run_bar';
import {controls} from './styles';

const kPhone_px = 600;
const kTheme = 'rave.theme';

export const kPanels: readonly PanelKind[] = [
  {id: 'world', title: 'World View', icon: 'compass', tag: 'rave-world'},
  {id: 'robots', title: 'Robots', icon: 'bot', tag: 'rave-robots', count: ({model}) => model.robots.length},
  {id: 'sensors', title: 'Sensor Display', icon: 'radar', tag: 'rave-sensors'},
  {id: 'log', title: 'Log & alerts', icon: 'list', tag: 'rave-log'},
];

/** The whole page. */
export class RaveApp extends LitElement {
  private readonly model = new RunModel();
  private readonly link = new Link(this.model, socketUrl());
  private readonly selection = new Selection();
  private readonly palette = new Palette(document.documentElement);
  private dock: Dock | null = null;
  private phonePanel = 'world';
  private phone = matchMedia(`(max-width: ${kPhone_px - 1}px)`);
  private finding = false;
  private showingKeys = false;

  private readonly context: PanelContext = {
    model: this.model,
    link: this.link,
    selection: this.selection,
    palette: this.palette,
    seek: (time_s) => {
      if (this.model.may('seek')) this.link.send({type: 'transport', do: 'seek', value: time_s});
    },
    show: (panel) => this.showPanel(panel),
  };

  override connectedCallback(): void {
    super.connectedCallback();
    const kept = localStorage.getItem(kTheme);
    const light = kept === null ? matchMedia('(prefers-color-scheme: light)').matches : kept === 'light';
    this.palette.set(light ? 'light' : 'dark');
    const update = () => this.requestUpdate();
    this.model.runChanged.on(() => {
      this.openAtLinkedMoment();
      update();
    });
    this.model.rosterChanged.on(() => {
      this.palette.assign(this.model.robots);
      this.selection.set([]);
      this.retitle();
    });
    this.link.changed.on(update);
    this.model.peopleChanged.on(update);
    document.addEventListener('visibilitychange', () => this.link.queueLook());
    this.phone.addEventListener('change', () => {
      this.dock = null;
      update();
    });
    bindKeys(() => this.actions());
    this.link.open();
    // A lost link counts its seconds.
    setInterval(() => {
      if (this.link.state === 'lost') update();
    }, 250);
  }

  override updated(): void {
    const host = this.renderRoot.querySelector<HTMLElement>('.dock');
    if (host && this.dock === null) this.dock = new Dock(this.dockHost(host), kPanels, this.context);
    this.retitle();
    const phone = this.renderRoot.querySelector<HTMLElement>('.phone');
    if (phone) this.fillPhone(phone);
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

  private fillPhone(place: HTMLElement): void {
    if (place.firstElementChild?.localName === this.kind(this.phonePanel).tag) return;
    const panel = document.createElement(this.kind(this.phonePanel).tag) as PanelElement;
    panel.context = this.context;
    place.replaceChildren(panel);
  }

  private kind(id: string): PanelKind {
    return kPanels.find((kind) => kind.id === id) ?? kPanels[0];
  }

  private retitle(): void {
    const titles = new Map(kPanels.map((kind) => {
      const count = kind.count?.(this.context);
      return [kind.id, count ? `${kind.title}  ${count}` : kind.title];
    }));
    this.dock?.retitle(titles);
  }

  private showPanel(id: string): void {
    if (this.phone.matches) {
      this.phonePanel = id;
      this.requestUpdate();
    } else this.dock?.show(id);
  }

  private openAtLinkedMoment(): void {
    const t = Number(new URLSearchParams(location.hash.slice(1)).get('t') ?? NaN);
    if (Number.isFinite(t)) this.context.seek(t);
  }

  private get world(): WorldPanel | null {
    return (this.querySelector('rave-world') ?? this.renderRoot.querySelector('rave-world')) as WorldPanel | null;
  }

  private get bar(): RunBar | null {
    return this.renderRoot.querySelector('rave-run-bar');
  }

  private actions(): KeyAction[] {
    const update = () => this.requestUpdate();
    return [
      {keys: ['Space'], what: 'play or pause', act: () => this.bar?.toggle()},
      {keys: ['K'], what: 'pause, resume', act: () => this.bar?.toggle()},
      {keys: ['.'], what: 'step on', act: () => this.bar?.stepBy(1)},
      {keys: [','], what: 'step back (replay)', act: () => this.bar?.stepBy(-1)},
      {keys: ['J'], what: 'slower', act: () => this.bar?.changePace(-1)},
      {keys: ['L'], what: 'faster', act: () => this.bar?.changePace(1)},
      {keys: ['['], what: 'previous event', act: () => this.bar?.toEvent(-1)},
      {keys: [']'], what: 'next event', act: () => this.bar?.toEvent(1)},
      {keys: ['F'], what: 'show everything', act: () => this.world?.fit()},
      {keys: ['C'], what: 'follow the selected robot', act: () => this.selection.follow(!this.selection.following)},
      {keys: ['M'], what: 'measure', act: () => this.world?.toggleMeasure()},
      {keys: ['P'], what: 'save a picture', act: () => this.world?.picture()},
      {keys: ['Ctrl K', '/'], what: 'find anything', act: () => { this.finding = true; update(); }},
      ...kPanels.map((kind, i) => ({keys: [String(i + 1)], what: kind.title, act: () => this.showPanel(kind.id)})),
      {keys: ['?'], what: 'this list', act: () => { this.showingKeys = !this.showingKeys; update(); }},
      {keys: ['Escape'], what: 'drop what is begun', act: () => this.escape()},
    ];
  }

  private escape(): void {
    if (this.finding || this.showingKeys) {
      this.finding = false;
      this.showingKeys = false;
    } else if (this.selection.following) this.selection.follow(false);
    else this.selection.set([]);
    this.requestUpdate();
  }

  private toggleTheme(): void {
    const theme = this.palette.theme === 'dark' ? 'light' : 'dark';
    localStorage.setItem(kTheme, theme);
    this.palette.set(theme);
    this.requestUpdate();
  }

  override render(): TemplateResult {
    if (this.link.state === 'refused') return this.renderRefused();
    const {hello} = this.model;
    return html`
      ${this.renderTopBar()}
      ${this.link.state === 'lost' ? this.renderLost() : nothing}
      ${hello === null && this.link.state !== 'lost' ? html`<div class="opening"><b>Opening the run</b></div>` : nothing}
      <main class=${this.link.state === 'lost' ? 'old' : ''}>
        ${this.phone.matches ? html`<div class="phone"></div>` : html`<div class="dock"><slot name="dock"></slot></div>`}
      </main>
      <rave-run-bar .context=${this.context}></rave-run-bar>
      ${this.phone.matches ? this.renderTabs() : nothing}
      ${this.finding ? html`<rave-find .context=${this.context} .panels=${kPanels} @done=${() => { this.finding = false; this.requestUpdate(); }}></rave-find>` : nothing}
      ${this.showingKeys ? this.renderKeys() : nothing}`;
  }

  private renderTopBar(): TemplateResult {
    const {hello} = this.model;
    const run = hello?.run;
    const replay = run?.source === 'replay';
    const state = this.link.state === 'lost' ? 'Link lost' : replay ? 'Replay' : run ? 'Live' : 'Opening';
    const about = !run ? '' : replay
      ? [run.started && startedText(run.started), run.hash && `hash ${run.hash.slice(0, 8)}`].filter(Boolean).join(', ')
      : run.clock === 'lock_step' ? 'lock-step' : 'real time';
    return html`<header>
      <span class="brand">${logo()}<b>RAVE</b></span><i class="rule"></i>
      <b class="run">${run?.name ?? ''}</b>
      <span class="state ${state.toLowerCase().replace(' ', '-')}">${replay ? icon('rotateCcw', 13) : html`<i></i>`}${state}</span>
      <span class="about">${about}</span>
      <span class="space"></span>
      <button class="find" @click=${() => { this.finding = true; this.requestUpdate(); }}>${icon('search', 15)}<span>Find a robot, panel or moment</span><kbd>Ctrl K</kbd></button>
      <span class="space"></span>
      ${replay && run?.recording ? html`<span class="chip about">${icon('fileText', 14)} ${run.recording.name} ${sizeText(run.recording.bytes)}${run.recording.whole ? '' : ', cut off'}</span>` : nothing}
      <span class="chip rate" title="Pictures per second, and how much comes over the line">${icon('activity', 14)} ${this.link.rate_hz} Hz <em>${sizeText(this.link.bytesPerSecond)}/s</em></span>
      <button class="icon-button" title="Light or dark" aria-label="Light or dark" @click=${() => this.toggleTheme()}>${icon(this.palette.theme === 'dark' ? 'sun' : 'moon')}</button>
      ${hello ? html`<i class="rule"></i><span class="person"><i>${initials(hello.user.name)}</i><span>${roleText(hello.user.role)}</span></span>` : nothing}
    </header>`;
  }

  private renderLost(): TemplateResult {
    const lost_s = (performance.now() - this.link.lostAt_ms) / 1000;
    const again_s = Math.max(0, (this.link.retryAt_ms - performance.now()) / 1000);
    const shown = this.model.poses.newest;
    return html`<div class="lost" role="alert">${icon('wifiOff', 16)}
      <span><b>Link lost ${lost_s.toFixed(1)} s ago.</b> ${shown === null ? '' : `This is ${clockText(shown.time_s)} s. `}Trying again in ${again_s.toFixed(0)} s.</span>
      <button @click=${() => this.link.open()}>Now</button></div>`;
  }

  private renderRefused(): TemplateResult {
    return html`<div class="refused">${logo()}<h1>${this.link.refusal === '' ? 'You are not signed in' : this.link.refusal}</h1>
      <p>Open the link that the terminal printed when the run began. It works once.</p></div>`;
  }

  private renderTabs(): TemplateResult {
    return html`<nav>${kPanels.map((kind) => html`<button aria-pressed=${this.phonePanel === kind.id} @click=${() => this.showPanel(kind.id)}>
      ${icon(kind.icon as IconName, 20)}<span>${kind.title.split(' ')[0]}</span></button>`)}</nav>`;
  }

  private renderKeys(): TemplateResult {
    return html`<div class="scrim" @click=${() => this.escape()}><div class="keys" role="dialog" aria-label="Keyboard">
      <h2>Keyboard</h2>
      <dl>${this.actions().map((action) => html`<div><dt>${action.what}</dt><dd>${action.keys.map((key) => html`<kbd>${key}</kbd>`)}</dd></div>`)}</dl></div></div>`;
  }

  static override styles = [
    controls,
    css`
      :host { display: flex !important; flex-direction: column; height: 100%; background: var(--bg-0); }
      header { display: flex; align-items: center; gap: 10px; height: var(--h-topbar); flex: none; padding: 0 14px; }
      .brand { display: flex; align-items: center; gap: 8px; letter-spacing: .04em; }
      .rule { width: 1px; height: 20px; background: var(--line-2); }
      .run { font-size: var(--fs-15); font-weight: var(--fw-strong); }
      .state { display: inline-flex; align-items: center; gap: 6px; height: 22px; padding: 0 10px; border-radius: var(--r-full); font-size: var(--fs-12); background: var(--ok-soft); color: var(--ok); }
      .state i { width: 7px; height: 7px; border-radius: 50%; background: currentColor; }
      .state.replay { background: var(--intent-soft); color: var(--intent); }
      .state.link-lost { background: var(--danger-soft); color: var(--danger); }
      .state.opening { background: var(--bg-2); color: var(--text-2); }
      .about { color: var(--text-2); font-size: var(--fs-12); white-space: nowrap; }
      .space { flex: 1; }
      .find { display: flex; align-items: center; gap: 8px; flex: 0 1 300px; min-width: 40px; height: 30px; padding: 0 8px; border: 1px solid var(--line-2); border-radius: var(--r-3); background: var(--bg-1); color: var(--text-3); font-size: var(--fs-12); overflow: hidden; }
      .find span { flex: 1; text-align: left; white-space: nowrap; overflow: hidden; text-overflow: ellipsis; }
      kbd { padding: 0 6px; border: 1px solid var(--line-2); border-radius: var(--r-2); background: var(--bg-2); color: var(--text-2); font: 500 var(--fs-11) var(--font-ui); white-space: nowrap; }
      .rate em { font-style: normal; color: var(--text-3); }
      .person { display: flex; align-items: center; gap: 8px; font-size: var(--fs-12); }
      .person i { display: grid; place-items: center; width: 24px; height: 24px; border-radius: 50%; background: var(--intent-fill); color: #fff; font-style: normal; font-size: 10px; font-weight: 600; }
      main { flex: 1; min-height: 0; padding: 0 6px 6px; }
      main.old { filter: grayscale(1) opacity(.55); }
      .dock, .phone { height: 100%; }
      rave-run-bar { flex: none; margin: 0 6px 6px; }
      .lost { display: flex; align-items: center; gap: 12px; margin: 0 6px 6px; padding: 8px 14px; border: 1px solid var(--danger); border-radius: var(--r-3); background: var(--danger-soft); color: var(--danger); font-size: var(--fs-12); }
      .lost span { flex: 1; color: var(--text-1); }
      .lost button { padding: 3px 12px; border: 1px solid var(--line-2); border-radius: var(--r-3); color: var(--text-1); background: var(--bg-2); }
      .opening { position: absolute; inset: 44px 0 90px; display: grid; place-items: center; color: var(--text-2); pointer-events: none; z-index: 2; }
      .refused { height: 100%; display: grid; place-content: center; justify-items: center; text-align: center; gap: 4px; padding: 24px; }
      .refused h1 { font-size: var(--fs-20); font-weight: 600; margin: 12px 0 0; }
      .refused p { color: var(--text-2); margin: 4px 0; }
      .scrim { position: fixed; inset: 0; display: grid; place-items: center; background: var(--scrim); z-index: 10; }
      .keys { width: min(620px, 92vw); max-height: 86vh; overflow: auto; padding: 18px 24px; background: var(--bg-2); border: 1px solid var(--line-2); border-radius: var(--r-4); box-shadow: var(--shadow-pop); }
      .keys h2 { margin: 0 0 10px; font-size: var(--fs-15); }
      .keys dl { columns: 2; column-gap: 32px; margin: 0; font-size: var(--fs-12); }
      .keys div div, .keys dl > div { display: flex; justify-content: space-between; gap: 8px; padding: 6px 0; border-bottom: 1px solid var(--line-1); break-inside: avoid; }
      .keys dd { margin: 0; display: flex; gap: 4px; }
      nav { display: flex; flex: none; background: var(--bg-1); border-top: 1px solid var(--line-1); padding-bottom: env(safe-area-inset-bottom); }
      nav button { flex: 1; display: flex; flex-direction: column; align-items: center; gap: 3px; padding: 8px 0; color: var(--text-3); font-size: var(--fs-12); }
      nav button[aria-pressed='true'] { color: var(--text-1); }
      @media (max-width: 1100px) { .about, .rate em { display: none; } }
      @media (max-width: 599px) {
        header { padding: 0 10px; } .brand b, .rule, .find span, .find kbd, .rate, .person span { display: none; }
        .find { flex: none; width: 36px; justify-content: center; } main { padding: 0; } rave-run-bar { margin: 0; }
      }
    `,
  ];
}

function socketUrl(): string {
  const url = new URL('ws', document.baseURI);
  url.protocol = url.protocol === 'https:' ? 'wss:' : 'ws:';
  url.hash = '';
  return url.href;
}

function logo(): TemplateResult {
  return html`<svg width="26" height="18" viewBox="0 0 26 18" aria-hidden="true"><circle cx="8.5" cy="9" r="7.5" fill="var(--text-1)"/>
    <path d="M17 2.2 23.8 9 17 15.8 10.2 9z" fill="none" stroke="var(--intent)" stroke-width="2.2" stroke-linejoin="round"/></svg>`;
}

function startedText(started: string): string {
  const date = new Date(started);
  if (Number.isNaN(date.getTime())) return started;
  const today = new Date().toDateString() === date.toDateString();
  const day = today ? 'today' : date.toLocaleDateString(undefined, {day: 'numeric', month: 'short', year: 'numeric'});
  return `${day} ${String(date.getHours()).padStart(2, '0')}:${String(date.getMinutes()).padStart(2, '0')}`;
}

function initials(name: string): string {
  const words = name.split(/[\s._-]+/).filter(Boolean);
  return (words.length > 1 ? words[0][0] + words[1][0] : name.slice(0, 2)).toUpperCase();
}

function roleText(role: string): string {
  return {observer: 'Observer', commander: 'Commander', super_user: 'Super-User'}[role] ?? role;
}

function sizeText(bytes: number): string {
  if (bytes < 1000) return `${bytes} B`;
  if (bytes < 1e6) return `${(bytes / 1e3).toFixed(0)} kB`;
  return bytes < 1e9 ? `${(bytes / 1e6).toFixed(1)} MB` : `${(bytes / 1e9).toFixed(2)} GB`;
}

customElements.define('rave-app', RaveApp);
