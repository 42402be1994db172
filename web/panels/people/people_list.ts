// SPDX-License-Identifier: Apache-2.0
import {css, html, nothing, type TemplateResult} from 'lit';
import {icon} from '../../ui/icons';
import {LiveElement} from '../../ui/live_element';
import {controls} from '../../ui/styles';
import {faceStyle, initials, roleText} from '../../ui/words';
import type {ChangeAccount, KnownPerson} from '../../protocol/messages';
import {accountText, peopleWith, seenText, teamsText} from './people';
import {RoleDraft} from './role_form';
import {peopleStyles} from './styles';

const kRefresh_ms = 10_000;
const kMostShown = 300;

/** Who has an account and who is here; for super-users. */
export class PeopleList extends LiveElement {
  private typed = '';
  /** Whose account is being changed. */
  private open = '';
  private draft: RoleDraft | null = null;
  private note: {good: boolean; text: string} | null = null;

  protected override listen(): (() => void)[] {
    const {model} = this.context;
    return [
      ...this.renderAfter(model.accountsChanged, model.runChanged, model.rightsChanged),
      this.every(kRefresh_ms, () => this.requestUpdate()),
    ];
  }

  private get teams(): readonly string[] {
    return this.context.model.rights?.teams.filter((team) => team !== '') ?? [];
  }

  override render(): TemplateResult {
    const {accounts} = this.context.model;
    if (accounts === null) return html`<p>Waiting for the accounts.</p>`;
    if (!accounts.kept) return html`<p>${accounts.why_not}</p>`;
    const people = peopleWith(accounts.people, this.typed);
    return html` <div class="bar">
        <label class="field"
          >${icon('search', 14)}<input
            aria-label="Filter people"
            placeholder="Name, role, team"
            .value=${this.typed}
            @input=${(event: Event) => {
              this.typed = (event.target as HTMLInputElement).value;
              this.requestUpdate();
            }}
        /></label>
        <button class="main" @click=${() => this.dispatchEvent(new CustomEvent('invite'))}>
          ${icon('userPlus', 15)} Invite
        </button>
      </div>
      ${this.note === null
        ? nothing
        : html`<p
            class="note ${this.note.good ? 'good' : 'bad'}"
            role=${this.note.good ? 'status' : 'alert'}>
            ${this.note.text}
          </p>`}
      <div class="scroll" tabindex="0" role="region" aria-label="People">
        ${this.renderTable(people, accounts.links)}
        ${people.length > kMostShown
          ? html`<p>${people.length - kMostShown} more: filter to see them.</p>`
          : nothing}
        ${people.length === 0
          ? html`<p>
              ${accounts.people.length === 0
                ? 'There are no accounts yet. Create an invitation.'
                : 'No account matches the filter.'}
            </p>`
          : nothing}
      </div>`;
  }

  /** One row for each, and one for who has the link of the terminal. */
  private renderTable(people: readonly KnownPerson[], links: number): TemplateResult {
    const now_s = Date.now() / 1000;
    return html`<table>
      <thead>
        <tr>
          <th scope="col">Name</th>
          <th scope="col">Role</th>
          <th scope="col" class="teams">Teams</th>
          <th scope="col" class="number">Pages</th>
          <th scope="col" class="number">Seen</th>
          <th><span class="hidden">Change</span></th>
        </tr>
      </thead>
      <tbody>
        ${people.slice(0, kMostShown).map((person) => this.renderPerson(person, now_s))}
        ${links === 0
          ? nothing
          : html`<tr>
              <th scope="row">
                <span class="who"
                  ><i class="face">${icon('keyRound', 13)}</i
                  ><span>The operator<small>by the link of the terminal</small></span></span
                >
              </th>
              <td>super-user</td>
              <td class="teams">all teams</td>
              <td class="number">${links}</td>
              <td class="number here">now</td>
              <td></td>
            </tr>`}
      </tbody>
    </table>`;
  }

  private renderPerson(person: KnownPerson, now_s: number): TemplateResult {
    const {name, role, teams, pages, disabled} = person;
    const more = accountText(person);
    const mine = name === this.context.model.hello?.user.name;
    const open = this.open === name;
    return html`<tr class=${open ? 'open' : disabled ? 'off' : ''}>
        <th scope="row">
          <span class="who"
            ><i class="face ${mine ? 'you' : ''}" style=${faceStyle(name)}>${initials(name)}</i
            ><span
              >${name}${mine ? html` <em>you</em>` : nothing}<small class="narrow"
                >${teamsText(teams)}</small
              >${more === '' ? nothing : html`<small>${more}</small>`}</span
            ></span
          >
        </th>
        <td>${roleText(role).toLowerCase()}</td>
        <td class="teams">${teamsText(teams)}</td>
        <td class="number">${pages === 0 ? '–' : pages}</td>
        <td class="number ${pages > 0 ? 'here' : disabled ? 'bad' : ''}">
          ${seenText(person, now_s)}
        </td>
        <td>
          <button
            class="icon-button"
            aria-expanded=${open}
            aria-label="Change ${name}"
            title="Change ${name}"
            @click=${() => this.toggle(person)}>
            ${icon('ellipsis', 16)}
          </button>
        </td>
      </tr>
      ${open
        ? html`<tr class="editor">
            <td colspan="6">${this.renderEditor(person, mine)}</td>
          </tr>`
        : nothing}`;
  }

  private toggle(person: KnownPerson): void {
    this.open = this.open === person.name ? '' : person.name;
    this.draft = new RoleDraft(person.role, person.teams, this.teams);
    this.note = null;
    this.requestUpdate();
  }

  private renderEditor(person: KnownPerson, mine: boolean): TemplateResult {
    const {name, sessions, guest, disabled} = person;
    const count = `${sessions} session${sessions === 1 ? '' : 's'}`;
    return html`<form
      @submit=${(event: Event) => {
        event.preventDefault();
        void this.save(name);
      }}>
      ${this.draft?.render(this.teams, () => this.requestUpdate()) ?? nothing}
      <button class="main">Change</button><span class="space"></span>
      <button
        type="button"
        class="plain"
        ?disabled=${sessions === 0}
        title=${guest ? 'A guest goes with the session' : 'They can sign in again'}
        @click=${() => void this.ask({type: 'account', do: 'end_sessions', name})}>
        ${guest ? `End ${count} and the guest` : `End ${count}`}
      </button>
      <button
        type="button"
        class="plain ${disabled ? '' : 'bad'}"
        ?disabled=${mine && !disabled}
        title=${disabled
          ? 'They can sign in again'
          : 'Keeps the name, ends the sessions, refuses to let the person in'}
        @click=${() => void this.ask({type: 'account', do: disabled ? 'enable' : 'disable', name})}>
        ${disabled ? 'Enable' : 'Disable'}
      </button>
    </form>`;
  }

  private save(name: string): Promise<void> {
    const {draft} = this;
    return draft === null
      ? Promise.resolve()
      : this.ask({type: 'account', do: 'change', name, role: draft.role, teams: draft.teams});
  }

  private async ask(request: Omit<ChangeAccount, 'request'>): Promise<void> {
    const answer = await this.context.commands.ask(request);
    this.note = {good: answer.good, text: answer.text};
    if (answer.good) this.open = '';
    this.requestUpdate();
  }

  static override styles = [
    controls,
    peopleStyles,
    css`
      table {
        width: 100%;
        border-collapse: collapse;
        white-space: nowrap;
      }
      thead th {
        position: sticky;
        top: 0;
        z-index: 1;
        padding: 4px 8px;
        background: var(--bg-1);
        color: var(--text-2);
        font-weight: 400;
        text-align: left;
      }
      thead th:first-child,
      tbody th {
        padding-left: 14px;
      }
      tbody tr {
        border-top: 1px solid var(--line-1);
      }
      tbody th {
        font-weight: var(--fw-medium);
        text-align: left;
      }
      td,
      tbody th {
        padding: 4px 8px;
      }
      td {
        color: var(--text-2);
      }
      tr:hover:not(.editor) {
        background: var(--bg-2);
      }
      tr.open {
        background: var(--intent-soft);
      }
      tr.off th {
        color: var(--text-2);
        text-decoration: line-through;
      }
      tr.editor {
        border-top: 0;
      }
      tr.editor td {
        padding: 0;
        white-space: normal;
      }
      .who {
        display: flex;
        align-items: center;
        gap: 8px;
      }
      .who em {
        color: var(--intent);
        font-style: normal;
        font-weight: 400;
      }
      .number {
        text-align: right;
      }
      thead th.number {
        text-align: right;
      }
      .here {
        color: var(--ok);
      }
      .bad {
        color: var(--danger);
      }
      .narrow {
        display: none;
      }
      .hidden {
        position: absolute;
        width: 1px;
        height: 1px;
        overflow: hidden;
        clip-path: inset(50%);
      }
      @container (max-width: 460px) {
        .teams {
          display: none;
        }
        .narrow {
          display: block;
          white-space: normal;
        }
        thead th.number:nth-of-type(4),
        td.number:nth-of-type(3) {
          display: none;
        }
      }
    `,
  ];
}

customElements.define('rave-people', PeopleList);
