// SPDX-License-Identifier: Apache-2.0
import {css, html, nothing, svg, type TemplateResult} from 'lit';
import {icon} from '../../ui/icons';
import {LiveElement} from '../../ui/live_element';
import {controls} from '../../ui/styles';
import {rightText} from '../../model/withheld';
import type {Host} from '../../protocol/messages';
import {renderNote, withheldStyles} from '../withheld';
import {kColumns, matches} from './columns';
import {Rates, shortTime} from './rates';

const kPlot = [40, 12] as const;
/** Fewer hosts are found with the eyes. */
const kFilterFrom = 4;

/** The processes of the run, in the columns and words of `rave top`. */
export class HostsPanel extends LiveElement {
  private readonly rates = new Rates();
  private text = '';

  protected override listen(): (() => void)[] {
    const {model} = this.context;
    this.rates.add(model.hosts);
    return [
      model.hostsChanged.on(() => {
        this.rates.add(model.hosts);
        this.requestUpdate();
      }),
      ...this.renderAfter(model.runChanged),
    ];
  }

  override render(): TemplateResult {
    const {model} = this.context;
    if (model.hosts.length === 0) return this.renderNone();
    const late = model.hosts.filter((host) => host.state !== 'here');
    const shown = model.hosts.filter((host) => matches(host, this.text));
    return html`${model.hosts.length < kFilterFrom && this.text === ''
        ? nothing
        : this.renderFilter()}
      <div class="scroll" tabindex="0" role="region" aria-label="Hosts">
        <table>
          <thead>
            <tr>
              <th>Host</th>
              <th>State</th>
              <th class="n">Real+sim</th>
              <th class="n wide">Step</th>
              <th class="n">Steps/s</th>
              <th class="wide"></th>
              ${kColumns.map(
                (column) =>
                  html`<th class="n w${column.from}" title=${column.title}>${column.heading}</th>`,
              )}
            </tr>
          </thead>
          <tbody>
            ${shown.map((host) => this.renderRow(host))}
          </tbody>
        </table>
      </div>
      ${shown.length === 0 ? html`<p>No host matches “${this.text}”.</p>` : nothing}
      ${late.length === 0
        ? nothing
        : html`<div class="waits">${icon('hourglass', 15)}<span>${lateText(late)}</span></div>`}`;
  }

  private renderNone(): TemplateResult {
    const {model} = this.context;
    if (!model.live) return html`<p>A recording has no statistics of its hosts.</p>`;
    // They come before the first picture, if they come at all.
    if (!model.seesLess || model.poses.newest === null) return html`<p>No host is known yet.</p>`;
    return renderNote(
      this.context,
      'You may not see hosts. The list has the number of robots of each host, so it requires ' +
        `the right to see all robots. ${rightText('pose', model.others)}`,
    );
  }

  private renderRow(host: Host): TemplateResult {
    const state =
      host.state === 'late' && host.late_s !== undefined
        ? `late ${shortTime(host.late_s)}`
        : host.state;
    const robots = host.real + host.simulated > 0;
    return html`<tr
      tabindex=${robots ? '0' : nothing}
      title=${robots ? 'Select its robots' : ''}
      @click=${() => this.select(host)}
      @keydown=${(event: KeyboardEvent) => {
        if (event.key === 'Enter') this.select(host);
      }}>
      <td title=${host.machine}><b>${host.name}</b> <em class="wide">${host.machine}</em></td>
      <td><span class="state ${host.state}">${state}</span></td>
      <td class="n">${robots ? `${host.real}+${host.simulated}` : ''}</td>
      <td class="n wide">${host.step}</td>
      <td class="n">${Number(host.steps_per_s.toPrecision(3))}</td>
      <td class="plot wide">
        <svg width=${kPlot[0]} height=${kPlot[1]} class=${host.state} aria-hidden="true">
          ${svg`<polyline points=${this.rates.points(host.name, ...kPlot)} />`}
        </svg>
      </td>
      ${kColumns.map(
        (column) =>
          html`<td class="n w${column.from} ${column.tone?.(host) ?? ''}">
            ${column.text(host)}
          </td>`,
      )}
    </tr>`;
  }

  private renderFilter(): TemplateResult {
    return html`<label class="field"
      >${icon('filter', 13)}<input
        placeholder="name, machine, state"
        aria-label="Filter hosts"
        .value=${this.text}
        @input=${(event: InputEvent) => {
          this.text = (event.target as HTMLInputElement).value;
          this.requestUpdate();
        }}
    /></label>`;
  }

  private select(host: Host): void {
    const {model, selection} = this.context;
    // Robots of a run of one process name no host: all are of this one.
    const slots = model.robots.flatMap((robot, slot) =>
      (robot.host ?? host.name) === host.name ? [slot] : [],
    );
    if (slots.length > 0) selection.set(slots);
  }

  static override styles = [
    controls,
    withheldStyles,
    css`
      :host {
        display: block;
        height: 100%;
        background: var(--bg-1);
        overflow: auto;
        font-size: var(--fs-12);
        container-type: inline-size;
      }
      .field {
        display: flex;
        margin: 8px 12px;
      }
      /* Columns come by their weight, as in the terminal. */
      .w560,
      .w680,
      .w820,
      .w980,
      .w1140 {
        display: none;
      }
      @container (min-width: 560px) {
        .w560 {
          display: table-cell;
        }
      }
      @container (min-width: 680px) {
        .w680 {
          display: table-cell;
        }
      }
      @container (min-width: 820px) {
        .w820 {
          display: table-cell;
        }
      }
      @container (min-width: 980px) {
        .w980 {
          display: table-cell;
        }
      }
      @container (min-width: 1140px) {
        .w1140 {
          display: table-cell;
        }
      }
      /* In a narrow column: is it here, how fast, and what it takes. */
      @container (max-width: 420px) {
        .wide {
          display: none;
        }
        th,
        td {
          padding: 0 5px;
        }
      }
      .scroll {
        overflow-x: auto;
      }
      table {
        border-collapse: collapse;
        width: 100%;
        white-space: nowrap;
      }
      th {
        position: sticky;
        top: 0;
        height: 30px;
        background: var(--bg-1);
        color: var(--text-3);
        font-weight: 400;
        font-size: var(--fs-11);
        text-align: left;
      }
      th,
      td {
        padding: 0 8px;
        border-bottom: 1px solid var(--line-1);
      }
      th:first-child,
      td:first-child {
        padding-left: 14px;
      }
      td {
        height: var(--h-row);
      }
      tbody tr[tabindex] {
        cursor: pointer;
      }
      tbody tr:hover {
        background: var(--bg-2);
      }
      .n {
        text-align: right;
      }
      .plot {
        padding: 0;
      }
      b {
        font-weight: var(--fw-strong);
      }
      em {
        font-style: normal;
        color: var(--text-3);
      }
      .state {
        padding: 1px 7px;
        border-radius: var(--r-2);
      }
      .state.here {
        background: var(--ok-soft);
        color: var(--ok);
      }
      .state.late,
      .state.waiting {
        background: var(--warn-soft);
        color: var(--warn);
      }
      .state.gone,
      .state.dropped {
        background: var(--danger-soft);
        color: var(--danger);
      }
      .zero {
        color: var(--text-3);
      }
      .care {
        color: var(--warn);
        font-weight: var(--fw-strong);
      }
      polyline {
        fill: none;
        stroke: var(--text-2);
        stroke-width: 1;
      }
      svg.late polyline,
      svg.gone polyline {
        stroke: var(--warn);
      }
      .waits {
        display: flex;
        align-items: center;
        gap: 10px;
        margin: 10px;
        padding: 8px 12px;
        border-radius: var(--r-3);
        background: var(--warn-soft);
        color: var(--warn);
      }
      .waits span {
        color: var(--text-1);
      }
      p {
        margin: 12px 14px;
        color: var(--text-3);
      }
    `,
  ];
}

const kStates = {
  gone: 'gone',
  dropped: 'dropped, the run continues without it',
  waiting: 'not in the run yet',
};

function lateText(hosts: readonly Host[]): string {
  const names = hosts.map((host) => host.name).join(', ');
  for (const state of ['gone', 'dropped', 'waiting'] as const) {
    if (hosts.every((host) => host.state === state)) return `${names}: ${kStates[state]}`;
  }
  const late_s = hosts.length === 1 ? hosts[0].late_s : undefined;
  return `No answer from ${names}${late_s === undefined ? '' : ` for ${shortTime(late_s)}`}`;
}

customElements.define('rave-hosts', HostsPanel);
