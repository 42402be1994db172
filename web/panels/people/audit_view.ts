// SPDX-License-Identifier: Apache-2.0
import {css, html, nothing, type TemplateResult} from 'lit';
import {icon} from '../../ui/icons';
import {LiveElement} from '../../ui/live_element';
import {controls} from '../../ui/styles';
import type {AuditLine} from '../../protocol/messages';
import {auditText, auditTime, kAuditKinds, whoText} from './people';
import {peopleStyles} from './styles';

const kFew = 200;
const kMost = 1000;
/** Lines come in bursts, and so do letters that are typed. */
const kWait_ms = 300;

/** Who did what, newest first; for super-users. */
export class AuditView extends LiveElement {
  private kind = '';
  private typed = '';
  private most = kFew;
  private lines: readonly AuditLine[] | null = null;
  private more = false;
  private note = '';
  private timer = 0;
  private asking = false;
  private again = false;

  protected override listen(): (() => void)[] {
    const {model} = this.context;
    void this.load();
    return [
      ...this.renderAfter(model.accountsChanged),
      ...[model.auditChanged, model.runChanged].map((signal) => signal.on(() => this.soon())),
      () => {
        clearTimeout(this.timer);
        this.timer = 0;
      },
    ];
  }

  private soon(): void {
    if (this.timer !== 0) return;
    this.timer = window.setTimeout(() => {
      this.timer = 0;
      void this.load();
    }, kWait_ms);
  }

  private async load(): Promise<void> {
    const {model, commands} = this.context;
    if (!model.may('rights') || model.accounts?.kept === false) return;
    if (this.asking) {
      this.again = true;
      return;
    }
    this.asking = true;
    const answer = await commands.ask({
      type: 'audit',
      most: this.most,
      ...(this.kind === '' ? {} : {what: this.kind}),
      ...(this.typed.trim() === '' ? {} : {contains: this.typed.trim().slice(0, 90)}),
    });
    this.asking = false;
    const told = model.audit;
    if (answer.good && told !== null && told.request === answer.request) {
      this.lines = told.lines;
      this.more = told.more;
    }
    this.note = answer.good ? '' : answer.text;
    this.requestUpdate();
    if (this.again) {
      this.again = false;
      this.soon();
    }
  }

  override render(): TemplateResult {
    const {accounts} = this.context.model;
    if (accounts?.kept === false) return html`<p>${accounts.why_not}</p>`;
    const now = new Date();
    return html` <div class="bar">
        <label class="field"
          >${icon('search', 14)}<input
            aria-label="Filter the audit log"
            maxlength="90"
            placeholder="Name, address, word"
            .value=${this.typed}
            @input=${(event: Event) => {
              this.typed = (event.target as HTMLInputElement).value;
              this.soon();
            }}
        /></label>
        <select
          aria-label="Kind"
          @change=${(event: Event) => {
            this.kind = (event.target as HTMLSelectElement).value;
            this.soon();
          }}>
          <option value="">all kinds</option>
          ${kAuditKinds.map(
            (kind) =>
              html`<option value=${kind} ?selected=${kind === this.kind}>
                ${kind.replace('_', ' ')}
              </option>`,
          )}
        </select>
      </div>
      ${this.note === '' ? nothing : html`<p class="note bad" role="alert">${this.note}</p>`}
      <div class="scroll" tabindex="0" role="region" aria-label="Audit log">
        ${this.lines?.map(
          (line) =>
            html`<div class="line ${line.what === 'refused' ? 'refused' : ''}" title=${line.time}>
              <time>${auditTime(line.time, now)}</time
              ><span><b>${whoText(line)}</b> ${auditText(line)}</span>
            </div>`,
        ) ?? html`<p>Waiting for the audit log.</p>`}
        ${this.lines?.length === 0
          ? html`<p>
              ${this.kind === '' && this.typed === ''
                ? 'The audit log is empty.'
                : 'No line matches the filter.'}
            </p>`
          : nothing}
        ${this.renderOlder()}
      </div>`;
  }

  /** Where older lines are. */
  private renderOlder(): TemplateResult | typeof nothing {
    return this.more
      ? this.most < kMost
        ? html`<p>
            <button
              class="plain"
              @click=${() => {
                this.most = kMost;
                void this.load();
              }}>
              Older lines
            </button>
          </p>`
        : html`<p>Older lines are in the file audit.jsonl beside the accounts, or filter.</p>`
      : nothing;
  }

  static override styles = [
    controls,
    peopleStyles,
    css`
      .bar select {
        height: 28px;
        padding: 0 6px;
        border: 1px solid var(--line-3);
        border-radius: var(--r-3);
        background: var(--bg-2);
        color: var(--text-1);
        font: inherit;
        font-size: var(--fs-12);
      }
      .line {
        display: flex;
        gap: 12px;
        padding: 4px 14px;
        border-top: 1px solid var(--line-1);
        line-height: 1.4;
      }
      .line time {
        flex: none;
        color: var(--text-2);
        font-variant-numeric: tabular-nums;
      }
      .line span {
        min-width: 0;
        overflow-wrap: anywhere;
        color: var(--text-2);
      }
      .line b {
        color: var(--text-1);
        font-weight: var(--fw-strong);
      }
      .line.refused span {
        color: var(--danger);
      }
    `,
  ];
}

customElements.define('rave-audit', AuditView);
