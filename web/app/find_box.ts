// SPDX-License-Identifier: Apache-2.0
import {LitElement, css, html, nothing, type TemplateResult} from 'lit';
import {logOf} from '../model/run_begin';
import type {PanelContext, PanelKind} from '../panel_api';
import {clockText} from '../ui/clock';
import {icon, type IconName} from '../ui/icons';
import {withheldPanels} from './panels';
import {controls} from '../ui/styles';

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
    const all = [
      ...this.moment(),
      ...this.stops(words, fits),
      ...this.robots(fits),
      ...this.openable(words, fits),
      ...this.choices(fits),
    ];
    // A word may fit thousands of events.
    if (words.length > 0 && all.length < kMost)
      for (const event of logOf(this.context.model)) {
        if (!fits(`${event.kind} ${event.text}`)) continue;
        const act = () => this.context.seek(event.t);
        all.push({icon: 'info', text: event.text, note: clockText(event.t), act});
        if (all.length >= kMost) break;
      }
    return all.slice(0, kMost);
  }

  /** A time, such as `12.5` or `1:30`, where it can be moved. */
  private moment(): Found[] {
    const seconds = /^(?:(\d+):)?(\d+(?:\.\d+)?)\s*s?$/.exec(this.text.trim());
    if (seconds === null || !this.context.model.may('seek')) return [];
    const t = 60 * Number(seconds[1] ?? 0) + Number(seconds[2]);
    const act = () => this.context.seek(t);
    return [{icon: 'rotateCcw', text: `Go to ${clockText(t)}`, note: 'moment', act}];
  }

  private robots(fits: (text: string) => boolean): Found[] {
    const {model, selection} = this.context;
    const all: Found[] = [];
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
    return all;
  }

  private openable(words: readonly string[], fits: (text: string) => boolean): Found[] {
    const show = (id: string) => () => this.context.show(id);
    // Not in the list of everything: only who looks for one learns why it is not there.
    const withheld = words.length === 0 ? [] : withheldPanels(this.context.model);
    return [
      ...this.panels
        .filter(({title}) => fits(title))
        .map(({id, icon: glyph, title}) => ({
          icon: glyph as IconName,
          text: title,
          note: 'panel',
          act: show(id),
        })),
      ...withheld
        .filter(({title}) => fits(title))
        .map(({id, title}) => ({
          icon: 'lock' as const,
          text: title,
          note: 'panel; you may not see it',
          act: show(id),
        })),
    ];
  }

  private choices(fits: (text: string) => boolean): Found[] {
    const ask = (name: string) => () => void this.dispatchEvent(new CustomEvent(name));
    const all: Found[] = [];
    if (fits('light or dark theme'))
      all.push({icon: 'sun', text: 'Light or dark', note: 'theme', act: ask('theme')});
    if (this.context.model.hello?.foxglove && fits('watch in foxglove lichtblick'))
      all.push({
        icon: 'share',
        text: 'Watch in Foxglove',
        note: 'address and steps',
        act: ask('foxglove'),
      });
    return all;
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
