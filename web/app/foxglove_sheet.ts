// SPDX-License-Identifier: Apache-2.0
import {LitElement, css, html, nothing, type TemplateResult} from 'lit';
import {icon} from '../ui/icons';
import {controls} from '../ui/styles';

const kOrigins = html`<p>
  Foxglove in a browser needs the option
  <code>--foxglove-origin https://app.foxglove.dev</code> of the server; its desktop program
  <code>--foxglove-origin file://</code>.
</p>`;

/** How this run is watched in Foxglove or Lichtblick: an address of one's own, and the steps. */
export class FoxgloveSheet extends LitElement {
  private address = '';
  private error = '';
  private copied = false;

  override connectedCallback(): void {
    super.connectedCallback();
    void this.ask();
  }

  override firstUpdated(): void {
    this.renderRoot.querySelector<HTMLElement>('[role=dialog]')?.focus();
  }

  /** The address has a token, so it is asked for only when the person wants to see it. */
  private async ask(): Promise<void> {
    try {
      const answer = await fetch(new URL('foxglove', document.baseURI), {cache: 'no-store'});
      const text = await answer.text();
      this.address = /wss?:\S+/.exec(text)?.[0] ?? '';
      if (!answer.ok || this.address === '')
        this.error = `The server gave no address: ${text.trim()}`;
    } catch {
      this.error = 'The server does not answer.';
    }
    this.requestUpdate();
  }

  private close(): void {
    this.dispatchEvent(new CustomEvent('done'));
  }

  private async copy(): Promise<void> {
    await navigator.clipboard?.writeText(this.address);
    this.copied = true;
    this.requestUpdate();
  }

  override render(): TemplateResult {
    return html`<div
      class="scrim"
      @click=${(event: Event) => {
        if (event.target === event.currentTarget) this.close();
      }}>
      <div
        class="box"
        role="dialog"
        aria-modal="true"
        aria-label="Watch in Foxglove"
        tabindex="0"
        @keydown=${(event: KeyboardEvent) => {
          if (event.key === 'Escape') {
            event.stopPropagation();
            this.close();
          }
        }}>
        <h2>
          Watch in Foxglove<button
            class="icon-button"
            aria-label="Close"
            @click=${() => this.close()}>
            ${icon('x')}
          </button>
        </h2>
        <ol>
          <li>
            In Foxglove or Lichtblick choose <b>Open connection</b>, <b>Foxglove WebSocket</b>.
          </li>
          <li>
            Paste this address:
            ${this.error !== ''
              ? html`<p class="bad" role="alert">${this.error}</p>`
              : html`<div class="address">
                  <code>${this.address || 'requesting the address'}</code>
                  <button
                    class="main"
                    ?disabled=${this.address === ''}
                    @click=${() => void this.copy()}>
                    ${icon(this.copied ? 'check' : 'copy', 14)} ${this.copied ? 'Copied' : 'Copy'}
                  </button>
                </div>`}
          </li>
          <li>
            Import the layout <code>share/rave/foxglove/rave-layout.json</code> of the installation.
          </li>
        </ol>
        <p>
          Foxglove shows what you may see here, and cannot send orders. Keep the address secret:
          every person who has it sees the same. It is valid until you sign out.
        </p>
        ${this.address.startsWith('ws:') ? kOrigins : nothing}
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
      ol {
        margin: 0;
        padding-left: 20px;
        line-height: 1.6;
      }
      p {
        margin: 10px 0 0;
        color: var(--text-2);
        font-size: var(--fs-12);
      }
      .bad {
        color: var(--danger);
      }
      code {
        font: var(--fs-12) var(--font-code);
        overflow-wrap: anywhere;
      }
      .address {
        display: flex;
        align-items: center;
        gap: 8px;
        margin: 6px 0;
        padding: 8px 8px 8px 12px;
        border: 1px solid var(--line-2);
        border-radius: var(--r-3);
        background: var(--bg-1);
      }
      .address code {
        flex: 1;
      }
      .main {
        display: inline-flex;
        align-items: center;
        gap: 6px;
        height: var(--h-control);
        padding: 0 12px;
        border-radius: var(--r-3);
        background: var(--intent-fill);
        color: #fff;
        font-size: var(--fs-12);
      }
    `,
  ];
}

customElements.define('rave-foxglove', FoxgloveSheet);
