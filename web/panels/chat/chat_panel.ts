// SPDX-License-Identifier: Apache-2.0
import {css, html, nothing, type TemplateResult} from 'lit';
import {clockText} from '../../ui/clock';
import {icon} from '../../ui/icons';
import {LiveElement} from '../../ui/live_element';
import {controls, glyphs} from '../../ui/styles';
import {faceStyle, initials} from '../../ui/words';
import type {Say} from '../../protocol/messages';
import {renderWithheld, withheldStyles} from '../withheld';
import {saidIn, type Said} from './said';

/** For whom a line is. */
interface Target {
  key: string;
  label: string;
  hint: string;
  to: Pick<Say, 'to' | 'name' | 'slot'>;
}

const kShown = 200;
/** Of a run with more, those of selected robots. */
const kMostTeams = 6;

const kRoles: readonly Target[] = [
  {
    key: 'commanders',
    label: 'Commanders',
    hint: 'To all commanders',
    to: {to: 'role', name: 'commander'},
  },
  {
    key: 'observers',
    label: 'Observers',
    hint: 'To all observers',
    to: {to: 'role', name: 'observer'},
  },
  {
    key: 'super-users',
    label: 'Super-users',
    hint: 'To all super-users',
    to: {to: 'role', name: 'super_user'},
  },
];

/** People talk to each other, and to the robots that they command; robots answer. */
export class ChatPanel extends LiveElement {
  private note = '';
  private atEnd = true;

  protected override listen(): (() => void)[] {
    const {model, selection, palette, commands} = this.context;
    return this.renderAfter(
      model.linesChanged,
      model.eventsChanged,
      model.rosterChanged,
      model.peopleChanged,
      model.runChanged,
      selection.changed,
      palette.changed,
      commands.addresseeChanged,
    );
  }

  override updated(): void {
    const list = this.renderRoot.querySelector('.lines');
    if (list !== null && this.atEnd) list.scrollTop = list.scrollHeight;
  }

  private get targets(): Target[] {
    const {model, selection} = this.context;
    const targets: Target[] = [
      {key: 'all', label: 'All', hint: 'To all people', to: {to: 'all'}},
      ...kRoles,
    ];
    const slot = selection.primary;
    const robot = slot === null ? undefined : model.robots[slot];
    if (robot !== undefined && slot !== null) {
      const commands = model.commands(slot);
      targets.push({
        key: 'robot',
        label: robot.name,
        hint: commands
          ? `To ${robot.name}, and to all people who see it`
          : `About ${robot.name}, to all people who see it`,
        to: {to: 'robot', slot},
      });
    }
    targets.push(...this.teams());
    for (const {name} of model.others)
      targets.push({
        key: `user ${name}`,
        label: name,
        hint: `To ${name} alone`,
        to: {to: 'user', name},
      });
    return targets;
  }

  /** Teams of which this person sees a robot; that of the selected robot first. */
  private teams(): Target[] {
    const {model, selection} = this.context;
    const own = selection.primary === null ? '' : (model.robots[selection.primary]?.team ?? '');
    const robots = new Map<string, number[]>(own === '' ? [] : [[own, []]]);
    model.robots.forEach(({team}, slot) => {
      if (team !== '') robots.set(team, [...(robots.get(team) ?? []), slot]);
    });
    return [...robots].slice(0, kMostTeams).map(([team, slots]) => {
      const told = slots.filter((slot) => model.commands(slot)).length;
      const hint =
        told > 0 ? `To team ${team}: people and ${told} robots` : `To the people of team ${team}`;
      return {key: `team ${team}`, label: `Team ${team}`, hint, to: {to: 'team', name: team}};
    });
  }

  private get target(): Target {
    const {targets} = this;
    return (
      targets.find(({key}) => key === this.context.commands.addressee) ?? (targets[0] as Target)
    );
  }

  private async send(area: HTMLTextAreaElement, target: Target): Promise<void> {
    const text = area.value.trim();
    if (text === '') return;
    area.value = '';
    this.atEnd = true;
    const answer = await this.context.commands.ask({type: 'say', ...target.to, text});
    this.note = answer.good ? '' : answer.text;
    // What was not said is not lost.
    if (!answer.good && area.value === '') area.value = text;
    this.requestUpdate();
  }

  override render(): TemplateResult {
    const {model} = this.context;
    // In a replay there is nothing to write, but what was said may be withheld all the same.
    if (model.isWithheld('chat')) return renderWithheld(this.context, 'chat');
    const said = saidIn(model).slice(-kShown);
    return html` ${model.live ? this.renderTargets() : nothing}
      <div
        class="lines"
        role="log"
        aria-label="Chat"
        tabindex="0"
        @scroll=${(event: Event) => this.scrolled(event.target as HTMLElement)}>
        ${said.length === 0
          ? html`<p class="none">${model.live ? 'No messages yet.' : 'No messages.'}</p>`
          : said.map((line) => this.renderLine(line))}
      </div>
      ${this.note === '' ? nothing : html`<p class="bad" role="alert">${this.note}</p>`}
      ${model.live ? this.renderField() : nothing}
      <p class="kept">
        ${model.live
          ? 'The chat is recorded with the run.'
          : 'The chat of the recording, to read only.'}
      </p>`;
  }

  private renderTargets(): TemplateResult {
    const target = this.target;
    return html`<div class="targets" role="radiogroup" aria-label="To whom">
      ${this.targets.map(
        (one) =>
          html`<button
            role="radio"
            class="to"
            aria-checked=${one.key === target.key}
            @click=${() => this.context.commands.address(one.key)}>
            ${one.label}
          </button>`,
      )}
    </div>`;
  }

  private renderField(): TemplateResult {
    const {model} = this.context;
    const target = this.target;
    const may = model.may('chat');
    return html`<form
      class="field"
      @submit=${(event: Event) => {
        event.preventDefault();
        void this.send(this.renderRoot.querySelector('textarea') as HTMLTextAreaElement, target);
      }}>
      <textarea
        rows="1"
        maxlength="900"
        aria-label=${target.hint}
        placeholder=${may ? target.hint : model.whyNot('chat')}
        ?disabled=${!may}
        @keydown=${(event: KeyboardEvent) => {
          if (event.key === 'Enter' && !event.shiftKey) {
            event.preventDefault();
            void this.send(event.target as HTMLTextAreaElement, target);
          }
        }}></textarea>
      <button class="icon-button" aria-label="Send" title="Send (Enter)" ?disabled=${!may}>
        ${icon('cornerDownLeft', 15)}
      </button>
    </form>`;
  }

  private scrolled(list: HTMLElement): void {
    this.atEnd = list.scrollHeight - list.scrollTop - list.clientHeight < 24;
  }

  private renderLine(line: Said): TemplateResult {
    const {model, palette} = this.context;
    if (line.kind === 'note') return html`<p class="note"><span>${line.text}</span></p>`;
    const robot = line.slot === null ? undefined : model.robots[line.slot];
    const hue = line.slot === null ? null : palette.hue(line.slot);
    return html`<article>
      ${robot !== undefined && hue !== null
        ? html`<span class="who"
            ><i
              class="glyph ${robot.kind}"
              style="--hue:${robot.kind === 'real' ? hue.fill : hue.ink}"></i
          ></span>`
        : html`<span class="who"
            ><i class="face ${line.yours ? 'you' : ''}" style=${faceStyle(line.name)}
              >${initials(line.yours ? (model.hello?.user.name ?? '') : line.name)}</i
            ></span
          >`}
      <div>
        <b>${line.name}</b><time>${clockText(line.t)}</time>${line.to === ''
          ? nothing
          : html`<span class="tag">to ${line.to}</span>`}${robot === undefined
          ? nothing
          : html`<span class="tag robot">robot</span>`}
        <p>${line.text}</p>
      </div>
    </article>`;
  }

  static override styles = [
    controls,
    glyphs,
    withheldStyles,
    css`
      :host {
        display: flex;
        flex-direction: column;
        height: 100%;
        background: var(--bg-1);
      }
      .targets {
        display: flex;
        gap: 6px;
        padding: 8px 10px;
        overflow-x: auto;
        flex: none;
        scrollbar-width: none;
      }
      .to {
        height: 26px;
        padding: 0 10px;
        border-radius: var(--r-2);
        background: var(--bg-2);
        color: var(--text-2);
        font-size: var(--fs-12);
        white-space: nowrap;
        flex: none;
      }
      .to[aria-checked='true'] {
        background: var(--intent-soft);
        color: var(--intent);
        font-weight: var(--fw-medium);
      }
      @media (pointer: coarse) {
        .to {
          height: 36px;
          padding: 0 12px;
        }
      }
      .lines {
        flex: 1;
        min-height: 0;
        overflow: auto;
        padding: 2px 12px;
        font-size: var(--fs-12);
      }
      article {
        display: flex;
        gap: 10px;
        margin: 8px 0;
      }
      article div {
        min-width: 0;
        flex: 1;
      }
      article p {
        margin: 1px 0 0;
        overflow-wrap: anywhere;
        white-space: pre-wrap;
        font-size: var(--fs-13);
      }
      .who {
        width: 24px;
        flex: none;
        display: grid;
        place-items: start center;
        padding-top: 2px;
      }
      .face {
        display: grid;
        place-items: center;
        width: 24px;
        height: 24px;
        border-radius: 50%;
        background: var(--person-fill);
        color: var(--on-fill);
        font: 600 10px var(--font-ui);
      }
      .face.you {
        background: var(--intent-fill);
        color: #fff;
      }
      time {
        margin-left: 7px;
        color: var(--text-3);
        font-size: var(--fs-11);
      }
      .tag {
        margin-left: 6px;
        padding: 0 5px;
        border-radius: var(--r-2);
        background: var(--bg-3);
        color: var(--text-2);
        font-size: var(--fs-11);
      }
      .tag.robot {
        background: linear-gradient(var(--ok-soft) 0 0), var(--bg-1);
        color: var(--ok);
      }
      .note {
        display: flex;
        align-items: center;
        gap: 10px;
        margin: 8px 0;
        color: var(--text-3);
        font-size: var(--fs-11);
      }
      .note::before,
      .note::after {
        content: '';
        flex: 1;
        border-top: 1px solid var(--line-1);
      }
      .none {
        color: var(--text-3);
        text-align: center;
        margin-top: 24px;
      }
      .bad {
        margin: 4px 14px;
        color: var(--danger);
        font-size: var(--fs-12);
      }
      form.field {
        margin: 6px 10px 2px;
        height: auto;
        min-height: 34px;
        padding-right: 2px;
        flex: none;
      }
      textarea {
        flex: 1;
        min-width: 0;
        border: 0;
        outline: 0;
        resize: none;
        background: none;
        color: var(--text-1);
        font: inherit;
        font-size: var(--fs-13);
        field-sizing: content;
        max-height: 90px;
        padding: 6px 0;
      }
      textarea:focus-visible {
        outline: none;
      }
      textarea::placeholder {
        color: var(--text-3);
      }
      .kept {
        margin: 0 12px 6px;
        color: var(--text-3);
        font-size: var(--fs-11);
        flex: none;
      }
    `,
  ];
}

customElements.define('rave-chat', ChatPanel);
