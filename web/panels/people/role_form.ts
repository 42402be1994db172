// SPDX-License-Identifier: Apache-2.0
import {html, type TemplateResult} from 'lit';
import {roleText} from '../../ui/words';
import {kRoles, teamsOf, type Role} from './people';

/** Role and teams, while they are being chosen. */
export class RoleDraft {
  role: Role;
  all: boolean;
  readonly ticked: Set<string>;
  typed: string;

  constructor(role: Role, teams: string, known: readonly string[]) {
    this.role = role;
    this.all = teams === '*';
    const names = this.all || teams === '-' ? [] : teams.split(',');
    this.ticked = new Set(names.filter((name) => known.includes(name)));
    // Teams of other scenarios stay.
    this.typed = names.filter((name) => !known.includes(name)).join(', ');
  }

  get teams(): string {
    return teamsOf(this.all, this.ticked, this.typed);
  }

  /** Fields of a form. `changed` is called after each change. */
  render(known: readonly string[], changed: () => void): TemplateResult {
    const tick = (name: string, on: boolean) => {
      if (on) this.ticked.add(name);
      else this.ticked.delete(name);
      changed();
    };
    const on = (event: Event) => (event.target as HTMLInputElement).checked;
    return html`<label
        >Role<select
          @change=${(event: Event) => {
            this.role = (event.target as HTMLSelectElement).value as Role;
            changed();
          }}>
          ${kRoles.map(
            (role) =>
              html`<option value=${role} ?selected=${role === this.role}>
                ${roleText(role)}
              </option>`,
          )}
        </select></label
      >
      <fieldset>
        <legend>Teams</legend>
        <div>
          <label
            ><input
              type="checkbox"
              .checked=${this.all}
              @change=${(event: Event) => {
                this.all = on(event);
                changed();
              }} />all</label
          >
          ${known.map(
            (name) =>
              html`<label
                ><input
                  type="checkbox"
                  ?disabled=${this.all}
                  .checked=${!this.all && this.ticked.has(name)}
                  @change=${(event: Event) => tick(name, on(event))} />${name}</label
              >`,
          )}
          <input
            aria-label="Other teams"
            placeholder="others"
            ?disabled=${this.all}
            .value=${this.typed}
            @input=${(event: Event) => {
              this.typed = (event.target as HTMLInputElement).value;
            }} />
        </div>
      </fieldset>`;
  }
}
