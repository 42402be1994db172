// SPDX-License-Identifier: Apache-2.0
import {css, html, nothing, type TemplateResult} from 'lit';
import {icon, type IconName} from '../../ui/icons';
import {LiveElement} from '../../ui/live_element';
import {controls} from '../../ui/styles';
import {logOf} from '../../model/run_begin';
import type {Event} from '../../protocol/messages';
import {clockText} from '../../ui/clock';
import {renderWithheld, withheldStyles} from '../withheld';
import {foldSame, shownSlots, type LogRow} from './same_events';

const kRows = 300;

/** What happened, newest on top. In a replay a line says where now is. */
export class LogPanel extends LiveElement {
  private alertsOnly = false;
  private text = '';
  private shownSecond = -1;

  protected override listen(): (() => void)[] {
    const {model, palette} = this.context;
    return [
      ...this.renderAfter(
        model.eventsChanged,
        model.rosterChanged,
        model.timeChanged,
        palette.changed,
      ),
      model.pictureChanged.on(() => {
        // The line moves with the replay, but a second is fine enough for reading.
        const second = Math.floor(2 * (model.poses.newest?.time_s ?? 0));
        if (second === this.shownSecond) return;
        this.shownSecond = second;
        this.requestUpdate();
      }),
    ];
  }

  override render(): TemplateResult {
    const {model} = this.context;
    const all = foldSame(
      logOf(model),
      model.robots.map((robot) => robot.name),
    );
    const alerts = all.filter((event) => event.level !== 'info').length;
    const shown = all.filter((event) => this.accepts(event)).reverse();
    const now_s = model.poses.newest?.time_s ?? Infinity;
    const replay = model.hello?.run.source === 'replay';
    let lineDrawn = !replay;
    const rows = shown.slice(0, kRows).map((event) => {
      const future = replay && event.t > now_s;
      const line = !future && !lineDrawn;
      lineDrawn ||= line;
      return html`${line ? this.renderNow(now_s) : nothing}${this.renderRow(
        event,
        future,
        replay && now_s >= event.t && now_s <= event.until,
      )}`;
    });
    return html`${this.renderBar(alerts)}
      <div class="rows">
        ${rows}${lineDrawn || rows.length === 0 ? nothing : this.renderNow(now_s)}
        ${shown.length > kRows
          ? html`<p>${shown.length - kRows} older events: filter to see them.</p>`
          : nothing}
        ${shown.length > 0
          ? nothing
          : !model.may('log')
            ? renderWithheld(this.context, 'log')
            : html`<p>
                ${all.length === 0 ? 'Nothing has happened yet.' : 'No event matches the filter.'}
              </p>`}
      </div>`;
  }

  /** Which events are shown. */
  private renderBar(alerts: number): TemplateResult {
    return html`<div class="bar">
      <div class="segments" role="radiogroup" aria-label="Which events">
        <button
          role="radio"
          aria-checked=${!this.alertsOnly}
          @click=${() => this.showAlerts(false)}>
          All
        </button>
        <button role="radio" aria-checked=${this.alertsOnly} @click=${() => this.showAlerts(true)}>
          Alerts ${alerts}
        </button>
      </div>
      <label class="field"
        >${icon('filter', 13)}<input
          placeholder="source, text"
          aria-label="Filter events"
          .value=${this.text}
          @input=${(event: InputEvent) => {
            this.text = (event.target as HTMLInputElement).value.toLowerCase();
            this.requestUpdate();
          }}
      /></label>
    </div>`;
  }

  private showAlerts(only: boolean): void {
    this.alertsOnly = only;
    this.requestUpdate();
  }

  private accepts(event: Event): boolean {
    if (this.alertsOnly && event.level === 'info') return false;
    if (this.text === '') return true;
    const names = event.slots.map((slot) => this.context.model.robots[slot]?.name ?? '').join(' ');
    return `${event.kind} ${event.text} ${names}`.toLowerCase().includes(this.text);
  }

  private renderNow(now_s: number): TemplateResult {
    return html`<div class="now"><b>${clockText(now_s)} now</b><i></i></div>`;
  }

  private renderRow(event: LogRow, future: boolean, present: boolean): TemplateResult {
    const until =
      event.count > 1 && event.until > event.t ? `, until ${clockText(event.until)}` : '';
    return html`<button
      class="row ${event.level} ${future ? 'future' : ''} ${present ? 'present' : ''}"
      title=${this.context.model.may('seek') ? 'Go to this moment' : event.kind}
      @click=${() => this.open(event)}>
      <time>${clockText(event.t)}</time>${icon(iconOf(event), 14)}
      <span>${this.renderText(event)}${until}</span>
      ${event.count > 1 ? html`<em>×${event.count}</em>` : nothing}
    </button>`;
  }

  /** Names of robots in the colour of their robot. */
  private renderText(event: LogRow): (TemplateResult | string)[] {
    const {model, palette} = this.context;
    if (event.what !== '') return this.renderMany(event);
    let parts: (TemplateResult | string)[] = [event.text];
    for (const slot of event.slots) {
      const name = model.robots[slot]?.name;
      if (name === undefined) continue;
      parts = parts.flatMap((part): (TemplateResult | string)[] => {
        if (typeof part !== 'string') return [part];
        const pieces = part.split(
          new RegExp(`\\b${name.replace(/[.*+?^${}()|[\]\\]/g, '\\$&')}(?![\\w-])`),
        );
        return pieces.flatMap((piece, i): (TemplateResult | string)[] =>
          i === 0 ? [piece] : [html`<b style="color:${palette.hue(slot).ink}">${name}</b>`, piece],
        );
      });
    }
    return parts;
  }

  /** `real-1 … real-5: stopped`; the tooltip has all names. */
  private renderMany(event: LogRow): (TemplateResult | string)[] {
    const {model, palette} = this.context;
    const name = (slot: number) =>
      html`<b style="color:${palette.hue(slot).ink}">${model.robots[slot]?.name}</b>`;
    const {first, last} = shownSlots(event.slots);
    return [
      html`<span title=${event.slots.map((slot) => model.robots[slot]?.name).join(', ')}
          >${first.map((slot, i) => html`${i > 0 ? ', ' : ''}${name(slot)}`)}${last === null
            ? nothing
            : html` … ${name(last)}`}</span
        >: ${event.what}`,
    ];
  }

  private open(event: LogRow): void {
    if (event.slots.length > 0)
      this.context.selection.set(event.what === '' ? event.slots.slice(0, 2) : event.slots);
    this.context.seek(event.t);
  }

  static override styles = [
    controls,
    withheldStyles,
    css`
      :host {
        display: flex;
        flex-direction: column;
        height: 100%;
        background: var(--bg-1);
      }
      .bar {
        display: flex;
        gap: 8px;
        padding: 8px 12px;
      }
      .bar .field {
        flex: 1;
      }
      .rows {
        flex: 1;
        overflow: auto;
        padding: 0 4px 8px;
      }
      .row {
        display: grid;
        grid-template-columns: 58px 16px 1fr auto;
        gap: 6px;
        width: 100%;
        padding: 4px 8px;
        text-align: left;
        font-size: var(--fs-12);
        border-radius: var(--r-2);
        line-height: 1.4;
      }
      @media (pointer: coarse) {
        .row {
          padding: 12px 8px;
        }
      }
      .row:hover {
        background: var(--bg-2);
      }
      .row time {
        text-align: right;
        color: var(--text-3);
      }
      .row svg {
        margin-top: 1px;
        color: var(--text-3);
      }
      .row.warn svg {
        color: var(--warn);
      }
      .row.alert svg {
        color: var(--danger);
      }
      .row em {
        align-self: start;
        padding: 0 6px;
        border-radius: var(--r-2);
        background: var(--bg-3);
        color: var(--text-2);
        font-style: normal;
        font-size: var(--fs-11);
      }
      .row.future {
        color: var(--text-3);
      }
      .row.present {
        background: var(--intent-soft);
      }
      .row b {
        font-weight: var(--fw-strong);
      }
      .now {
        display: flex;
        align-items: center;
        gap: 8px;
        padding: 2px 8px;
        color: var(--intent);
        font-size: var(--fs-12);
      }
      .now i {
        flex: 1;
        height: 1px;
        background: var(--intent-line);
      }
      p {
        margin: 8px 12px;
        color: var(--text-3);
        font-size: var(--fs-12);
      }
    `,
  ];
}

function iconOf(event: Event): IconName {
  if (event.level === 'alert') return 'circleX';
  if (event.level === 'warn') return 'triangleAlert';
  if (event.kind === 'begin') return 'play';
  if (event.kind.includes('contact')) return 'zap';
  if (event.kind.includes('captur')) return 'target';
  return 'info';
}

customElements.define('rave-log', LogPanel);
