// SPDX-License-Identifier: Apache-2.0
import {css, html, nothing, type TemplateResult} from 'lit';
import {logOf} from '../model/run_begin';
import type {Power} from '../protocol/messages';
import {bigClock} from '../ui/clock';
import {icon} from '../ui/icons';
import {LiveElement} from '../ui/live_element';
import {nowOf, spanOf} from '../model/moment';
import './stop_button';
import type {StopButton} from './stop_button';
import {controls} from '../ui/styles';
import './timeline';

const kReplayPaces = [0.25, 1, 4, 16];
/** The clock is read by people: more often has no use and costs frames of the world. */
const kRefresh_ms = 50;
/** 0 is as fast as it goes. */
const kLivePaces = [0.5, 1, 4, 0];

/** Transport, clock, timeline, pace and STOP. Always there. */
export class RunBar extends LiveElement {
  private queued = false;
  /** The menu of narrow pages is open. */
  private menuOpen = false;

  protected override listen(): (() => void)[] {
    const {model, link} = this.context;
    return [
      ...this.renderAfter(model.timeChanged, model.runChanged, link.changed),
      model.pictureChanged.on(() => this.queue()),
    ];
  }

  private queue(): void {
    if (this.queued) return;
    this.queued = true;
    setTimeout(() => {
      this.queued = false;
      this.requestUpdate();
    }, kRefresh_ms);
  }

  /** Space in a replay, K everywhere: play or pause. */
  toggle(): void {
    const {model, link} = this.context;
    if (!model.may('play')) return;
    link.send({
      type: 'transport',
      do: model.time?.state === 'paused' || model.time?.state === 'ended' ? 'play' : 'pause',
    });
  }

  /** Space: twice it stops a live run, once it plays or pauses a replay. */
  space(event: KeyboardEvent): void {
    if (this.context.model.live) this.renderRoot.querySelector<StopButton>('rave-stop')?.key(event);
    else this.toggle();
  }

  stepBy(count: number): void {
    const {model, link} = this.context;
    if (model.may('step') && (count > 0 || !model.live))
      link.send({type: 'transport', do: 'step', value: count});
  }

  /** J and L: slower, faster. */
  changePace(direction: number): void {
    const paces = this.paces;
    const now = this.context.model.time?.pace ?? 1;
    const speed = (pace: number) => (pace === 0 ? Infinity : pace);
    const next =
      direction > 0
        ? paces.find((pace) => speed(pace) > speed(now))
        : [...paces].reverse().find((pace) => speed(pace) < speed(now));
    if (next !== undefined) this.setPace(next);
  }

  private get paces(): readonly number[] {
    return this.context.model.live ? kLivePaces : kReplayPaces;
  }

  private setPace(value: number): void {
    if (this.context.model.may('pace'))
      this.context.link.send({type: 'transport', do: 'pace', value});
  }

  /** [ and ]: the event before or after now. */
  toEvent(direction: number): void {
    const now = nowOf(this.context.model);
    const times = logOf(this.context.model)
      .map((event) => event.t)
      .sort((a, b) => a - b);
    const next =
      direction > 0
        ? times.find((t) => t > now + 0.01)
        : times.reverse().find((t) => t < now - 0.01);
    if (next !== undefined) this.context.seek(next);
  }

  override render(): TemplateResult {
    const {model} = this.context;
    const [begin, end] = spanOf(model);
    const replay = !model.live;
    const goes = model.time?.state === 'running' || model.time?.state === 'waiting';
    const may = (power: Power) => model.may(power);
    const button = (
      name: Parameters<typeof icon>[0],
      label: string,
      power: Power,
      act: () => void,
    ) =>
      html` <button
        class="icon-button"
        title=${may(power) ? label : model.whyNot(power)}
        aria-label=${label}
        ?disabled=${!may(power)}
        @click=${act}>
        ${icon(name, 17)}
      </button>`;
    return html` <div class="transport">
        ${replay
          ? button('skipBack', 'To the beginning', 'seek', () => this.context.seek(begin))
          : nothing}
        ${replay ? button('stepBack', 'One step back (,)', 'step', () => this.stepBy(-1)) : nothing}
        <button
          class="play"
          title=${may('play') ? `${goes ? 'Pause' : 'Play'} (K)` : model.whyNot('play')}
          aria-label=${goes ? 'Pause' : 'Play'}
          ?disabled=${!may('play')}
          @click=${() => this.toggle()}>
          ${icon(goes ? 'pause' : 'play', 20)}
        </button>
        ${button('stepForward', 'One step forward (.)', 'step', () => this.stepBy(1))}
        ${replay
          ? button('skipForward', 'To the end', 'seek', () => this.context.seek(end))
          : nothing}
      </div>
      <div class="clock">
        ${model.time === null
          ? html`<span>Loading ...</span>`
          : html`<b>${bigClock(nowOf(model))}</b>
              <span
                >of ${bigClock(end)} · step
                ${model.poses.newest?.step ?? model.time?.step ?? 0}</span
              >`}
      </div>
      <rave-timeline .context=${this.context}></rave-timeline>
      ${this.renderPace(replay)} ${this.renderMenu(replay)}
      <rave-stop .context=${this.context}></rave-stop>`;
  }

  /** Below 900 px what does not fit is behind a button. */
  private renderMenu(replay: boolean): TemplateResult {
    const toggle = (open: boolean) => {
      this.menuOpen = open;
      this.requestUpdate();
    };
    return html`<div
      class="more"
      @keydown=${(event: KeyboardEvent) => {
        if (event.key !== 'Escape' || !this.menuOpen) return;
        event.stopPropagation();
        toggle(false);
        this.renderRoot.querySelector<HTMLElement>('.more > button')?.focus();
      }}>
      <button
        class="icon-button"
        title="Pace and link"
        aria-label="Pace and link"
        aria-expanded=${this.menuOpen}
        @click=${() => toggle(!this.menuOpen)}>
        ${icon('ellipsis', 18)}
      </button>
      ${this.menuOpen
        ? html`<div class="card" role="group" aria-label="Pace and link">
            ${this.renderPace(replay)}
          </div>`
        : nothing}
    </div>`;
  }

  private renderPace(replay: boolean): TemplateResult {
    const {model} = this.context;
    const may = model.may('pace');
    const speed = replay
      ? nothing
      : html`<span>${(model.time?.speed ?? 0).toFixed(2)}× of real time</span>`;
    const paces = html`<div class="segments" role="radiogroup" aria-label="Pace">
      ${this.paces.map(
        (pace) =>
          html` <button
            role="radio"
            aria-checked=${model.time?.pace === pace}
            ?disabled=${!may}
            title=${may ? '' : model.whyNot('pace')}
            @click=${() => this.setPace(pace)}>
            ${paceText(pace)}
          </button>`,
      )}
    </div>`;
    return html`<div class="pace">
      <div><span>Pace</span>${paces}</div>
      <small
        >${speed}${this.renderLink()}${model.may('recording') && replay
          ? html` <a
              href="./recording"
              download
              title="Download the recording"
              aria-label="Download the recording"
              >${icon('download', 14)}</a
            >`
          : replay && model.isWithheld('recording')
            ? html` <span class="lacking" role="note" title=${model.whyNot('recording')}
                >${icon('lock', 13)} recording</span
              >`
            : nothing}</small
      >
    </div>`;
  }

  private renderLink(): TemplateResult {
    return html`<button
      class="text"
      title="Copy a link to this moment and camera"
      @click=${() => this.context.copyLink()}>
      ${icon('link', 13)} ${this.context.model.live ? 'Link' : 'Link to this moment'}
    </button>`;
  }

  static override styles = [
    controls,
    css`
      :host {
        display: flex;
        align-items: center;
        gap: 16px;
        height: var(--h-runbar);
        padding: 0 12px;
        background: var(--bg-1);
        border-radius: var(--r-4);
      }
      .transport {
        display: flex;
        align-items: center;
        gap: 2px;
      }
      .play {
        display: grid;
        place-items: center;
        width: 38px;
        height: 38px;
        margin: 0 4px;
        border-radius: 50%;
        background: var(--bg-3);
      }
      .play:hover:not(:disabled) {
        background: var(--bg-4);
      }
      .clock {
        display: flex;
        flex-direction: column;
        min-width: 128px;
      }
      .clock b {
        font-size: var(--fs-20);
        font-weight: var(--fw-strong);
        line-height: 1.2;
      }
      .clock span {
        color: var(--text-3);
        font-size: var(--fs-12);
        white-space: nowrap;
      }
      .pace {
        display: flex;
        flex-direction: column;
        gap: 4px;
        font-size: var(--fs-12);
        color: var(--text-2);
      }
      .pace > div {
        display: flex;
        align-items: center;
        gap: 8px;
      }
      .pace small {
        display: flex;
        align-items: center;
        gap: 8px;
        color: var(--text-3);
        font-size: var(--fs-12);
        white-space: nowrap;
      }
      .pace a {
        color: var(--text-2);
      }
      .lacking {
        display: inline-flex;
        align-items: center;
        gap: 4px;
      }
      .text {
        display: inline-flex;
        gap: 6px;
        align-items: center;
        color: var(--text-2);
      }
      .text:hover {
        color: var(--text-1);
      }
      .more {
        position: relative;
        display: none;
      }
      .card {
        position: absolute;
        right: 0;
        bottom: calc(100% + 12px);
        padding: 12px 14px;
        border: 1px solid var(--line-2);
        border-radius: var(--r-4);
        background: var(--bg-1);
        box-shadow: var(--shadow-2, 0 8px 24px rgb(0 0 0 / 0.35));
        z-index: 20;
      }
      @media (max-width: 900px) {
        :host > .pace {
          display: none;
        }
        .more {
          display: block;
        }
        .card .pace {
          gap: 10px;
        }
        .card button {
          min-height: var(--h-control, 28px);
        }
      }
      @media (max-width: 599px) {
        :host {
          gap: 8px;
          padding: 0 8px;
          border-radius: 0;
          border-top: 1px solid var(--line-1);
        }
        .transport .icon-button {
          display: none;
        }
        .more > .icon-button {
          width: 44px;
          height: 44px;
        }
        .clock {
          position: absolute;
          left: 72px;
          top: 14px;
          min-width: 84px;
        }
        .clock span {
          display: none;
        }
        :host {
          position: relative;
        }
        .play {
          width: 44px;
          height: 44px;
        }
        rave-timeline {
          margin-top: 34px;
        }
      }
    `,
  ];
}

function paceText(pace: number): string {
  if (pace === 0) return 'Max';
  return `${({0.25: '¼', 0.5: '½'} as Record<number, string>)[pace] ?? pace}×`;
}

customElements.define('rave-run-bar', RunBar);
