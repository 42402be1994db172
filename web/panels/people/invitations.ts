// SPDX-License-Identifier: Apache-2.0
import {css, html, nothing, type TemplateResult} from 'lit';
import {icon} from '../../ui/icons';
import {LiveElement} from '../../ui/live_element';
import {controls} from '../../ui/styles';
import {roleText} from '../../ui/words';
import type {KnownInvitation} from '../../protocol/messages';
import {endsText, teamsText, usesText} from './people';
import {RoleDraft} from './role_form';
import {peopleStyles} from './styles';

/** Links that let others in: made, told once, listed, withdrawn; for super-users. */
export class Invitations extends LiveElement {
  private draft = new RoleDraft('observer', '*', []);
  private uses = 1;
  private days = 7;
  /** Of the one person whom it is for; empty: each person chooses a name. */
  private name = '';
  /** The address that was told, until it is put away. */
  private link = '';
  private copied = false;
  private note = '';

  protected override listen(): (() => void)[] {
    return this.renderAfter(this.context.model.accountsChanged, this.context.model.runChanged);
  }

  override render(): TemplateResult {
    const {accounts, rights} = this.context.model;
    if (accounts === null) return html`<p>Waiting for the invitations.</p>`;
    if (!accounts.kept) return html`<p>${accounts.why_not}</p>`;
    const now_s = Date.now() / 1000;
    const number = (event: Event) => Number((event.target as HTMLInputElement).value);
    return html`<form
        @submit=${(event: Event) => {
          event.preventDefault();
          void this.make();
        }}>
        ${this.draft.render(rights?.teams.filter((team) => team !== '') ?? [], () =>
          this.requestUpdate(),
        )}
        <label title="This person alone gets the name. Rights of a user need it."
          >For<input
            name="name"
            placeholder="anybody"
            maxlength="32"
            .value=${this.name}
            @input=${(event: Event) => {
              this.name = (event.target as HTMLInputElement).value.trim();
              this.requestUpdate();
            }}
        /></label>
        <label
          >People<input
            type="number"
            name="uses"
            min="1"
            max="1000"
            required
            ?disabled=${this.name !== ''}
            .value=${this.name === '' ? String(this.uses) : '1'}
            @input=${(event: Event) => {
              this.uses = number(event);
            }}
        /></label>
        <label
          >Days<input
            type="number"
            name="days"
            min="1"
            max="365"
            required
            .value=${String(this.days)}
            @input=${(event: Event) => {
              this.days = number(event);
            }}
        /></label>
        <button class="main">${icon('userPlus', 15)} Make a link</button>
      </form>
      ${this.note === '' ? nothing : html`<p class="note bad" role="alert">${this.note}</p>`}
      ${this.renderLink()}
      <div class="scroll" tabindex="0" role="region" aria-label="Invitations">
        ${accounts.invitations.map((invitation) => this.renderInvitation(invitation, now_s))}
        ${accounts.invitations.length === 0 ? html`<p>There are no open invitations.</p>` : nothing}
      </div>`;
  }

  private renderLink(): TemplateResult | typeof nothing {
    if (this.link === '') return nothing;
    return html`<section class="link" role="status">
      ${icon('keyRound', 17)}
      <div><b>The link is shown once. Copy it now.</b><code>${this.link}</code></div>
      <button class="plain" @click=${() => void this.copy()}>
        ${icon(this.copied ? 'check' : 'copy', 14)} ${this.copied ? 'Copied' : 'Copy'}
      </button>
      <button
        class="icon-button"
        aria-label="Put the link away"
        @click=${() => {
          this.link = '';
          this.requestUpdate();
        }}>
        ${icon('x', 15)}
      </button>
    </section>`;
  }

  private renderInvitation(invitation: KnownInvitation, now_s: number): TemplateResult {
    const {role, teams, by, until_s, id} = invitation;
    const name = `${roleText(role)} link`;
    return html`<article>
      ${icon('link', 15)}
      <div><b>${name}</b><small>${teamsText(teams)} · by ${by}</small></div>
      <span class="chip">${endsText(until_s, now_s)}</span
      ><span class="chip">${usesText(invitation)}</span>
      <button
        class="plain"
        aria-label="Withdraw ${name} by ${by}, ${usesText(invitation)}"
        @click=${() => void this.withdraw(id)}>
        Withdraw
      </button>
    </article>`;
  }

  private async make(): Promise<void> {
    const {model, commands} = this.context;
    const answer = await commands.ask({
      type: 'invitation',
      do: 'make',
      role: this.draft.role,
      teams: this.draft.teams,
      uses: this.name === '' ? this.uses : 1,
      days: this.days,
      name: this.name,
    });
    this.note = answer.good ? '' : answer.text;
    const told = model.takeInvited(answer.request);
    this.link = told === null ? '' : new URL(told, location.origin).href;
    this.copied = false;
    this.requestUpdate();
  }

  private async withdraw(id: string): Promise<void> {
    const answer = await this.context.commands.ask({type: 'invitation', do: 'withdraw', id});
    this.note = answer.good ? '' : answer.text;
    this.requestUpdate();
  }

  private async copy(): Promise<void> {
    try {
      await navigator.clipboard.writeText(this.link);
      this.copied = true;
    } catch {
      this.note = 'The browser refused to copy. Select the link and copy it by hand.';
    }
    this.requestUpdate();
  }

  static override styles = [
    controls,
    peopleStyles,
    css`
      .link,
      article {
        display: flex;
        flex-wrap: wrap;
        align-items: center;
        gap: 8px 10px;
        padding: 8px 14px;
      }
      .link {
        flex: none;
        margin: 10px 14px;
        border-radius: var(--r-4);
        background: var(--intent-soft);
        border: 1px solid var(--intent-line);
      }
      .link div,
      article div {
        flex: 1 1 180px;
        min-width: 0;
      }
      .link b {
        display: block;
      }
      code {
        font: var(--fs-12) var(--font-code);
        overflow-wrap: anywhere;
        user-select: all;
      }
      article {
        border-top: 1px solid var(--line-1);
      }
      article > svg {
        color: var(--text-2);
      }
      article b {
        font-weight: var(--fw-medium);
      }
    `,
  ];
}

customElements.define('rave-invitations', Invitations);
