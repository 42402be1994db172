// SPDX-License-Identifier: Apache-2.0
import {css, html, nothing, type TemplateResult} from 'lit';
import type {DirectLine} from '../model/direct_line';
import {icon} from '../ui/icons';
import {LiveElement} from '../ui/live_element';
import {controls} from '../ui/styles';

/** The page of a host, where a browser asks whether its certificate is to be trusted. */
export function hostPage(line: DirectLine): string {
  return `https://${new URL(line.ticket.url).host}/`;
}

/** What to do about hosts whose certificate the browser does not trust. */
export class TrustSheet extends LiveElement {
  protected override listen(): (() => void)[] {
    const {direct} = this.context.link;
    return direct === null ? [] : this.renderAfter(direct.changed);
  }

  override firstUpdated(): void {
    this.renderRoot.querySelector<HTMLElement>('[role=dialog]')?.focus();
  }

  private close(): void {
    this.dispatchEvent(new CustomEvent('done'));
  }

  override render(): TemplateResult {
    const lines = [...(this.context.link.direct?.lines.values() ?? [])].filter((line) =>
      line.ticket.url.startsWith('wss:'),
    );
    const untrusted = lines.filter((line) => line.state === 'untrusted');
    return html`<div
      class="scrim"
      @click=${(event: Event) => {
        if (event.target === event.currentTarget) this.close();
      }}>
      <div
        class="box"
        role="dialog"
        aria-modal="true"
        aria-label="Trust a host"
        tabindex="0"
        @keydown=${(event: KeyboardEvent) => {
          if (event.key === 'Escape') {
            event.stopPropagation();
            this.close();
          }
        }}>
        <h2>
          Trust a host<button class="icon-button" aria-label="Close" @click=${() => this.close()}>
            ${icon('x')}
          </button>
        </h2>
        <p class="why">
          Orders and STOP go directly to the host of a robot, encrypted.
          ${untrusted.length === 0
            ? 'All hosts answer now.'
            : 'The browser refused this connection without a reason. In most cases it does ' +
              'not trust the certificate of the host yet.'}
        </p>
        ${untrusted.length === 0 ? nothing : renderSteps(untrusted)}
      </div>
    </div>`;
  }

  static override styles = [
    controls,
    css`
      .scrim {
        position: fixed;
        inset: 0;
        display: grid;
        place-items: center;
        background: var(--scrim);
        z-index: 30;
      }
      .box {
        width: min(560px, 92vw);
        max-height: 86vh;
        overflow: auto;
        padding: 18px 24px;
        background: var(--bg-2);
        border: 1px solid var(--line-2);
        border-radius: var(--r-4);
        box-shadow: var(--shadow-pop);
      }
      h2 {
        display: flex;
        align-items: center;
        justify-content: space-between;
        margin: 0 0 8px;
        font-size: var(--fs-15);
      }
      h3 {
        margin: 14px 0 4px;
        font-size: var(--fs-13);
      }
      ol {
        margin: 0;
        padding-left: 20px;
        line-height: 1.6;
      }
      p {
        margin: 8px 0 0;
        color: var(--text-2);
        font-size: var(--fs-12);
      }
      a {
        color: var(--intent);
      }
      code {
        font: var(--fs-12) var(--font-code);
      }
    `,
  ];
}

/** What lets this browser, or all of them, trust the hosts. */
function renderSteps(untrusted: readonly DirectLine[]): TemplateResult {
  return html` <h3>For this browser</h3>
    <ol>
      <li>
        Open the page of the host:
        ${untrusted.map(
          (line) =>
            html`<a href=${hostPage(line)} target="_blank" rel="noopener">${line.ticket.host}</a> `,
        )}
      </li>
      <li>
        The browser warns of its certificate. If the address is that of your host, choose
        <b>Advanced</b>, then <b>Proceed</b> or <b>Accept the risk</b>.
      </li>
      <li>Come back here. The page connects by itself.</li>
    </ol>
    <h3>For all hosts at once</h3>
    <p>
      Install <code>authority.pem</code> of <code>rave keys web</code> as an authority of this
      browser. An administrator can install it on all devices.
    </p>
    <p>
      If the host has no page at that address, it does not run or cannot be reached from here.
    </p>`;
}

customElements.define('rave-trust', TrustSheet);
