// SPDX-License-Identifier: Apache-2.0
import {css, html, nothing, type TemplateResult} from 'lit';
import {
  countStopped,
  Hold,
  kTwice_ms,
  lastStop,
  Twice,
  type LastStop,
  type StopCount,
} from '../model/stop_state';
import {viewOf} from '../model/windows';
import {shortClock} from '../ui/clock';
import {icon} from '../ui/icons';
import {LiveElement} from '../ui/live_element';
import {namesText} from '../ui/words';
import {controls} from '../ui/styles';

/** STOP, and once all robots stand, the button that is held to release them. */
export class StopButton extends LiveElement {
  private readonly hold = new Hold();
  private readonly twice = new Twice();
  /** One press of Space has come; the second one stops. */
  private half = false;
  /** The stop of this page that has not been released: at what time of the run, if that is
   * known. */
  private own: {t_s: number | null} | null = null;
  private shown = '';

  protected override listen(): (() => void)[] {
    const {model, link} = this.context;
    return [
      ...this.renderAfter(
        model.rosterChanged,
        model.runChanged,
        model.timeChanged,
        model.eventsChanged,
        link.changed,
        ...(link.direct ? [link.direct.changed] : []),
      ),
      model.pictureChanged.on(() => {
        const count = this.count();
        const now = `${count.stopped.join()} ${count.latched}`;
        if (now === this.shown) return;
        this.shown = now;
        this.requestUpdate();
      }),
    ];
  }

  /** Space Space. Does nothing in a replay. */
  key(event: KeyboardEvent): void {
    if (event.repeat || !this.context.model.may('stop')) return;
    if (this.twice.press(performance.now())) {
      this.half = false;
      this.stop();
      return;
    }
    this.half = true;
    this.requestUpdate();
    setTimeout(() => {
      this.half = false;
      this.requestUpdate();
    }, kTwice_ms);
  }

  /** Of those that orders reach: the others have to be stopped at their machines. */
  private count(): StopCount {
    const {model, link} = this.context;
    return countStopped(model, (slot) => link.reachesRobot(slot));
  }

  private stop(): void {
    const {model, link} = this.context;
    // Only the server knows what time it is in the run.
    this.own = {
      t_s: link.state === 'open' ? (model.poses.newest?.time_s ?? model.time?.now_s ?? 0) : null,
    };
    link.send({type: 'halt', do: 'stop', slots: []});
    this.requestUpdate();
  }

  private press(event: Event): void {
    // Events of another window have classes of their own.
    if ('pointerId' in event)
      (event.currentTarget as HTMLElement).setPointerCapture(event.pointerId as number);
    this.hold.press(performance.now());
    this.grow();
  }

  private lift(): void {
    this.hold.lift();
    this.requestUpdate();
  }

  /** Advances the ring while the button is held; a full ring releases. */
  private grow(): void {
    if (!this.hold.pressed) return;
    if (this.hold.share(performance.now()) >= 1) {
      this.hold.lift();
      this.own = null;
      this.context.link.send({type: 'halt', do: 'release', slots: []});
    } else viewOf(this).requestAnimationFrame(() => this.grow());
    this.requestUpdate();
  }

  override render(): TemplateResult {
    const {model, link} = this.context;
    const count = this.count();
    if (model.hello !== null && !model.may('stop')) return this.renderViewOnly();
    const out = !link.reaches;
    return html`<div aria-live="polite" class="spoken">
        ${count.stopped.length > 0 ? `${this.who(count.stopped)} stopped.` : nothing}
      </div>
      ${count.latched && model.may('release')
        ? this.renderRelease(count, true)
        : html` ${count.stopped.length > 0 && model.may('release')
              ? this.renderRelease(count, false)
              : nothing}
            <button
              class="stop"
              ?disabled=${out}
              title="Stop ${this.meant(count)} (Space Space)"
              @click=${() => this.stop()}>
              ${icon('octagonX', 28)}<span
                ><b>STOP</b><small>${this.stopText(count, out)}</small></span
              >
            </button>`}`;
  }

  private stopText(count: StopCount, out: boolean): string {
    if (out) return 'out of reach';
    if (this.half) return 'Space again';
    if (count.latched) return 'all stand';
    const {robots} = this.context.model;
    if (count.robots.length === robots.length)
      return robots.length === 1 ? 'the robot' : `all ${robots.length} robots`;
    return count.robots.length === 1
      ? `only ${robots[count.robots[0]].name}`
      : `${count.robots.length} of ${robots.length} robots`;
  }

  /** Whom STOP means, by name unless it is all. */
  private meant(count: StopCount): string {
    const {robots} = this.context.model;
    return count.robots.length === robots.length
      ? 'all robots'
      : namesText(
          count.robots.map((slot) => robots[slot].name),
          8,
        );
  }

  /** One robot by its name, several by their number. */
  private who(slots: readonly number[]): string {
    return slots.length === 1 ? this.context.model.robots[slots[0]].name : `${slots.length} robots`;
  }

  /** Who stopped and when, for everybody's stop. One's own is known before the log has it. */
  private whenStopped(): string {
    const {model, link} = this.context;
    const last = lastStop(model, (slot) => link.stops?.has(slot) ?? false);
    const you = model.knownAs;
    if (this.own !== null && (last === null || this.isNewer(this.own.t_s, last)))
      return this.own.t_s === null
        ? 'stopped by you'
        : `stopped by you at ${shortClock(this.own.t_s)}`;
    if (last === null) return 'stopped';
    const who = last.who === '' ? '' : ` by ${last.who === you ? 'you' : last.who}`;
    return `stopped${who} at ${shortClock(last.t_s)}`;
  }

  /** Whether one's own stop counts, and not what the log has. */
  private isNewer(own_s: number | null, last: LastStop): boolean {
    if (own_s === null) return this.context.link.state !== 'open';
    return last.who === this.context.model.knownAs || last.who === '' || last.t_s < own_s;
  }

  private renderViewOnly(): TemplateResult {
    const {model} = this.context;
    // Small screens have no place for the name and size of the recording.
    const recording =
      model.hello?.run.recording?.whole === false ? 'incomplete recording' : 'this is a recording';
    return html`<div class="view-only" title=${model.whyNot('stop')}>
      ${icon('eye', 18)}
      <span>View only<small>${model.live ? 'observers cannot stop' : recording}</small></span>
    </div>`;
  }

  private renderRelease(count: StopCount, large: boolean): TemplateResult {
    const when = this.whenStopped();
    const turn = 2 * Math.PI * 9;
    const share = this.hold.share(performance.now());
    const key = (event: KeyboardEvent, act: () => void) => {
      if (event.key === ' ' || event.key === 'Enter') {
        event.preventDefault();
        act();
      }
    };
    return html`<button
      class="release ${large ? 'large' : ''}"
      aria-label="Hold to release ${this.who(count.stopped)}"
      title="Hold for 0.6 s: ${namesText(
        count.stopped.map((slot) => this.context.model.robots[slot].name),
        8,
      )}"
      @pointerdown=${this.press}
      @pointerup=${this.lift}
      @pointercancel=${this.lift}
      @blur=${this.lift}
      @contextmenu=${(event: Event) => event.preventDefault()}
      @keydown=${(event: KeyboardEvent) =>
        key(event, () => {
          if (!event.repeat) this.press(event);
        })}
      @keyup=${(event: KeyboardEvent) => key(event, () => this.lift())}>
      <svg width="24" height="24" viewBox="0 0 24 24" aria-hidden="true">
        <circle cx="12" cy="12" r="9" class="ring" />
        <circle
          cx="12"
          cy="12"
          r="9"
          class="done"
          stroke-dasharray="${share * turn} ${turn}"
          transform="rotate(-90 12 12)" />
      </svg>
      <span
        ><b>Hold to release</b
        ><small>${this.who(count.stopped)}${large ? `, ${when}` : ''}</small></span
      >
    </button>`;
  }

  static override styles = [
    controls,
    css`
      :host {
        display: flex;
        gap: 8px;
        flex: none;
      }
      .stop,
      .view-only,
      .release {
        display: flex;
        align-items: center;
        justify-content: center;
        gap: 12px;
        min-width: var(--w-stop);
        height: 60px;
        border-radius: var(--r-6);
        text-align: left;
        flex: none;
        touch-action: none;
        user-select: none;
      }
      .stop {
        background: var(--stop-fill);
        border: 1px solid var(--stop-edge);
        color: #fff;
      }
      .stop:active {
        filter: brightness(0.88);
      }
      .stop b {
        display: block;
        font-size: var(--fs-20);
        line-height: 1.1;
        letter-spacing: 0.02em;
      }
      small {
        display: block;
        max-width: 240px;
        overflow: hidden;
        font-size: var(--fs-12);
        white-space: nowrap;
        text-overflow: ellipsis;
      }
      .release {
        padding: 0 14px;
        border: 2px solid var(--danger);
        background: var(--bg-1);
        color: var(--danger);
      }
      .release:hover {
        background: var(--danger-soft);
      }
      .release b {
        display: block;
        font-size: var(--fs-13);
        font-weight: var(--fw-strong);
        white-space: nowrap;
      }
      .release small {
        color: var(--text-1);
        font-size: var(--fs-11);
      }
      circle {
        fill: none;
        stroke-width: 3;
      }
      .ring {
        stroke: var(--bg-4);
      }
      .done {
        stroke: var(--danger);
      }
      .view-only {
        border: 1px dashed var(--line-2);
        padding: 0 10px;
        color: var(--text-2);
        font-size: var(--fs-13);
        line-height: 1.3;
      }
      .view-only small {
        color: var(--text-3);
      }
      .spoken {
        position: absolute;
        width: 1px;
        height: 1px;
        overflow: hidden;
        clip-path: inset(50%);
      }
      @media (max-width: 599px) {
        .stop,
        .view-only,
        .release {
          min-width: 140px;
        }
        .release:not(.large) {
          min-width: 0;
          padding: 0 8px;
        }
        .release:not(.large) span {
          display: none;
        }
      }
      :host([pen]) button {
        height: 64px;
      }
      :host([pen]) .stop,
      :host([pen]) .large {
        min-width: 132px;
        gap: 10px;
        padding: 0 8px;
      }
    `,
  ];
}

customElements.define('rave-stop', StopButton);
