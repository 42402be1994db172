// SPDX-License-Identifier: Apache-2.0
import {css, html, nothing, type TemplateResult} from 'lit';
import {icon} from '../../app/icons';
import {LiveElement} from '../../app/live_element';
import {controls, glyphs} from '../../app/styles';
import '../lease_bar';
import {kCommandsOf} from '../../protocol/frames';
import {guardOf, type GuardAct} from '../robot/guard_act';
import {CarDesk} from './car_desk';
import {carStyles, renderCar} from './car_view';
import {dialStyles, kReach, renderDial} from './dial';
import {DriveLoop} from './drive_loop';
import {DriveKeys} from './keys';
import {readPad} from './pad';

const kRefresh_ms = 100;
const kPad_ms = 1000 / 60;
/** Where the browser keeps the layout. */
const kLayout = 'rave.joystick';
const kTop_mps = [0.1, 0.2, 0.4, 0.8, 1.6];

/** A stick for the selected robot: pointer, finger, pen, keys or gamepad; it drives only while held. */
export class JoystickPanel extends LiveElement {
  private loop!: DriveLoop;
  private readonly keys = new DriveKeys();
  private pad = '';
  private car!: CarDesk;
  private pedals = localStorage.getItem(kLayout) === 'pedals';

  protected override listen(): (() => void)[] {
    const {model, selection, commands, link, windows} = this.context;
    this.loop ??= new DriveLoop(commands, () => this.requestUpdate());
    this.car ??= new CarDesk(this.loop, this.keys);
    let chosen = this.driven;
    const choose = () => {
      // A gear that was put in for one robot is not that of the next.
      if (this.driven !== chosen) this.car.letGo();
      chosen = this.driven;
      this.loop.choose(chosen);
      // What is left of the stick behind the guard.
      link.look(this, chosen === null ? [] : [[chosen, kCommandsOf]]);
      this.requestUpdate();
    };
    choose();
    return [
      () => this.letGo(),
      () => link.look(this, []),
      ...[selection.changed, model.drivesChanged, model.runChanged].map((signal) => signal.on(choose)),
      link.changed.on(() => !link.reaches && this.letGo()),
      // The dead-man: a page that is not visible does not drive.
      windows.left.on(() => this.letGo()),
      this.every(kRefresh_ms, () => this.requestUpdate()),
      this.every(kPad_ms, () => this.readPad()),
    ];
  }

  /** The robot that is driven: the one that was selected last, if it lets itself be driven. */
  private get driven(): number | null {
    const slot = this.context.selection.primary;
    return slot !== null && this.whyNot(slot) === '' ? slot : null;
  }

  private whyNot(slot: number): string {
    const {model} = this.context;
    const drive = model.drives.get(slot);
    if (drive !== undefined && drive.lease !== '' && !drive.yours) {
      const name = model.robots[slot]?.name ?? '';
      return drive.lease === model.knownAs ? `You drive ${name} on another page.` : `${drive.lease} drives ${name}.`;
    }
    return model.whyNotTaken(slot, 'drive');
  }

  private letGo(): void {
    this.keys.clear();
    this.car.letGo();
    this.loop.release();
  }

  private setLayout(pedals: boolean): void {
    if (pedals === this.pedals) return;
    this.letGo();
    this.pedals = pedals;
    localStorage.setItem(kLayout, pedals ? 'pedals' : 'stick');
    this.requestUpdate();
  }

  private readPad(): void {
    // Pedals read the pad themselves.
    if (this.pedals) {
      this.car.tick(performance.now());
      this.pad = this.car.pad;
      return;
    }
    const pad = readPad();
    this.pad = pad?.name ?? '';
    if (pad?.held === true) this.loop.hold('pad', pad.x, pad.y);
    else this.loop.release('pad');
  }

  private point(event: PointerEvent): void {
    const box = (event.currentTarget as HTMLElement).getBoundingClientRect();
    // The dial is drawn in a view box of 208 units.
    const unit = (kReach / 208) * box.width;
    this.loop.hold('touch', (event.clientX - box.left - box.width / 2) / unit, -(event.clientY - box.top - box.height / 2) / unit);
  }

  private press(event: PointerEvent): void {
    const stick = event.currentTarget as HTMLElement;
    // A finger that leaves the dial still drives, and lifting it anywhere releases.
    stick.setPointerCapture(event.pointerId);
    stick.focus();
    this.loop.renew('touch');
    this.point(event);
    event.preventDefault();
  }

  private key(event: KeyboardEvent, down: boolean): void {
    // Shortcuts of page and browser, such as Ctrl W.
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const gear = {e: 1, q: -1}[event.key.toLowerCase()];
    if (this.pedals && gear !== undefined) {
      event.preventDefault();
      event.stopPropagation();
      if (down && !event.repeat) this.car.shiftBy(gear);
      return;
    }
    if (!this.move(event.key, down, event.repeat)) return;
    event.preventDefault();
    event.stopPropagation();
  }

  /** Shift and arrows from anywhere on the page. */
  drive(key: string, down: boolean): void {
    this.move(key, down);
  }

  /** True if it is a key that drives. */
  private move(key: string, down: boolean, again = false): boolean {
    const first = down && !again && !this.keys.held;
    if (!(down ? this.keys.press(key) : this.keys.lift(key))) return false;
    if (this.pedals) return true;
    if (first) this.loop.renew('keys');
    if (this.keys.held) this.loop.hold('keys', ...this.keys.place);
    else this.loop.release('keys');
    return true;
  }

  override render(): TemplateResult {
    const {model, selection, palette} = this.context;
    const slot = selection.primary;
    const robot = slot === null ? undefined : model.robots[slot];
    if (slot === null || robot === undefined) {
      return html`<div class="empty">${icon('joystick', 28)}<p>Select a robot to drive it.</p></div>`;
    }
    const why = this.whyNot(slot);
    const hue = palette.hue(slot);
    const guard = guardOf(model, slot, this.loop.velocity[0]);
    return html`
      <header><i class="glyph ${robot.kind}" style="--hue:${robot.kind === 'real' ? hue.fill : hue.ink}"></i><b>${robot.name}</b><span class="space"></span>${this.renderSources()}</header>
      <rave-lease .context=${this.context} .robot=${slot}></rave-lease>
      ${why !== '' ? html`<p class="why">${why}</p>` : nothing}
      ${this.loop.refusal !== '' ? html`<p class="why bad" role="alert">${this.loop.refusal}</p>` : nothing}
      ${this.pedals && this.car.car.refusal !== '' ? html`<p class="why" role="status">${this.car.car.refusal}</p>` : nothing}
      <div class="middle">${this.renderNotes(guard)}
        ${this.pedals ? this.renderPedals(robot.name, why !== '') : html`<div class="stick" tabindex="0" role="application" aria-label="Stick of ${robot.name}: hold and move, or hold W A S D or the arrows" aria-disabled=${why !== ''}
          @pointerdown=${this.press} @pointermove=${(event: PointerEvent) => this.loop.held === 'touch' && this.point(event)}
          @pointerup=${() => this.loop.release('touch')} @pointercancel=${() => this.loop.release('touch')} @lostpointercapture=${() => this.loop.release('touch')}
          @keydown=${(event: KeyboardEvent) => this.key(event, true)} @keyup=${(event: KeyboardEvent) => this.key(event, false)}
          @blur=${() => { this.keys.clear(); this.loop.release('keys'); }} @contextmenu=${(event: Event) => event.preventDefault()}>
          ${renderDial({x: this.loop.x, y: this.loop.y, held: this.loop.held !== null, disabled: why !== '', guard: guard === null ? null : guard.limit_mps / this.loop.v_mps})}</div>`}</div>
      ${this.renderValues(slot, guard)}
      <footer>${this.renderLayouts()}${this.renderWay(robot.name)}${this.renderDelay()}</footer>`;
  }

  private renderPedals(robot: string, disabled: boolean): TemplateResult {
    const {car} = this;
    return renderCar({
      pedals: car.pedals, gear: car.car.gear, disabled, robot,
      touch: (control, value) => car.touch(control, value),
      shift: (gear) => { car.shift(gear); this.requestUpdate(); },
      key: (event, down) => this.key(event, down),
      blur: () => this.keys.clear(),
    });
  }

  private renderLayouts(): TemplateResult {
    const layout = (pedals: boolean, text: string, title: string) => html`<button role="radio" aria-checked=${this.pedals === pedals} title=${title} @click=${() => this.setLayout(pedals)}>${text}</button>`;
    return html`<div class="segments" role="radiogroup" aria-label="Controls">${layout(false, 'Stick', 'One stick for both velocities')}${layout(true, 'Pedals', 'Steering, throttle, brake and gear')}</div>`;
  }

  private renderSources(): TemplateResult {
    const {held} = this.loop;
    const source = (on: boolean, there: boolean, name: 'gamepad' | 'keyboard' | 'hand', text: string, title: string) =>
      html`<span class="source ${on ? 'on' : ''} ${there ? '' : 'off'}" title=${title}>${icon(name, 14)} ${text}</span>`;
    return html`<div class="segments sources">
      ${source(held === 'pad', this.pad !== '', 'gamepad', 'Pad', this.pad === '' ? 'No gamepad: connect one and press a button' : this.pad)}
      ${source(held === 'keys', true, 'keyboard', 'Keys', 'W A S D or arrows on the stick; Shift and arrows anywhere')}
      ${source(held === 'touch', true, 'hand', 'Touch', 'Hold the stick')}</div>`;
  }

  private renderNotes(guard: GuardAct | null): TemplateResult {
    return html`<div class="notes"><span class=${this.loop.held === null ? '' : 'held'}>${this.loop.held === null ? html`hold to drive<small>let go: it stands</small>` : html`dead-man held<small>let go: it stands</small>`}</span>
      ${guard === null ? nothing : html`<span class="guarded">guard ${guard.limit_mps.toFixed(2)} m/s<small>${guard.why}</small></span>`}</div>`;
  }

  private renderValues(slot: number, guard: GuardAct | null): TemplateResult {
    const [v, w] = this.loop.velocity;
    const driven = this.context.model.poses.newest?.speed[slot] ?? 0;
    const bar = (value: number, full: number, mark: number | null) => {
      const share = Math.max(-1, Math.min(1, value / full));
      return html`<span class="track"><i style="left:${share < 0 ? 50 + 50 * share : 50}%;width:${50 * Math.abs(share)}%"></i>${mark === null ? nothing : html`<u style="left:${50 + 50 * Math.max(-1, Math.min(1, mark / full))}%"></u>`}</span>`;
    };
    return html`<div class="values">
      <div><label>asked <b>${signed(v)}</b> m/s</label>${bar(v, this.loop.v_mps, guard === null ? null : guard.limit_mps)}<small>driven ${signed(driven)} m/s</small></div>
      <div><label>turn left <b>${signed(w)}</b> rad/s</label>${bar(w, this.loop.w_radps, null)}
        <small>full stick <select aria-label="Full stick" @change=${(event: Event) => { this.loop.v_mps = Number((event.target as HTMLSelectElement).value); }}>
          ${kTop_mps.map((top) => html`<option value=${top} ?selected=${top === this.loop.v_mps}>${top} m/s</option>`)}</select></small></div></div>`;
  }

  /** Which way the velocities go. */
  private renderWay(name: string): TemplateResult {
    const direct = this.context.link.direct?.way(name) === 'direct';
    return html`<span class="chip ${direct ? 'direct' : ''}">${icon(direct ? 'zap' : 'server', 13)} ${direct ? 'Direct line' : 'through the server'}</span>`;
  }

  private renderDelay(): TemplateResult | typeof nothing {
    if (this.loop.delay_ms === 0) return nothing;
    const {delays_ms} = this.loop;
    const top = Math.max(50, ...delays_ms);
    const points = delays_ms.map((delay, i) => `${i * 1.6},${14 - (12 * delay) / top}`).join(' ');
    return html`<span class="delay"><svg width="64" height="16" aria-hidden="true"><polyline points=${points} /></svg><b>${Math.round(this.loop.delay_ms)} ms</b></span>`;
  }

  static override styles = [
    controls,
    glyphs,
    dialStyles,
    carStyles,
    css`
      :host { display: flex; flex-direction: column; height: 100%; background: var(--bg-1); overflow: auto; container-type: inline-size; }
      /* The figure alone, so that the way of the velocities and their delay stay on one line. */
      @container (max-width: 420px) { .delay svg { display: none; } }
      header { display: flex; align-items: center; gap: 8px; padding: 10px 12px 8px; }
      header b { font-size: var(--fs-15); overflow: hidden; text-overflow: ellipsis; white-space: nowrap; }
      rave-lease { margin: 0 12px 4px; flex: none; }
      .sources { flex: none; }
      .source { display: inline-flex; align-items: center; gap: 5px; height: 24px; padding: 0 8px; border-radius: 5px; color: var(--text-2); font-size: var(--fs-12); }
      .source.on { background: var(--intent-soft); color: var(--intent); }
      .source.off { color: var(--text-3); }
      .why { margin: 4px 14px; color: var(--text-2); font-size: var(--fs-12); }
      .why.bad { color: var(--danger); }
      .middle { position: relative; flex: 1; min-height: 150px; display: grid; place-items: center; padding: 4px 12px; }
      .notes { position: absolute; inset: 6px 14px auto; display: flex; justify-content: space-between; gap: 120px; font-size: var(--fs-12); color: var(--text-3); pointer-events: none; font-weight: var(--fw-medium); }
      .notes small { display: block; font-size: var(--fs-11); font-weight: 400; color: var(--text-3); }
      .notes .held { color: var(--intent); }
      .guarded { color: var(--warn); text-align: right; max-width: 130px; }
      .stick { position: absolute; inset: 4px 12px; margin: auto; height: min(100% - 8px, 240px); max-width: calc(100% - 24px); aspect-ratio: 1; touch-action: none; user-select: none; cursor: grab; border-radius: 50%; }
      .stick[aria-disabled='true'] { cursor: not-allowed; }
      .values { display: grid; grid-template-columns: 1fr 1fr; gap: 18px; padding: 6px 14px 10px; font-size: var(--fs-12); color: var(--text-2); }
      .values label { display: block; white-space: nowrap; }
      .values b { color: var(--text-1); font-size: var(--fs-15); }
      .values small { color: var(--text-2); font-size: var(--fs-11); }
      .values select { font: inherit; color: var(--text-1); background: var(--bg-3); border: 1px solid var(--line-2); border-radius: var(--r-2); }
      .track { position: relative; display: block; height: 6px; margin: 6px 0; border-radius: 3px; background: var(--bg-4); }
      .track i { position: absolute; top: 0; height: 6px; border-radius: 3px; background: var(--intent); }
      .track u { position: absolute; top: -3px; width: 2px; height: 12px; background: var(--warn); }
      footer { display: flex; flex-wrap: wrap; align-items: center; gap: 6px 10px; padding: 8px 12px; border-top: 1px solid var(--line-1); font-size: var(--fs-12); flex: none; }
      .chip.direct { background: linear-gradient(var(--ok-soft) 0 0), var(--bg-1); color: var(--ok); }
      .delay { display: flex; align-items: center; gap: 8px; margin-left: auto; white-space: nowrap; }
      polyline { fill: none; stroke: var(--ok); stroke-width: 1.25; }
      .empty { display: grid; place-content: center; justify-items: center; gap: 4px; height: 100%; color: var(--text-3); font-size: var(--fs-12); }
    `,
  ];
}

/** Two digits, without the sign of a zero. */
function signed(value: number): string {
  return (Math.abs(value) < 0.005 ? 0 : value).toFixed(2).replace('-', '−');
}

customElements.define('rave-joystick', JoystickPanel);
