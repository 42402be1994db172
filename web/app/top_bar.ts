// SPDX-License-Identifier: Apache-2.0
import {css, html, nothing, type TemplateResult} from 'lit';
import type {Person} from '../protocol/messages';
import './bell';
import './run_clock';
import {LiveElement} from './live_element';
import './way_chip';
import {kLayouts, type LayoutName} from './dock';
import {icon} from './icons';
import {logo} from './logo';
import {controls} from './styles';
import {faceStyle, initials, roleText, sizeText, startedText} from './words';

const kFaces = 3;
/** Those that the tooltip names. */
const kNamed = 20;
const kSlow_hz = 10;
/** A picture that is older than this is not what is now. */
const kOld_ms = 300;

/** The run and its state, find, the line, people, alerts, role. */
export class TopBar extends LiveElement {
  /** The layout that was chosen last; empty where there is no dock. */
  declare layout: LayoutName | '';
  static override properties = {layout: {}};

  protected override listen(): (() => void)[] {
    const {model, link, palette} = this.context;
    return this.renderAfter(
      model.runChanged,
      model.timeChanged,
      model.peopleChanged,
      link.changed,
      palette.changed,
    );
  }

  /** The state in a word, and the class that gives it its colour. */
  private state(): [string, string] {
    const {model, link} = this.context;
    if (link.state === 'lost') return ['Link lost', 'lost'];
    if (model.hello === null) return ['Opening', 'opening'];
    if (!model.live) return ['Replay', 'replay'];
    if (model.time?.state === 'waiting') return ['Waits', 'waits'];
    if (model.time?.state === 'paused') return ['Paused', 'waits'];
    return model.time?.state === 'ended' ? ['Ended', 'opening'] : ['Live', 'live'];
  }

  private about(): string {
    const {model} = this.context;
    const run = model.hello?.run;
    if (run === undefined) return '';
    if (!model.live)
      return [run.started && startedText(run.started), run.hash && `hash ${run.hash.slice(0, 8)}`]
        .filter(Boolean)
        .join(', ');
    const hosts = model.hosts.length > 1 ? `, ${model.hosts.length} hosts` : '';
    return (run.clock === 'lock_step' ? 'lock-step' : 'real time') + hosts;
  }

  override render(): TemplateResult {
    const {model, palette} = this.context;
    const run = model.hello?.run;
    const [word, look] = this.state();
    const ask = (name: string) => this.dispatchEvent(new CustomEvent(name));
    return html` <span class="brand">${logo()}<b>RAVE</b></span
      ><i class="rule"></i>
      <h1>${run?.name ?? ''}</h1>
      <span class="state ${look}" role="status"
        >${look === 'replay' ? icon('rotateCcw', 13) : html`<i></i>`}${word}</span
      >
      <span class="about">${this.about()}</span>
      ${this.layout
        ? html`<div class="segments" role="radiogroup" aria-label="Layout">
              ${kLayouts
                .filter(
                  (name) =>
                    (name !== 'Conduct' || model.may('rights')) &&
                    (name !== 'Drive' || (model.live && model.may('command'))),
                )
                .map(
                  (name) =>
                    html` <button
                      role="radio"
                      aria-checked=${this.layout === name}
                      title=${this.layout === name
                        ? 'The panels as you arranged them'
                        : `Your arrangement of ${name}`}
                      @click=${() => this.dispatchEvent(new CustomEvent('layout', {detail: name}))}>
                      ${name}
                    </button>`,
                )}
            </div>
            <button
              class="icon-button"
              title="Reset the layout ${this.layout} to its default panels"
              aria-label="Reset layout"
              @click=${() => ask('resetlayout')}>
              ${icon('rotateCcw', 15)}
            </button>`
        : nothing}
      <span class="space"></span>
      <button class="find" aria-label="Find a robot, panel or moment" @click=${() => ask('find')}>
        ${icon('search', 15)}<span>Find a robot, panel or moment</span><kbd>Ctrl K</kbd>
      </button>
      <span class="space"></span>
      ${run?.recording && !model.live
        ? html`<span
            class="chip wide"
            title=${run.recording.whole
              ? nothing
              : 'Its end or the part of a host is missing: rave info says which'}
            >${icon('fileText', 14)} ${run.recording.name}
            ${sizeText(run.recording.bytes)}${run.recording.whole ? '' : ', incomplete'}</span
          >`
        : nothing}
      <rave-way .context=${this.context}></rave-way>
      ${this.renderRate()} ${this.renderPeople()}
      ${model.live
        ? html`<span class="pen"
            ><rave-clock .context=${this.context}></rave-clock>${(
              [
                ['chat', 'Chat', 'message'],
                ['robots', 'Robots', 'list'],
                ['world', 'World View', 'compass'],
              ] as const
            ).map(
              ([id, label, glyph]) =>
                html` <button
                  class="icon-button"
                  aria-label=${label}
                  title=${label}
                  @click=${() => this.context.show(id)}>
                  ${icon(glyph, 20)}
                </button>`,
            )}</span
          >`
        : nothing}
      ${model.hello?.foxglove
        ? html`<button
            class="icon-button foxglove"
            title="Watch in Foxglove"
            aria-label="Watch in Foxglove"
            @click=${() => ask('foxglove')}>
            ${icon('share')}
          </button>`
        : nothing}
      <rave-bell .context=${this.context}></rave-bell>
      <button
        class="icon-button theme"
        title="Light or dark"
        aria-label="Light or dark"
        @click=${() => ask('theme')}>
        ${icon(palette.theme === 'dark' ? 'sun' : 'moon')}
      </button>
      ${model.hello
        ? html`<i class="rule"></i
            ><span class="person"
              >${face(model.hello.seen_by ?? model.hello.user, true)}<span
                >${roleText((model.hello.seen_by ?? model.hello.user).role)}</span
              ></span
            >`
        : nothing}`;
  }

  private renderRate(): TemplateResult {
    const {link, model} = this.context;
    const slow =
      model.time?.state === 'running' && link.state === 'open' && link.rate_hz < kSlow_hz;
    const age = model.live && link.state === 'open' ? link.age.newest_ms : null;
    const old = age !== null && age > kOld_ms;
    return html`<span
      class="chip rate ${slow || old ? 'slow' : ''}"
      title="Pictures per second, age of the newest one when it came, and bytes over the line"
      >${icon('activity', 14)} ${link.rate_hz} Hz
      ${age === null ? nothing : html`<span class="age">${Math.round(age)} ms</span>`}
      <em>${sizeText(link.bytesPerSecond)}/s</em></span
    >`;
  }

  private renderPeople(): TemplateResult | typeof nothing {
    const {others} = this.context.model;
    if (others.length === 0) return nothing;
    const names = others
      .slice(0, kNamed)
      .map((person) => `${person.name}, ${roleText(person.role)}`);
    if (others.length > kNamed) names.push(`and ${others.length - kNamed} more`);
    const label = `${others.length + 1} people watch: you; ${names.join('; ')}`;
    const faces = html`${others.slice(0, kFaces).map((person) => face(person, false))}
    ${others.length > kFaces
      ? html`<i class="face rest" aria-hidden="true">+${others.length - kFaces}</i>`
      : nothing}`;
    if (!this.context.model.may('rights'))
      return html`<span class="people" title=${names.join('\n')} role="img" aria-label=${label}
        >${faces}</span
      >`;
    return html`<button
      class="people"
      title=${[...names, 'Click: all people'].join('\n')}
      aria-label=${`${label}. Open the list`}
      @click=${() => this.dispatchEvent(new CustomEvent('people'))}>
      ${faces}
    </button>`;
  }

  static override styles = [
    controls,
    css`
      :host {
        display: flex;
        align-items: center;
        gap: 10px;
        height: var(--h-topbar);
        flex: none;
        padding: 0 14px;
      }
      .brand {
        display: flex;
        align-items: center;
        gap: 8px;
        letter-spacing: 0.04em;
      }
      .rule {
        width: 1px;
        height: 20px;
        background: var(--line-2);
      }
      h1 {
        margin: 0;
        font-size: var(--fs-15);
        font-weight: var(--fw-strong);
        flex: none;
        max-width: 34vw;
        white-space: nowrap;
        overflow: hidden;
        text-overflow: ellipsis;
      }
      .state {
        display: inline-flex;
        align-items: center;
        gap: 6px;
        height: 22px;
        padding: 0 10px;
        border-radius: var(--r-full);
        font-size: var(--fs-12);
        background: linear-gradient(var(--soft, var(--ok-soft)) 0 0), var(--bg-1);
        color: var(--ok);
        white-space: nowrap;
      }
      .state i {
        width: 7px;
        height: 7px;
        border-radius: 50%;
        background: currentColor;
      }
      .state.replay {
        --soft: var(--intent-soft);
        color: var(--intent);
      }
      .state.waits {
        --soft: var(--warn-soft);
        color: var(--warn);
      }
      .state.lost {
        --soft: var(--danger-soft);
        color: var(--danger);
      }
      .state.opening {
        --soft: var(--bg-2);
        color: var(--text-2);
      }
      .about {
        color: var(--text-2);
        font-size: var(--fs-12);
        white-space: nowrap;
      }
      .find {
        display: flex;
        align-items: center;
        gap: 8px;
        flex: 0 1 300px;
        min-width: 40px;
        height: 30px;
        padding: 0 8px;
        border: 1px solid var(--line-2);
        border-radius: var(--r-3);
        background: var(--bg-1);
        color: var(--text-3);
        font-size: var(--fs-12);
        overflow: hidden;
      }
      .find span {
        flex: 1;
        text-align: left;
        white-space: nowrap;
        overflow: hidden;
        text-overflow: ellipsis;
      }
      kbd {
        padding: 0 6px;
        border: 1px solid var(--line-2);
        border-radius: var(--r-2);
        background: var(--bg-2);
        color: var(--text-2);
        font: 500 var(--fs-11) var(--font-ui);
        white-space: nowrap;
      }
      .rate em {
        font-style: normal;
        color: var(--text-3);
      }
      .rate.slow {
        background: linear-gradient(var(--warn-soft) 0 0), var(--bg-1);
        color: var(--warn);
      }
      .rate.slow em {
        color: inherit;
      }
      .person {
        display: flex;
        align-items: center;
        gap: 8px;
        font-size: var(--fs-12);
        white-space: nowrap;
      }
      .people {
        display: flex;
        align-items: center;
        height: var(--h-control);
        padding-left: 4px;
        border-radius: var(--r-full);
      }
      button.people:hover {
        background: var(--bg-3);
      }
      .pen {
        display: none;
      }
      @media (max-width: 599px) and (max-height: 700px) {
        .pen {
          display: flex;
          align-items: center;
        }
        rave-clock {
          margin-right: 8px;
          font-weight: var(--fw-strong);
          font-variant-numeric: tabular-nums;
        }
        .find,
        .person {
          display: none !important;
        }
      }
      .face {
        display: grid;
        place-items: center;
        width: 24px;
        height: 24px;
        border-radius: 50%;
        background: var(--person-fill);
        color: var(--on-fill);
        font-style: normal;
        font-size: 10px;
        font-weight: 600;
      }
      .face.you {
        background: var(--intent-fill);
        color: #fff;
      }
      .people .face {
        margin-left: -3px;
        box-shadow: 0 0 0 1.5px var(--bg-0);
      }
      .people .rest {
        background: var(--bg-1);
        color: var(--text-2);
      }
      @media (max-width: 1279px) {
        .about,
        .rate em,
        .wide,
        .find kbd,
        .person span {
          display: none;
        }
      }
      @media (max-width: 1099px) {
        .brand b,
        .find span {
          display: none;
        }
        .find {
          flex: none;
          justify-content: center;
        }
      }
      @media (max-width: 899px) and (min-width: 600px) {
        .rate,
        .brand + .rule,
        .segments + .icon-button {
          display: none;
        }
      }
      @media (max-width: 800px) {
        .people,
        .rule {
          display: none;
        }
      }
      @media (max-width: 700px) {
        h1 {
          flex: 0 1 auto;
        }
      }
      @media (max-width: 599px) {
        :host {
          padding: 0 10px;
          height: 52px;
        }
        .brand b,
        .find span,
        .find kbd,
        .rate {
          display: none;
        }
        .find svg {
          width: 20px;
          height: 20px;
        }
        .find {
          flex: none;
          width: 40px;
          height: 40px;
          justify-content: center;
          background: none;
          border-color: transparent;
        }
        .theme,
        .foxglove,
        rave-bell {
          display: none;
        }
        .space ~ .space {
          display: none;
        }
        h1 {
          max-width: 46vw;
        }
        .state {
          order: 1;
        }
        .find {
          order: 2;
        }
        .person {
          order: 3;
        }
      }
    `,
  ];
}

function face(person: Person, you: boolean): TemplateResult {
  return html`<i class="face ${you ? 'you' : ''}" style=${faceStyle(person.name)} aria-hidden="true"
    >${initials(person.name)}</i
  >`;
}

customElements.define('rave-top-bar', TopBar);
