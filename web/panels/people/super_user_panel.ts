// SPDX-License-Identifier: Apache-2.0
import {css, html, type TemplateResult} from 'lit';
import {LiveElement} from '../../ui/live_element';
import {controls} from '../../ui/styles';
import './audit_view';
import './invitations';
import './people_list';
import '../conduct/run_control';
import '../rights/rights_panel';
import {renderWithheld, withheldStyles} from '../withheld';

type Part = 'run' | 'rights' | 'people' | 'invitations' | 'audit';
/** From this width on the rights stand beside the others. */
const kWide_px = 1350;

/** Run control, rights, people, invitations and the audit log; for super-users. */
export class SuperUserPanel extends LiveElement {
  private chosen: Part = 'rights';
  private wide = false;

  protected override listen(): (() => void)[] {
    const {model} = this.context;
    const size = new ResizeObserver(() => {
      if (this.wide === this.clientWidth >= kWide_px) return;
      this.wide = !this.wide;
      this.requestUpdate();
    });
    size.observe(this);
    return [
      ...this.renderAfter(
        model.accountsChanged,
        model.runChanged,
        model.peopleChanged,
        model.conductChanged,
      ),
      () => size.disconnect(),
    ];
  }

  private get parts(): [Part, string][] {
    const {accounts} = this.context.model;
    const number = (count: number) => (count === 0 ? '' : `  ${count}`);
    const all: [Part, string][] = [
      ['rights', 'Rights'],
      ['people', `People${number(accounts?.people.length ?? 0)}`],
      ['invitations', `Invitations${number(accounts?.invitations.length ?? 0)}`],
      ['audit', 'Audit log'],
    ];
    const shown = this.wide ? all.slice(1) : all;
    return this.context.model.conduct === null ? shown : [['run', 'Run control'], ...shown];
  }

  override render(): TemplateResult {
    const {model} = this.context;
    if (!model.may('rights')) return renderWithheld(this.context, 'rights');
    const {parts} = this;
    const shown = parts.some(([part]) => part === this.chosen) ? this.chosen : parts[0][0];
    return html`${this.wide
        ? html`<section class="beside">
            <rave-rights .context=${this.context}></rave-rights>
          </section>`
        : ''}
      <section>
        <div
          class="tabs"
          role="tablist"
          aria-label="Super-User"
          @keydown=${(event: KeyboardEvent) => this.key(event, shown)}>
          ${parts.map(
            ([part, title]) =>
              html` <button
                role="tab"
                id=${`tab-${part}`}
                aria-selected=${part === shown}
                aria-controls="part"
                tabindex=${part === shown ? 0 : -1}
                @click=${() => this.choose(part)}>
                ${title}
              </button>`,
          )}
        </div>
        <div class="part" id="part" role="tabpanel" aria-labelledby=${`tab-${shown}`}>
          ${this.renderPart(shown)}
        </div>
      </section>`;
  }

  private renderPart(part: Part): TemplateResult {
    const {context} = this;
    if (part === 'people')
      return html`<rave-people
        .context=${context}
        @invite=${() => this.choose('invitations')}></rave-people>`;
    if (part === 'run') return html`<rave-run-control .context=${context}></rave-run-control>`;
    if (part === 'invitations')
      return html`<rave-invitations .context=${context}></rave-invitations>`;
    return part === 'audit'
      ? html`<rave-audit .context=${context}></rave-audit>`
      : html`<rave-rights .context=${context}></rave-rights>`;
  }

  choose(part: Part): void {
    this.chosen = part;
    this.requestUpdate();
  }

  private key(event: KeyboardEvent, shown: Part): void {
    const step = event.key === 'ArrowRight' ? 1 : event.key === 'ArrowLeft' ? -1 : 0;
    if (step === 0) return;
    event.preventDefault();
    const {parts} = this;
    const at = parts.findIndex(([part]) => part === shown);
    this.choose(parts[(at + step + parts.length) % parts.length][0]);
    void this.updateComplete.then(() =>
      this.renderRoot.querySelector<HTMLElement>('[aria-selected="true"]')?.focus(),
    );
  }

  static override styles = [
    controls,
    withheldStyles,
    css`
      :host {
        display: flex;
        height: 100%;
        background: var(--bg-1);
        font-size: var(--fs-12);
      }
      section {
        flex: 1;
        min-width: 0;
        display: flex;
        flex-direction: column;
      }
      /* All classes of rights without a scrollbar. */
      section.beside {
        flex: 1 0 976px;
        border-right: 1px solid var(--line-1);
      }
      section.beside ~ section {
        flex: 0 1 374px;
      }
      .tabs {
        display: flex;
        flex: none;
        gap: 2px;
        padding: 0 8px;
        border-bottom: 1px solid var(--line-1);
        overflow-x: auto;
        scrollbar-width: none;
      }
      .tabs button {
        height: 32px;
        padding: 0 10px;
        color: var(--text-2);
        font-size: var(--fs-12);
        font-weight: var(--fw-medium);
        white-space: nowrap;
        border-bottom: 2px solid transparent;
      }
      .tabs button[aria-selected='true'] {
        color: var(--text-1);
        border-bottom-color: var(--intent);
      }
      .part {
        flex: 1;
        min-height: 0;
      }
      p {
        margin: 12px 14px;
        color: var(--text-2);
      }
      @media (pointer: coarse) {
        .tabs button {
          height: 44px;
        }
      }
    `,
  ];
}

customElements.define('rave-super-user', SuperUserPanel);
