// SPDX-License-Identifier: Apache-2.0
import {html, nothing, type TemplateResult} from 'lit';
import type {Person} from '../protocol/messages';
import './bell';
import './run_clock';
import {LiveElement} from '../ui/live_element';
import './way_chip';
import {kLayouts, type LayoutName} from './dock';
import {icon} from '../ui/icons';
import {logo} from './logo';
import {controls} from '../ui/styles';
import {faceStyle, initials, roleText, sizeText, startedText} from '../ui/words';
import {topBarStyles} from './top_bar_styles';

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
    if (model.hello.run.source === 'none') return ['No run in progress', 'opening'];
    if (!model.live) return ['Replay', 'replay'];
    if (model.time?.state === 'waiting') return ['Waits', 'waits'];
    if (model.time?.state === 'paused') return ['Paused', 'waits'];
    return model.time?.state === 'ended' ? ['Ended', 'opening'] : ['Live', 'live'];
  }

  private about(): string {
    const {model} = this.context;
    const run = model.hello?.run;
    if (run === undefined || run.source === 'none') return '';
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
      ${this.renderLayouts()}
      <span class="space"></span>
      <button class="find" aria-label="Find a robot, panel or moment" @click=${() => ask('find')}>
        ${icon('search', 15)}<span>Find a robot, panel or moment</span><kbd>Ctrl K</kbd>
      </button>
      <span class="space"></span>
      ${this.renderRecording()}
      <rave-way .context=${this.context}></rave-way>
      ${this.renderRate()} ${this.renderPeople()} ${this.renderPen()}
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

  /** The layouts that this person may choose. */
  private renderLayouts(): TemplateResult | typeof nothing {
    const {model} = this.context;
    const ask = (name: string) => this.dispatchEvent(new CustomEvent(name));
    return this.layout
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
      : nothing;
  }

  /** The recording that is shown. */
  private renderRecording(): TemplateResult | typeof nothing {
    const recording = this.context.model.hello?.run.recording;
    return recording && !this.context.model.live
      ? html`<span
          class="chip wide"
          title=${recording.whole
            ? nothing
            : 'Its end or the part of a host is missing: rave info says which'}
          >${icon('fileText', 14)} ${recording.name}
          ${sizeText(recording.bytes)}${recording.whole ? '' : ', incomplete'}</span
        >`
      : nothing;
  }

  /** On a pen, in the place of panels beside the world. */
  private renderPen(): TemplateResult | typeof nothing {
    return this.context.model.live
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
      : nothing;
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

  static override styles = [controls, topBarStyles];
}

function face(person: Person, you: boolean): TemplateResult {
  return html`<i class="face ${you ? 'you' : ''}" style=${faceStyle(person.name)} aria-hidden="true"
    >${initials(person.name)}</i
  >`;
}

customElements.define('rave-top-bar', TopBar);
