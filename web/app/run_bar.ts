// SPDX-License-Identifier: Apache-2.0
import {LitElement, css, html, nothing, type TemplateResult} from 'lit';
import type {PanelContext} from '../panel_api';
import type {Event} from '../protocol/messages';
import {bigClock, tickClock} from './clock';
import {icon} from './icons';
import {controls} from './styles';
import {roundStep} from '../panels/world/ticks';

const kPaces = [0.25, 1, 4, 16];
/** Events so near to each other become one mark, pixels. */
const kMark_px = 9;

/** Transport, clock, timeline, pace and STOP. Always there. */
export class RunBar extends LitElement {
  declare context: PanelContext;
  private dragging = false;
  private width = 800;
  private queued = false;
  private readonly resized = new ResizeObserver(() => this.measure());
  private readonly ends: (() => void)[] = [];

  override connectedCallback(): void {
    super.connectedCallback();
    const {model, link, palette} = this.context;
    const update = () => this.requestUpdate();
    for (const signal of [model.timeChanged, model.eventsChanged, model.rosterChanged, model.runChanged, palette.changed, link.changed]) {
      this.ends.push(signal.on(update));
    }
    this.ends.push(model.pictureChanged.on(() => this.queue()));
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    this.resized.disconnect();
    for (const end of this.ends.splice(0)) end();
  }

  override firstUpdated(): void {
    const line = this.renderRoot.querySelector('.line');
    if (line) this.resized.observe(line);
    this.measure();
  }

  private queue(): void {
    if (this.queued) return;
    this.queued = true;
    requestAnimationFrame(() => {
      this.queued = false;
      this.requestUpdate();
    });
  }

  private measure(): void {
    this.width = this.renderRoot.querySelector('.line')?.clientWidth ?? 800;
    this.requestUpdate();
  }

  private get now_s(): number {
    const {model} = this.context;
    return model.poses.newest?.time_s ?? model.time?.now_s ?? 0;
  }

  /** The timeline reaches from the begin to the planned or known end. */
  private get span(): [number, number] {
    const time = this.context.model.time;
    if (time === null) return [0, 1];
    return [time.begin_s, Math.max(time.duration_s, time.end_s, time.begin_s + 1e-3)];
  }

  private x(time_s: number): number {
    const [begin, end] = this.span;
    return ((time_s - begin) / (end - begin)) * this.width;
  }

  /** Space: play or pause. */
  toggle(): void {
    const {model, link} = this.context;
    if (!model.may('play')) return;
    link.send({type: 'transport', do: model.time?.state === 'running' ? 'pause' : 'play'});
  }

  stepBy(count: number): void {
    if (this.context.model.may('step')) this.context.link.send({type: 'transport', do: 'step', value: count});
  }

  /** J and L: slower, faster. */
  changePace(direction: number): void {
    const now = this.context.model.time?.pace ?? 1;
    const at = kPaces.reduce((best, pace, i) => (Math.abs(pace - now) < Math.abs(kPaces[best] - now) ? i : best), 0);
    this.setPace(kPaces[Math.min(Math.max(at + direction, 0), kPaces.length - 1)]);
  }

  private setPace(value: number): void {
    if (this.context.model.may('pace')) this.context.link.send({type: 'transport', do: 'pace', value});
  }

  /** [ and ]: the event before or after now. */
  toEvent(direction: number): void {
    const now = this.now_s;
    const times = this.context.model.events.map((event) => event.t).sort((a, b) => a - b);
    const next = direction > 0 ? times.find((t) => t > now + 0.01) : times.reverse().find((t) => t < now - 0.01);
    if (next !== undefined) this.context.seek(next);
  }

  override render(): TemplateResult {
    const {model} = this.context;
    const time = model.time;
    const replay = model.hello?.run.source === 'replay';
    const running = time?.state === 'running';
    const may = (power: string) => model.may(power);
    const button = (name: Parameters<typeof icon>[0], label: string, power: string, act: () => void) => html`
      <button class="icon-button" title=${may(power) ? label : model.whyNot(power)} aria-label=${label} ?disabled=${!may(power)} @click=${act}>${icon(name, 17)}</button>`;
    return html`
      <div class="transport">
        ${replay ? button('skipBack', 'To the beginning', 'seek', () => this.context.seek(this.span[0])) : nothing}
        ${replay ? button('stepBack', 'One step back (,)', 'step', () => this.stepBy(-1)) : nothing}
        <button class="play" title=${may('play') ? (running ? 'Pause (Space)' : 'Play (Space)') : model.whyNot('play')}
          aria-label=${running ? 'Pause' : 'Play'} ?disabled=${!may('play')} @click=${() => this.toggle()}>${icon(running ? 'pause' : 'play', 20)}</button>
        ${button('stepForward', 'One step on (.)', 'step', () => this.stepBy(1))}
        ${replay ? button('skipForward', 'To the end', 'seek', () => this.context.seek(this.span[1])) : nothing}
      </div>
      <div class="clock"><b>${bigClock(this.now_s)}</b>
        <span>of ${bigClock(this.span[1])} · step ${model.poses.newest?.step ?? time?.step ?? 0}</span></div>
      ${this.renderLine(replay)}
      <div class="pace">
        <div><span>Pace</span>
          <div class="segments" role="radiogroup" aria-label="Pace">${kPaces.map((pace) => html`
            <button role="radio" aria-checked=${time?.pace === pace} ?disabled=${!may('pace')} title=${may('pace') ? '' : model.whyNot('pace')}
              @click=${() => this.setPace(pace)}>${pace === 0.25 ? '¼×' : `${pace}×`}</button>`)}</div></div>
        <small>${this.speedText(replay)}${model.may('recording') ? html` <a href="./recording" download title="Download the recording" aria-label="Download the recording">${icon('download', 14)}</a>` : nothing}</small>
      </div>
      ${this.renderStop(replay)}`;
  }

  private speedText(replay: boolean): TemplateResult | string {
    const {model} = this.context;
    if (replay) {
      return html`<button class="text" @click=${() => this.copyLink()}>${icon('link', 13)} Link to this moment</button>`;
    }
    return `${(model.time?.speed ?? 0).toFixed(2)}× of real time`;
  }

  private copyLink(): void {
    const url = new URL(location.href);
    url.hash = `t=${this.now_s.toFixed(2)}`;
    history.replaceState(null, '', url);
    void navigator.clipboard?.writeText(url.href);
  }

  private renderLine(replay: boolean): TemplateResult {
    const {model} = this.context;
    const [begin, end] = this.span;
    const now = this.x(this.now_s);
    const known = this.x(model.time?.end_s ?? end);
    const step = roundStep((110 / this.width) * (end - begin));
    const ticks: number[] = [];
    for (let t = Math.ceil(begin / step) * step; t <= end + 1e-9; t += step) ticks.push(t);
    return html`<div class="line ${replay ? 'replay' : 'live'}" role="slider" tabindex="0" aria-label="Time of the run"
        aria-valuemin=${begin} aria-valuemax=${end} aria-valuenow=${this.now_s.toFixed(2)} aria-valuetext="${this.now_s.toFixed(2)} s"
        aria-disabled=${!model.may('seek')}
        @pointerdown=${this.down} @pointermove=${this.drag} @pointerup=${() => (this.dragging = false)} @keydown=${this.key}>
      <div class="marks">${this.marks()}</div>
      <div class="track"><div class="future" style="left:${known}px"></div><div class="past" style="width:${Math.max(0, now)}px"></div>
        <div class="knob" style="left:${now}px"></div></div>
      <div class="ticks">${ticks.map((t) => html`<span style="left:${this.x(t)}px">${tickClock(t)}</span>`)}</div>
    </div>`;
  }

  /** Marks of events that are not mere information; many near each other are a density. */
  private marks(): TemplateResult[] {
    const bins = new Map<number, Event[]>();
    for (const event of this.context.model.events) {
      const bin = Math.round(this.x(event.t) / kMark_px);
      const others = bins.get(bin);
      if (others === undefined) bins.set(bin, [event]);
      else others.push(event);
    }
    return [...bins].map(([bin, events]) => {
      const left = `left:${bin * kMark_px}px`;
      const worst = events.some((event) => event.level === 'alert') ? 'alert' : events.some((event) => event.level === 'warn') ? 'warn' : 'info';
      const title = events.length === 1 ? events[0].text : `${events.length} events: ${events[0].text}`;
      if (events.length > 3) return html`<i class="density ${worst}" style="${left};height:${Math.min(4 + 3 * events.length, 18)}px" title=${title}></i>`;
      return html`<i class="mark ${worst}" style=${left} title=${title}></i>`;
    });
  }

  private timeAt(event: PointerEvent): number {
    const line = this.renderRoot.querySelector('.line');
    const [begin, end] = this.span;
    const box = line?.getBoundingClientRect();
    if (!box) return begin;
    return begin + Math.min(Math.max((event.clientX - box.left) / box.width, 0), 1) * (end - begin);
  }

  private down(event: PointerEvent): void {
    if (!this.context.model.may('seek')) return;
    (event.currentTarget as HTMLElement).setPointerCapture(event.pointerId);
    this.dragging = true;
    this.context.seek(this.timeAt(event));
  }

  private drag(event: PointerEvent): void {
    if (this.dragging) this.context.seek(this.timeAt(event));
  }

  private key(event: KeyboardEvent): void {
    const by = {ArrowLeft: -1, ArrowRight: 1, PageDown: -10, PageUp: 10}[event.key];
    if (by === undefined) return;
    event.preventDefault();
    this.context.seek(Math.min(Math.max(this.now_s + by, this.span[0]), this.span[1]));
  }

  private renderStop(replay: boolean): TemplateResult {
    const {model, link} = this.context;
    const n = model.robots.length;
    if (!model.may('stop')) {
      return html`<div class="view-only" title=${model.whyNot('stop')}>${icon('eye', 18)}<span>View only<small>${replay ? 'this is a recording' : 'observers do not stop'}</small></span></div>`;
    }
    return html`<button class="stop" @click=${() => link.send({type: 'halt', do: 'stop', slots: []})}>
      ${icon('circleX', 28)}<span><b>STOP</b><small>all ${n} robots</small></span></button>`;
  }

  static override styles = [
    controls,
    css`
      :host { display: flex; align-items: center; gap: 16px; height: var(--h-runbar); padding: 0 12px; background: var(--bg-1); border-radius: var(--r-4); }
      .transport { display: flex; align-items: center; gap: 2px; }
      .play { display: grid; place-items: center; width: 38px; height: 38px; margin: 0 4px; border-radius: 50%; background: var(--bg-3); }
      .play:hover:not(:disabled) { background: var(--bg-4); }
      .clock { display: flex; flex-direction: column; min-width: 128px; }
      .clock b { font-size: var(--fs-20); font-weight: var(--fw-strong); line-height: 1.2; }
      .clock span { color: var(--text-3); font-size: var(--fs-12); white-space: nowrap; }
      .line { position: relative; flex: 1; min-width: 60px; height: 58px; cursor: pointer; touch-action: none; margin: 0 8px; }
      .line[aria-disabled='true'] { cursor: default; }
      .marks { position: absolute; inset: 0 0 34px; }
      .marks i { position: absolute; bottom: 2px; transform: translateX(-50%); }
      .mark.info { width: 6px; height: 6px; border-radius: 50%; background: var(--text-3); }
      .mark.warn { border: 5px solid transparent; border-bottom: 8px solid var(--warn); border-top: 0; }
      .mark.alert { width: 8px; height: 8px; background: var(--danger); transform: translateX(-50%) rotate(45deg) !important; }
      .density { width: 5px; background: var(--text-3); opacity: .8; }
      .density.warn { background: var(--warn); }
      .density.alert { background: var(--danger); }
      .track { position: absolute; left: 0; right: 0; top: 26px; height: 8px; border-radius: 4px; background: var(--bg-4); }
      .future { position: absolute; right: 0; top: 0; bottom: 0; border-radius: 4px; background: repeating-linear-gradient(135deg, var(--line-2) 0 1px, transparent 1px 5px), var(--bg-2); }
      .past { position: absolute; left: 0; top: 3px; height: 2px; background: var(--intent); }
      .live .past { background: var(--ok); }
      .knob { position: absolute; top: -3px; width: 14px; height: 14px; margin-left: -7px; border-radius: 50%; background: var(--intent-fill); border: 3px solid var(--bg-1); box-shadow: 0 0 0 1px var(--intent); }
      .live .knob { width: 10px; height: 10px; margin-left: -5px; top: -1px; background: var(--ok); box-shadow: none; border-width: 1px; }
      .ticks { position: absolute; left: 0; right: 0; top: 38px; color: var(--text-3); font-size: var(--fs-11); }
      .ticks span { position: absolute; transform: translateX(-50%); white-space: nowrap; }
      .ticks span:first-child { transform: none; }
      .pace { display: flex; flex-direction: column; gap: 4px; font-size: var(--fs-12); color: var(--text-2); }
      .pace > div { display: flex; align-items: center; gap: 8px; }
      .pace small { display: flex; align-items: center; gap: 8px; color: var(--text-3); font-size: var(--fs-12); white-space: nowrap; }
      .pace a { color: var(--text-2); }
      .text { display: inline-flex; gap: 6px; align-items: center; color: var(--text-2); }
      .text:hover { color: var(--text-1); }
      .stop { display: flex; align-items: center; justify-content: center; gap: 12px; width: var(--w-stop); height: 60px; border-radius: var(--r-6); background: var(--stop-fill); border: 1px solid var(--stop-edge); color: #fff; text-align: left; flex: none; }
      .stop b { display: block; font-size: var(--fs-20); line-height: 1.1; letter-spacing: .02em; }
      .stop small { font-size: var(--fs-12); }
      .view-only { display: flex; align-items: center; justify-content: center; gap: 12px; width: var(--w-stop); height: 60px; border-radius: var(--r-6); border: 1px dashed var(--line-2); color: var(--text-2); font-size: var(--fs-13); flex: none; }
      .view-only small { display: block; color: var(--text-3); font-size: var(--fs-12); }
      @media (max-width: 900px) { .pace { display: none; } }
      @media (max-width: 599px) {
        :host { gap: 8px; padding: 0 8px; border-radius: 0; }
        .transport .icon-button { display: none; }
        .clock { min-width: 84px; } .clock span { display: none; }
        .marks, .ticks { display: none; }
        .stop, .view-only { width: 132px; }
      }
    `,
  ];
}

customElements.define('rave-run-bar', RunBar);
