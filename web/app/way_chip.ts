// SPDX-License-Identifier: Apache-2.0
import {css, html, nothing, type TemplateResult} from 'lit';
import {icon} from '../ui/icons';
import {LiveElement} from '../ui/live_element';
import {controls} from '../ui/styles';

const kUntrusted =
  'In most cases the browser does not trust the certificate of this host yet. Click for the steps.';
const kBlocked =
  'The host has joined or changed its address since this page was loaded, ' +
  'so the security policy of the page does not include it.';
const kNoLine =
  'No host has a direct line (rave robot --web), and the scenario permits no relay ' +
  '(gui: {relay: true}). STOP goes through this server.';

/** Which way the orders of this page go, and how long it takes. */
export class WayChip extends LiveElement {
  protected override listen(): (() => void)[] {
    const {link, model} = this.context;
    return this.renderAfter(
      link.changed,
      model.runChanged,
      ...(link.direct ? [link.direct.changed] : []),
    );
  }

  override render(): TemplateResult | typeof nothing {
    const {link, model} = this.context;
    const lines = link.direct;
    if (lines === null || !model.live || !model.may('stop') || model.hello?.seen_by !== undefined)
      return nothing;
    const bad = [...lines.lines.values()].filter((line) => line.state !== 'open');
    const untrusted = bad.find((line) => line.state === 'untrusted');
    if (untrusted) {
      return html`<button
        class="chip warn"
        title=${kUntrusted}
        @click=${() =>
          this.dispatchEvent(new CustomEvent('trust', {bubbles: true, composed: true}))}>
        ${icon('wifiOff', 14)} Trust ${untrusted.ticket.host}
      </button>`;
    }
    const blocked = bad.find((line) => line.state === 'blocked');
    if (blocked) {
      return html`<button class="chip warn" title=${kBlocked} @click=${() => location.reload()}>
        Reload to reach ${blocked.ticket.host}
      </button>`;
    }
    if (lines.open.length > 0) {
      const ms = lines.latency_ms;
      const part = bad.length > 0 ? ` ${lines.open.length} of ${lines.lines.size}` : '';
      return html`<span
        class="chip"
        title="Orders go directly to the hosts of the robots, even if this server fails."
        >Direct${part}${ms === null ? '' : ` ${ms < 10 ? ms.toFixed(1) : Math.round(ms)} ms`}</span
      >`;
    }
    if (lines.relay)
      return html`<span class="chip" title="Orders go through this server.">Via server</span>`;
    return html`<span class="chip warn" title=${lines.why || kNoLine}>No orders</span>`;
  }

  static override styles = [
    controls,
    css`
      :host {
        display: inline-flex;
      }
      .chip {
        display: inline-flex;
        align-items: center;
        gap: 6px;
        padding: 0 8px;
        min-height: 24px;
        border: 1px solid var(--line-2);
        border-radius: var(--r-3);
        color: var(--text-2);
        font-size: var(--fs-12);
        white-space: nowrap;
        text-decoration: none;
        font-variant-numeric: tabular-nums;
      }
      .warn {
        border-color: var(--warn);
        color: var(--warn);
        background: var(--warn-soft);
      }
      @media (max-width: 599px) {
        .chip:not(.warn) {
          display: none;
        }
      }
    `,
  ];
}

customElements.define('rave-way', WayChip);
