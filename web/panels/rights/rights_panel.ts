// SPDX-License-Identifier: Apache-2.0
import {css, html, nothing, type TemplateResult} from 'lit';
import {icon} from '../../ui/icons';
import {LiveElement} from '../../ui/live_element';
import {controls} from '../../ui/styles';
import {roleText} from '../../ui/words';
import type {Reach, SetRight} from '../../protocol/messages';
import {className, nextReach, reachText, rowsOf, type Cell, type Row} from './reach';

/** A change that was asked for. */
interface Change {
  asked: SetRight;
  before: Reach | null;
  text: string;
  sent_ms: number;
  /** Until the server told of it, seconds; null as long as it has not. */
  took_s: number | null;
}

/** Who gets what: rows are roles and people, columns classes. For super-users. */
export class RightsPanel extends LiveElement {
  private chosen = '';
  private change: Change | null = null;

  protected override listen(): (() => void)[] {
    const {model} = this.context;
    return [
      model.rightsChanged.on(() => {
        if (this.change !== null)
          this.change.took_s ??= (performance.now() - this.change.sent_ms) / 1000;
        this.requestUpdate();
      }),
      ...this.renderAfter(model.runChanged),
    ];
  }

  override render(): TemplateResult {
    const {model} = this.context;
    const {rights} = model;
    if (rights === null)
      return html`<p>
        ${model.may('rights') ? 'Waiting for the rights.' : model.whyNot('rights')}
      </p>`;
    const {roles, people} = rowsOf(rights);
    return html` <div class="bar">
        <span><i class="cell all">${icon('check', 12)}</i>all robots</span
        ><span
          ><i class="cell own"><i></i></i>own teams only</span
        >
        <span><i class="cell none">–</i>no right</span><b></b>
        <button class="see" ?disabled=${this.chosen === ''} @click=${() => this.seeAs()}>
          ${icon('eye', 15)} See as ${this.chosen === '' ? '…' : this.chosenName()}
        </button>
      </div>
      <div class="scroll" tabindex="0" role="region" aria-label="Rights">
        <table>
          <thead>
            <tr>
              <th></th>
              ${rights.classes.map((what) => html`<th scope="col">${className(what)}</th>`)}
            </tr>
          </thead>
          <tbody>
            <tr class="part">
              <th colspan=${rights.classes.length + 1}>Roles</th>
            </tr>
            ${roles.map((row) => this.renderRow(row, rights.classes))}
            ${people.length === 0
              ? nothing
              : html`<tr class="part">
                  <th colspan=${rights.classes.length + 1}>People</th>
                </tr>`}
            ${people.map((row) => this.renderRow(row, rights.classes))}
          </tbody>
        </table>
      </div>
      ${this.renderChange()}`;
  }

  private renderRow(row: Row, classes: readonly string[]): TemplateResult {
    const key = row.user ?? row.role ?? '';
    const name = row.user ?? roleText(row.role ?? '');
    return html`<tr
      class=${this.chosen === key ? 'chosen' : ''}
      @click=${() => {
        this.chosen = key;
        this.requestUpdate();
      }}>
      <th scope="row">
        <button
          @click=${() => {
            this.chosen = key;
            this.requestUpdate();
          }}>
          ${name}<small>${row.note}</small>
        </button>
      </th>
      ${classes.map((what) => html`<td>${this.renderCell(row, name, what)}</td>`)}
    </tr>`;
  }

  private renderCell(row: Row, name: string, what: string): TemplateResult {
    const cell = row.cells.get(what) ?? {reach: 'none', own: false};
    const look = typeof cell.reach === 'string' ? cell.reach : 'own';
    const reach = `${reachText(cell.reach)}${cell.own ? ', set here' : ''}`;
    const label = `${className(what)} of ${name}: ${reach}`;
    return html`<button
      class="cell ${look} ${cell.own ? 'set' : row.user === undefined ? '' : 'plain'}"
      ?disabled=${row.role === 'super_user'}
      title=${label}
      aria-label=${label}
      @click=${() => this.press(row, name, what, cell)}>
      ${look === 'all' ? icon('check', 14) : look === 'own' ? html`<i></i>` : '–'}
    </button>`;
  }

  private press(row: Row, name: string, what: string, cell: Cell): void {
    const reach = nextReach(cell, row.user !== undefined);
    const before = row.user !== undefined && !cell.own ? null : cell.reach;
    const now = reach === null ? 'right of the role again' : reachText(reach);
    this.ask(
      {
        type: 'set_right',
        ...(row.user === undefined ? {role: row.role as SetRight['role']} : {user: row.user}),
        class: what,
        reach,
      },
      before,
      `${name}, ${className(what).toLowerCase()}: ${now}`,
    );
  }

  private ask(asked: SetRight, before: Reach | null, text: string): void {
    this.change = {asked, before, text, sent_ms: performance.now(), took_s: null};
    this.context.link.send(asked);
    this.requestUpdate();
  }

  private renderChange(): TemplateResult | typeof nothing {
    const {change} = this;
    if (change === null) return nothing;
    return html`<div class="change" role="status">
      ${icon(change.took_s === null ? 'hourglass' : 'check', 15)}
      <span
        ><b>${change.text}</b
        ><small
          >${change.took_s === null
            ? 'asked for'
            : `in force after ${change.took_s.toFixed(2)} s`}</small
        ></span
      >
      <button
        @click=${() =>
          this.ask({...change.asked, reach: change.before}, change.asked.reach, 'Undone')}>
        Undo
      </button>
      <button
        aria-label="Close"
        @click=${() => {
          this.change = null;
          this.requestUpdate();
        }}>
        ${icon('x', 14)}
      </button>
    </div>`;
  }

  private isRole(): boolean {
    return ['observer', 'commander', 'super_user'].includes(this.chosen);
  }

  private chosenName(): string {
    return this.isRole() ? roleText(this.chosen) : this.chosen;
  }

  private seeAs(): void {
    if (this.chosen === '') return;
    this.context.link.send(
      this.isRole()
        ? {type: 'see_as', role: this.chosen as 'observer'}
        : {type: 'see_as', user: this.chosen},
    );
  }

  static override styles = [
    controls,
    css`
      :host {
        display: flex;
        flex-direction: column;
        position: relative;
        height: 100%;
        background: var(--bg-1);
        font-size: var(--fs-12);
      }
      .bar {
        display: flex;
        align-items: center;
        flex-wrap: wrap;
        gap: 6px 14px;
        padding: 8px 14px;
        color: var(--text-2);
      }
      .bar span {
        display: inline-flex;
        align-items: center;
        gap: 6px;
      }
      .bar b {
        flex: 1;
      }
      .see {
        display: inline-flex;
        align-items: center;
        gap: 6px;
        height: 28px;
        padding: 0 12px;
        border: 1px solid var(--line-2);
        border-radius: var(--r-3);
        font-weight: var(--fw-medium);
      }
      .scroll {
        flex: 1;
        overflow: auto;
      }
      table {
        border-collapse: collapse;
        width: 100%;
        white-space: nowrap;
      }
      th {
        font-weight: 400;
        text-align: left;
      }
      thead th {
        position: sticky;
        top: 0;
        z-index: 1;
        padding: 4px 2px;
        background: var(--bg-1);
        color: var(--text-2);
        font-size: var(--fs-11);
        line-height: 1.25;
        text-align: center;
        vertical-align: bottom;
        white-space: normal;
      }
      .part th {
        padding: 8px 14px 4px;
        color: var(--text-2);
        font-weight: var(--fw-medium);
      }
      tbody tr:not(.part) {
        border-top: 1px solid var(--line-1);
      }
      tbody tr:not(.part):hover {
        background: var(--bg-2);
      }
      tr.chosen,
      tr.chosen:hover {
        background: var(--intent-soft) !important;
      }
      tbody th button {
        padding: 5px 14px;
        text-align: left;
        font-weight: var(--fw-strong);
      }
      small {
        display: block;
        color: var(--text-2);
        font-size: var(--fs-11);
        font-weight: 400;
      }
      td {
        padding: 3px 2px;
        text-align: center;
      }
      .cell {
        position: relative;
        display: inline-grid;
        place-items: center;
        width: 32px;
        height: 24px;
        border-radius: var(--r-2);
        font-style: normal;
        color: var(--text-2);
        background: var(--bg-3);
      }
      .cell.all {
        background: var(--ok-soft);
        color: var(--ok);
      }
      .cell.own {
        background: var(--warn-soft);
        color: var(--warn);
      }
      .cell.own > i {
        width: 12px;
        height: 12px;
        border: 1.5px solid currentColor;
        border-radius: 50%;
        background: linear-gradient(90deg, currentColor 50%, transparent 50%);
      }
      .cell.plain {
        background: none;
      }
      .cell.set::after {
        content: '';
        position: absolute;
        right: -3px;
        top: -3px;
        width: 6px;
        height: 6px;
        border-radius: 50%;
        background: var(--intent);
      }
      .cell:disabled {
        opacity: 1;
        background: none;
        color: var(--text-2);
      }
      button.cell:hover:not(:disabled) {
        box-shadow: 0 0 0 1.5px var(--intent);
      }
      .change {
        position: absolute;
        left: 50%;
        bottom: 12px;
        transform: translateX(-50%);
        display: flex;
        align-items: center;
        gap: 10px;
        padding: 8px 12px;
        background: var(--bg-2);
        border: 1px solid var(--line-2);
        border-radius: var(--r-4);
        box-shadow: var(--shadow-pop);
        white-space: nowrap;
      }
      .change > svg {
        color: var(--ok);
      }
      .change button {
        height: 26px;
        padding: 0 10px;
        border-radius: var(--r-3);
        background: var(--bg-3);
      }
      p {
        margin: 12px 14px;
        color: var(--text-3);
      }
    `,
  ];
}

customElements.define('rave-rights', RightsPanel);
