// SPDX-License-Identifier: Apache-2.0
import {css, html, nothing, type TemplateResult} from 'lit';
import {roundStep} from '../panels/world/ticks';
import type {Event} from '../protocol/messages';
import {clockText, tickClock} from '../ui/clock';
import {LiveElement} from '../ui/live_element';
import {nowOf, spanOf} from '../model/moment';
import {controls} from '../ui/styles';

/** Events so near to each other become one mark, pixels. */
const kMark_px = 9;
/** With so much room a mark says what it is. */
const kLabel_px = 150;
const kRefresh_ms = 50;
/** A recording may end a step before the planned end; its last tick is shown all the same. */
const kEndSlack = 0.002;

/** From the begin to the planned end: a knob to move in a replay, a head that goes by itself in a
 * live run. */
export class Timeline extends LiveElement {
  private dragging = false;
  private width = 800;
  private queued = false;
  private readonly resized = new ResizeObserver(() => this.measure());

  protected override listen(): (() => void)[] {
    const {model, palette} = this.context;
    return [
      ...this.renderAfter(
        model.timeChanged,
        model.eventsChanged,
        model.runChanged,
        palette.changed,
      ),
      model.pictureChanged.on(() => this.queue()),
      () => this.resized.disconnect(),
    ];
  }

  override firstUpdated(): void {
    this.resized.observe(this);
    this.measure();
  }

  private queue(): void {
    if (this.queued) return;
    this.queued = true;
    setTimeout(() => {
      this.queued = false;
      this.requestUpdate();
    }, kRefresh_ms);
  }

  private measure(): void {
    this.width = this.renderRoot.querySelector('.line')?.clientWidth ?? 800;
    this.requestUpdate();
  }

  private x(time_s: number): number {
    const [begin, end] = spanOf(this.context.model);
    return ((time_s - begin) / (end - begin)) * this.width;
  }

  override render(): TemplateResult {
    const {model} = this.context;
    const [begin, end] = spanOf(model);
    const now_s = nowOf(model);
    const now = this.x(now_s);
    const known = this.x(model.live ? now_s : (model.time?.end_s ?? end));
    const may = model.may('seek');
    const step = tickStep((end - begin) / Math.max(this.width / 90, 1));
    const ticks: number[] = [];
    for (let t = Math.ceil(begin / step) * step; t <= end + kEndSlack * (end - begin); t += step)
      ticks.push(Math.min(t, end));
    return html`<div
      class="line ${model.live ? 'live' : ''}"
      role=${may ? 'slider' : 'img'}
      tabindex=${may ? '0' : nothing}
      aria-label="Time of the run"
      aria-valuemin=${may ? begin : nothing}
      aria-valuemax=${may ? end : nothing}
      aria-valuenow=${may ? now_s.toFixed(1) : nothing}
      aria-valuetext=${may ? `${clockText(now_s)} s` : nothing}
      title=${may ? '' : model.whyNot('seek')}
      @pointerdown=${this.down}
      @pointermove=${this.drag}
      @pointerup=${this.up}
      @pointercancel=${this.up}
      @keydown=${this.key}>
      <div class="marks">${this.renderMarks()}</div>
      <div class="track">
        <div class="known" style="width:${Math.max(0, known)}px"></div>
        <div class="past" style="width:${Math.max(0, now)}px"></div>
        <div class=${model.live ? 'head' : 'knob'} style="left:${now}px"></div>
      </div>
      <div class="ticks">
        ${ticks.map((t) => html`<span style="left:${this.x(t)}px">${tickClock(t)}</span>`)}
      </div>
    </div>`;
  }

  /** Marks of events; many near each other are a density. */
  private renderMarks(): TemplateResult[] {
    const bins = new Map<number, Event[]>();
    for (const event of this.context.model.events) {
      const bin = Math.round(this.x(event.t) / kMark_px);
      const others = bins.get(bin);
      if (others === undefined) bins.set(bin, [event]);
      else others.push(event);
    }
    const taken = [...bins.keys()].sort((a, b) => a - b);
    return [...bins].map(([bin, events]) => {
      const left = `left:${bin * kMark_px}px`;
      const worst = events.some((event) => event.level === 'alert')
        ? 'alert'
        : events.some((event) => event.level === 'warn')
          ? 'warn'
          : 'info';
      const title =
        events.length === 1 ? events[0].text : `${events.length} events: ${events[0].text}`;
      if (events.length > 3)
        return html`<i
          class="density ${worst}"
          style="${left};height:${Math.min(4 + 3 * events.length, 18)}px"
          title=${title}></i>`;
      const next = taken.find((other) => other > bin) ?? Infinity;
      const room = Math.min((next - bin) * kMark_px, this.width - bin * kMark_px) > kLabel_px;
      return html`<i class="mark ${worst}" style=${left} title=${title}></i> ${worst === 'info' ||
        !room
          ? nothing
          : html`<span class="label" style=${left}>${this.shortText(events[0])}</span>`}`;
    });
  }

  /** Who, and what kind of event: `real-4 stale`. */
  private shortText(event: Event): string {
    return `${this.context.model.robots[event.slots[0]]?.name ?? ''} ${event.kind}`.trim();
  }

  private timeAt(event: PointerEvent): number {
    const [begin, end] = spanOf(this.context.model);
    const box = this.renderRoot.querySelector('.line')?.getBoundingClientRect();
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

  private up(): void {
    this.dragging = false;
  }

  private key(event: KeyboardEvent): void {
    const {model} = this.context;
    const by = {ArrowLeft: -1, ArrowRight: 1, PageDown: -10, PageUp: 10}[event.key];
    if (by === undefined || !model.may('seek')) return;
    event.preventDefault();
    const [begin, end] = spanOf(model);
    this.context.seek(Math.min(Math.max(nowOf(model) + by, begin), end));
  }

  static override styles = [
    controls,
    css`
      :host {
        display: block;
        flex: 1;
        min-width: 60px;
      }
      .line {
        position: relative;
        height: 58px;
        cursor: pointer;
        touch-action: none;
        margin: 0 8px;
      }
      .line[role='img'] {
        cursor: default;
      }
      .marks {
        position: absolute;
        inset: 0 0 34px;
      }
      .marks i {
        position: absolute;
        bottom: 2px;
        transform: translateX(-50%);
      }
      .mark.info {
        width: 6px;
        height: 6px;
        border-radius: 50%;
        background: var(--text-3);
      }
      .mark.warn {
        border: 5px solid transparent;
        border-bottom: 8px solid var(--warn);
        border-top: 0;
      }
      .mark.alert {
        width: 8px;
        height: 8px;
        background: var(--danger);
        transform: translateX(-50%) rotate(45deg) !important;
      }
      .label {
        position: absolute;
        bottom: -1px;
        margin-left: 9px;
        color: var(--warn);
        font-size: var(--fs-11);
        white-space: nowrap;
      }
      .density {
        width: 5px;
        background: var(--text-3);
        opacity: 0.8;
      }
      .density.warn {
        background: var(--warn);
      }
      .density.alert {
        background: var(--danger);
      }
      .track {
        position: absolute;
        left: 0;
        right: 0;
        top: 26px;
        height: 8px;
        border-radius: 4px;
        background:
          repeating-linear-gradient(135deg, var(--line-2) 0 1px, transparent 1px 5px), var(--bg-2);
      }
      .known {
        position: absolute;
        left: 0;
        top: 0;
        bottom: 0;
        border-radius: 4px;
        background: var(--bg-4);
      }
      .past {
        position: absolute;
        left: 0;
        top: 3px;
        height: 2px;
        background: var(--intent);
      }
      .live .past {
        background: var(--ok);
      }
      .knob {
        position: absolute;
        top: -3px;
        width: 14px;
        height: 14px;
        margin-left: -7px;
        border-radius: 50%;
        background: var(--intent-fill);
        border: 3px solid var(--bg-1);
        box-shadow: 0 0 0 1px var(--intent);
      }
      .head {
        position: absolute;
        top: -1px;
        width: 10px;
        height: 10px;
        margin-left: -5px;
        border-radius: 50%;
        background: var(--ok);
        border: 1px solid var(--bg-1);
      }
      .head::after {
        content: '';
        position: absolute;
        left: 3px;
        top: -3px;
        width: 2px;
        height: 14px;
        background: var(--ok);
        opacity: 0.8;
      }
      .ticks {
        position: absolute;
        left: 0;
        right: 0;
        top: 38px;
        color: var(--text-3);
        font-size: var(--fs-11);
      }
      .ticks span {
        position: absolute;
        transform: translateX(-50%);
        white-space: nowrap;
      }
      .ticks span:first-child {
        transform: none;
      }
      .ticks span:last-child:not(:first-child) {
        transform: translateX(-80%);
      }
      @media (max-width: 599px) {
        .marks,
        .ticks {
          display: none;
        }
        .line {
          height: 24px;
        }
        .track {
          top: 8px;
        }
      }
    `,
  ];
}

/** Clocks are read in halves and quarters of minutes. */
function tickStep(least_s: number): number {
  if (least_s <= 5) return roundStep(least_s);
  return (
    [10, 15, 30, 60, 120, 300, 600, 900, 1800, 3600].find((step) => step >= least_s) ??
    roundStep(least_s)
  );
}

customElements.define('rave-timeline', Timeline);
