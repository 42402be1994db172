// SPDX-License-Identifier: Apache-2.0
import {LitElement, css, html, nothing, type TemplateResult} from 'lit';
import {logOf} from '../model/run_begin';
import type {PanelContext, PanelKind} from '../panel_api';
import {clockText} from './clock';
import {icon, type IconName} from './icons';
import {withheldPanels} from './panels';
import {controls} from './styles';

const kMost = 12;

interface Found {
  icon: IconName;
  text: string;
  note: string;
  act(): void;
}

/** Ctrl K: robots, panels and moments in one list. */
export class FindBox extends LitElement {
  declare context: PanelContext;
  declare panels: readonly PanelKind[];
  private text = '';
  private at = 0;

  override firstUpdated(): void {
    this.renderRoot.querySelector('input')?.focus();
  }

  private found(): Found[] {
    const words = this.text.toLowerCase().split(/\s+/).filter(Boolean);
    const fits = (text: string) => words.every((word) => text.toLowerCase().includes(word));
    const {model, selection} = this.context;
    const all: Found[] = [...this.stops(words, fits)];
    model.robots.forEach((robot, slot) => {
      if (!fits(`${robot.name} ${robot.team} ${robot.kind}`)) return;
      all.push({
        icon: 'bot',
        text: `Go to ${robot.name}`,
        note: `${robot.kind}${robot.team ? `, team ${robot.team}` : ''}`,
        act: () => {
          selection.set([slot]);
          selection.follow(true);
        },
      });
    });
    for (const panel of this.panels) {
      if (fits(panel.title))
        all.push({
          icon: panel.icon as IconName,
          text: panel.title,
          note: 'panel',
          act: () => this.context.show(panel.id),
        });
    }
    // Not in the list of everything: only who looks for one learns why it is not there.
    for (const panel of words.length === 0 ? [] : withheldPanels(model)) {
      if (fits(panel.title))
        all.push({
          icon: 'lock',
          text: panel.title,
          note: 'panel; you may not see it',
          act: () => this.context.show(panel.id),
        });
    }
    if (fits('light or dark theme'))
      all.push({
        icon: 'sun',
        text: 'Light or dark',
        note: 'theme',
        act: () => this.dispatchEvent(new CustomEvent('theme')),
      });
    if (model.hello?.foxglove && fits('watch in foxglove lichtblick'))
      all.push({
        icon: 'share',
        text: 'Watch in Foxglove',
        note: 'address and steps',
        act: () => this.dispatchEvent(new CustomEvent('foxglove')),
      });
    const seconds = /^(?:(\d+):)?(\d+(?:\.\d+)?)\s*s?$/.exec(this.text.trim());
    if (seconds && model.may('seek')) {
      const t = 60 * Number(seconds[1] ?? 0) + Number(seconds[2]);
      all.unshift({
        icon: 'rotateCcw',
        text: `Go to ${clockText(t)}`,
        note: 'moment',
        act: () => this.context.seek(t),
      });
    }
    if (words.length > 0) {
      for (const event of logOf(model)) {
        if (fits(`${event.kind} ${event.text}`))
          all.push({
            icon: 'info',
            text: event.text,
            note: clockText(event.t),
            act: () => this.context.seek(event.t),
          });
        if (all.length > 4 * kMost) break;
      }
    }
    return all.slice(0, kMost);
  }

  /** Who may stop robots finds that, too: `stop wal`. */
  private stops(words: readonly string[], fits: (text: string) => boolean): Found[] {
    const {model, link} = this.context;
    if (!model.may('stop') || words.length === 0 || !'stop'.startsWith(words[0].slice(0, 4)))
      return [];
    const stop = (slots: number[]) => () => link.send({type: 'halt', do: 'stop', slots});
    const found: Found[] = [];
    const teams = new Map<string, number[]>();
    model.robots.forEach((robot, slot) => {
      if (!model.stops(slot)) return;
      if (robot.team !== '') teams.set(robot.team, [...(teams.get(robot.team) ?? []), slot]);
      if (found.length < kMost / 2 && fits(`stop ${robot.name}`)) {
        found.push({
          icon: 'octagonX',
          text: `Stop ${robot.name}`,
          note: `${robot.kind}${robot.team ? `, team ${robot.team}` : ''}`,
          act: stop([slot]),
        });
      }
    });
    for (const [team, slots] of teams) {
      if (fits(`stop team ${team}`))
        found.push({
          icon: 'octagonX',
          text: `Stop team ${team}`,
          note: `${slots.length} robots`,
          act: stop(slots),
        });
    }
    return found;
  }

  override render(): TemplateResult {
    const found = this.found();
    this.at = Math.min(this.at, Math.max(found.length - 1, 0));
    return html`<div
      class="scrim"
      @click=${(event: Event) => {
        if (event.target === event.currentTarget) this.close();
      }}>
      <div class="box" role="dialog" aria-label="Find anything">
        <label
          >${icon('search', 17)}<input
            aria-label="Find"
            placeholder="A robot, a panel, a moment such as 1:07"
            .value=${this.text}
            @input=${(event: InputEvent) => {
              this.text = (event.target as HTMLInputElement).value;
              this.at = 0;
              this.requestUpdate();
            }}
            @keydown=${(event: KeyboardEvent) => this.key(event, found)} /><kbd>Esc</kbd></label
        >
        <ul role="listbox" aria-label="Found">
          ${found.map(
            (item, i) =>
              html`<li role="option" aria-selected=${i === this.at} @click=${() => this.take(item)}>
                <i class=${item.icon}>${icon(item.icon, 16)}</i><span>${item.text}</span
                ><em>${item.note}</em>
              </li>`,
          )}
        </ul>
        ${found.length === 0 ? html`<p>Nothing is called that.</p>` : nothing}
      </div>
    </div>`;
  }

  private key(event: KeyboardEvent, found: Found[]): void {
    if (event.key === 'Escape') this.close();
    else if (event.key === 'ArrowDown') this.at = Math.min(this.at + 1, found.length - 1);
    else if (event.key === 'ArrowUp') this.at = Math.max(this.at - 1, 0);
    else if (event.key === 'Enter' && found[this.at]) this.take(found[this.at]);
    else return;
    event.preventDefault();
    event.stopPropagation();
    this.requestUpdate();
  }

  private take(item: Found): void {
    item.act();
    this.close();
  }

  private close(): void {
    this.dispatchEvent(new CustomEvent('done'));
  }

  static override styles = [
    controls,
    css`
      .scrim {
        position: fixed;
        inset: 0;
        background: var(--scrim);
        z-index: 20;
        display: grid;
        justify-items: center;
        align-items: start;
        padding-top: 12vh;
      }
      .box {
        width: min(560px, 94vw);
        background: var(--bg-2);
        border: 1px solid var(--line-2);
        border-radius: var(--r-4);
        box-shadow: var(--shadow-pop);
        overflow: hidden;
      }
      label {
        display: flex;
        align-items: center;
        gap: 10px;
        height: 46px;
        padding: 0 14px;
        border-bottom: 1px solid var(--line-2);
        color: var(--text-3);
      }
      input {
        flex: 1;
        border: 0;
        outline: 0;
        background: none;
        color: var(--text-1);
        font: inherit;
        font-size: var(--fs-15);
      }
      kbd {
        padding: 0 6px;
        border: 1px solid var(--line-2);
        border-radius: var(--r-2);
        font: 500 var(--fs-11) var(--font-ui);
        color: var(--text-2);
      }
      ul {
        list-style: none;
        margin: 0;
        padding: 6px;
        max-height: 56vh;
        overflow: auto;
      }
      li {
        display: flex;
        align-items: center;
        gap: 10px;
        height: 36px;
        padding: 0 10px;
        border-radius: var(--r-3);
        cursor: pointer;
        color: var(--text-2);
      }
      .octagonX {
        color: var(--danger);
      }
      li span {
        color: var(--text-1);
        overflow: hidden;
        text-overflow: ellipsis;
        white-space: nowrap;
      }
      li em {
        font-style: normal;
        color: var(--text-2);
        font-size: var(--fs-12);
        white-space: nowrap;
      }
      li[aria-selected='true'],
      li:hover {
        background: var(--intent-soft);
      }
      p {
        margin: 0;
        padding: 4px 16px 14px;
        color: var(--text-3);
        font-size: var(--fs-12);
      }
    `,
  ];
}

customElements.define('rave-find', FindBox);
