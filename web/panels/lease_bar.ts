// SPDX-License-Identifier: Apache-2.0
import {css, html, nothing, type TemplateResult} from 'lit';
import {icon} from '../ui/icons';
import {LiveElement} from '../ui/live_element';
import {controls} from '../ui/styles';
import {initials} from '../ui/words';

/** Who drives a robot: take control, give it back, ask for it, take it. */
export class LeaseBar extends LiveElement {
  static override properties = {robot: {type: Number}};
  declare robot: number;
  private note = '';
  private bad = false;
  /** Who had the lease when that was looked at last. */
  private known = '';
  /** A lease of another person is taken with a second press. */
  private sure = false;

  protected override listen(): (() => void)[] {
    const {model} = this.context;
    return [
      ...this.renderAfter(model.peopleChanged, model.drivesChanged),
      model.drivesChanged.on(() => this.look()),
    ];
  }

  /** What was answered is of the lease of before. */
  private look(): void {
    const drive = this.context.model.drives.get(this.robot);
    const now = `${drive?.lease} ${drive?.yours}`;
    this.sure = false;
    if (now !== this.known) this.note = '';
    this.known = now;
  }

  override willUpdate(changed: Map<string, unknown>): void {
    if (changed.has('robot')) {
      this.known = '';
      this.look();
    }
  }

  private async lease(what: 'take' | 'force' | 'give', to?: string): Promise<void> {
    const answer = await this.context.commands.lease(what, [this.robot], to);
    [this.note, this.bad] = answer.good ? ['', false] : [answer.text, true];
    this.requestUpdate();
  }

  private async ask(driver: string): Promise<void> {
    const name = this.context.model.robots[this.robot]?.name ?? '';
    const answer = await this.context.commands.ask({
      type: 'say',
      to: 'user',
      name: driver,
      text: `May I drive ${name}?`,
    });
    [this.note, this.bad] = answer.good
      ? [`Asked ${driver}; the answer comes in the chat.`, false]
      : [answer.text, true];
    this.requestUpdate();
  }

  override render(): TemplateResult | typeof nothing {
    const {model} = this.context;
    const robot = model.robots[this.robot];
    // A recorded robot takes no orders, so there is no lease to hold.
    if (!model.live || robot === undefined || robot.recorded) return nothing;
    const drive = model.drives.get(this.robot);
    const mine = drive?.yours === true;
    const other = drive !== undefined && drive.lease !== '' && !mine;
    const own = other && this.isOwn(drive.lease);
    return html`<div class="bar ${mine ? 'mine' : ''}">
      ${drive === undefined || drive.lease === ''
        ? html`<i class="face none">${icon('hand', 14)}</i>`
        : html`<i class="face ${mine ? 'you' : ''}"
            >${initials(mine ? (model.hello?.user.name ?? '') : drive.lease)}</i
          >`}
      <span
        class="who ${this.note === '' ? '' : 'noted'}"
        title=${this.note !== '' ? this.note : this.about(mine, other)}
        ><b
          >${mine
            ? 'You hold the lease'
            : own
              ? 'You drive on another page'
              : other
                ? `${drive.lease} drives`
                : 'No person drives'}</b
        >
        <small
          >${this.note !== ''
            ? html`<span class=${this.bad ? 'bad' : ''}>${this.note}</span>`
            : this.about(mine, other)}</small
        ></span
      >
      ${model.commands(this.robot) ? this.renderButtons(mine, other, drive?.lease ?? '') : nothing}
    </div>`;
  }

  /** Of two pages of one person one has the lease. */
  private isOwn(driver: string): boolean {
    return driver === this.context.model.knownAs;
  }

  private about(mine: boolean, other: boolean): string {
    const {model} = this.context;
    if (mine) return 'ends 3 s after driving, 10 min after another order';
    if (!model.commands(this.robot))
      return model.may('command') ? 'you may not command it' : 'you can only watch';
    if (other && this.isOwn(model.drives.get(this.robot)?.lease ?? ''))
      return 'give it back there, or take it here';
    return other ? 'others must ask you' : 'your first order takes the lease';
  }

  private renderButtons(mine: boolean, other: boolean, driver: string): TemplateResult {
    if (mine) {
      const others = this.context.model.others.filter(
        (person) => person.role !== 'observer' && person.name !== driver,
      );
      return html`${others.length === 0
          ? nothing
          : html`<select
              aria-label="Give the lease to"
              @change=${(event: Event) =>
                void this.lease('give', (event.target as HTMLSelectElement).value)}>
              <option value="" selected disabled>Give to …</option>
              ${others.map((person) => html`<option>${person.name}</option>`)}
            </select>`}
        <button class="plain" @click=${() => void this.lease('give')}>Give back</button>`;
    }
    if (!other)
      return html`<button class="main" @click=${() => void this.lease('take')}>
        Take control
      </button>`;
    if (this.sure)
      return html`<button class="danger" @click=${() => void this.lease('force')}>
          ${this.isOwn(driver) ? 'Take it here' : `Take it from ${driver}`}</button
        ><button
          class="plain"
          @click=${() => {
            this.sure = false;
            this.requestUpdate();
          }}>
          Keep
        </button>`;
    return html`${this.isOwn(driver)
        ? nothing
        : html`<button class="main" @click=${() => void this.ask(driver)}>Ask</button>`}<button
        class="plain"
        @click=${() => {
          this.sure = true;
          this.requestUpdate();
        }}>
        Take …
      </button>`;
  }

  static override styles = [
    controls,
    css`
      :host {
        display: block;
      }
      /* One line, whatever it says. */
      :host([compact]) .bar {
        flex-wrap: nowrap;
        height: 42px;
        padding: 0 8px;
      }
      :host([compact]) .who {
        flex: 1 1 0;
        min-width: 0;
      }
      :host([compact]) .who > * {
        overflow: hidden;
        text-overflow: ellipsis;
        white-space: nowrap;
      }
      :host([compact]) .bar:has(button) .who:not(.noted) small,
      :host([compact]) .noted b {
        display: none;
      }
      :host([compact]) select {
        max-width: 84px;
      }
      .bar {
        display: flex;
        align-items: center;
        flex-wrap: wrap;
        gap: 8px;
        padding: 8px 10px;
        border: 1px solid var(--line-2);
        border-radius: var(--r-3);
        background: var(--bg-2);
        font-size: var(--fs-12);
      }
      .bar.mine {
        background: var(--intent-soft);
        border-color: var(--intent-line);
      }
      .face {
        display: grid;
        place-items: center;
        width: 26px;
        height: 26px;
        border-radius: 50%;
        background: var(--person-fill);
        color: var(--on-fill);
        font: 600 10px var(--font-ui);
        flex: none;
      }
      .face.you {
        background: var(--intent-fill);
        color: #fff;
      }
      .face.none {
        background: var(--bg-4);
        color: var(--text-3);
      }
      .who {
        flex: 1 1 96px;
        min-width: 90px;
        line-height: 1.3;
      }
      .who b {
        display: block;
        font-weight: var(--fw-strong);
      }
      .who small {
        color: var(--text-2);
        font-size: var(--fs-11);
      }
      .bad {
        color: var(--danger);
      }
      button,
      select {
        height: var(--h-control);
        padding: 0 10px;
        border-radius: var(--r-3);
        font-size: var(--fs-12);
        white-space: nowrap;
      }
      .main {
        background: var(--intent-fill);
        color: #fff;
      }
      .plain,
      select {
        background: var(--bg-3);
        color: var(--text-1);
        border: 1px solid var(--line-2);
      }
      select {
        font: inherit;
        max-width: 92px;
        padding: 0 4px;
      }
      .danger {
        border: 1px solid var(--danger);
        color: var(--danger);
      }
    `,
  ];
}

customElements.define('rave-lease', LeaseBar);
