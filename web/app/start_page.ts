// SPDX-License-Identifier: Apache-2.0
import {html, nothing, type TemplateResult} from 'lit';
import {inProgress, lengthText, stateText, verdictText} from '../panels/conduct/conduct';
import '../panels/conduct/run_control';
import {conductStyles} from '../panels/conduct/styles';
import type {AskConduct, Conduct, KnownRecording, KnownScenario} from '../protocol/messages';
import {icon} from '../ui/icons';
import {LiveElement} from '../ui/live_element';
import {controls} from '../ui/styles';
import {faceStyle, initials, roleText} from '../ui/words';
import {startStyles} from './start_page_styles';

/** The page without a run: what can be started and what was recorded. */
export class StartPage extends LiveElement {
  private chosen = '';
  private seed = '';
  private filter = '';
  private note = '';

  protected override listen(): (() => void)[] {
    const {model} = this.context;
    return this.renderAfter(model.conductChanged, model.runChanged, model.peopleChanged);
  }

  override render(): TemplateResult {
    const {conduct} = this.context.model;
    if (conduct === null) return html`<p class="alone" role="status">Loading the list ...</p>`;
    if (!conduct.may) return this.renderWaiting(conduct);
    const scenario = conduct.scenarios?.find(({name}) => name === this.chosen);
    return html`<div class="left">
        ${this.renderScenarios(conduct)} ${this.renderRecordings(conduct)}
      </div>
      <div class="right">
        <section class="panel start">${this.renderStart(conduct, scenario)}</section>
        <section class="panel people">${this.renderPeople()}</section>
      </div>`;
  }

  private renderWaiting({run}: Conduct): TemplateResult {
    const going = inProgress(run);
    return html`<div class="alone" role="status">
      <h1>${going ? `${run?.scenario} starts` : 'No run in progress'}</h1>
      <p>
        ${run === null || going
          ? 'You see the next run here as soon as it is started.'
          : `The last run was ${run.scenario}: ${stateText(run.state).toLowerCase()}. ${run.text}`}
      </p>
    </div>`;
  }

  private renderScenarios(conduct: Conduct): TemplateResult {
    const all = conduct.scenarios ?? [];
    const shown = all.filter(({name, text}) =>
      `${name} ${text}`.toLowerCase().includes(this.filter.toLowerCase()),
    );
    return html`<section class="panel">
      <header>
        <h2>Scenarios <small>${all.length}</small></h2>
        <span class="space"></span>
        <label class="field filter"
          >${icon('search', 14)}<input
            type="search"
            placeholder="Name or text"
            aria-label="Find a scenario"
            @input=${(event: Event) => {
              this.filter = (event.target as HTMLInputElement).value;
              this.requestUpdate();
            }}
        /></label>
      </header>
      <div class="cards">${shown.map((scenario) => this.renderCard(scenario))}</div>
      ${shown.length === 0 ? html`<p>No scenario has this in its name or text.</p>` : nothing}
    </section>`;
  }

  private renderCard(scenario: KnownScenario): TemplateResult {
    const {name, text, duration_s} = scenario;
    return html`<button
      class="card"
      aria-pressed=${name === this.chosen}
      @click=${() => this.choose(name)}
      @dblclick=${() => void this.start(name)}>
      <span class="head"><b>${name}</b><small>${lengthText(duration_s)}</small></span>
      <span class="text">${text}</span>
      ${scenario.people
        ? html`<span class="chip">${icon('userPlus', 13)} invites ${scenario.people}</span>`
        : nothing}
    </button>`;
  }

  private renderRecordings(conduct: Conduct): TemplateResult {
    const all = conduct.recordings ?? [];
    return html`<section class="panel recordings">
      <header>
        <h2>Recordings <small>${all.length}</small></h2>
      </header>
      ${all.length === 0
        ? html`<p>There are no runs below <code>runs</code> yet.</p>`
        : html`<div class="scroll" tabindex="0" role="region" aria-label="Recordings">
            <table>
              <thead>
                <tr>
                  <th>Scenario</th>
                  <th class="name">Run</th>
                  <th class="number">Lasted</th>
                  <th class="number seed">Seed</th>
                  <th>Verdict</th>
                  <th></th>
                </tr>
              </thead>
              <tbody>
                ${all.map((recording) => this.renderRecording(recording))}
              </tbody>
            </table>
          </div>`}
    </section>`;
  }

  private renderRecording(recording: KnownRecording): TemplateResult {
    const {name, scenario, verdict} = recording;
    return html`<tr>
      <th scope="row">${scenario || 'unknown'}</th>
      <td class="name">${name}</td>
      <td class="number">
        ${recording.lasted_s === undefined ? '' : `${recording.lasted_s.toFixed(2)} s`}
      </td>
      <td class="number seed">${recording.seed ?? ''}</td>
      <td><span class="state ${verdict}">${verdictText(verdict)}</span></td>
      <td>
        <button
          class="icon-button"
          title="Show it in all pages"
          aria-label="Open ${name}"
          @click=${() => void this.ask({type: 'conduct', do: 'open', name})}>
          ${icon('play', 15)}
        </button>
      </td>
    </tr>`;
  }

  private renderStart(conduct: Conduct, scenario: KnownScenario | undefined): TemplateResult {
    const going = inProgress(conduct.run);
    if (going || (scenario === undefined && conduct.run !== null))
      return html`<header><h2>Run</h2></header>
        <rave-run-control .context=${this.context}></rave-run-control>`;
    if (scenario === undefined)
      return html`<header><h2>Start</h2></header>
        <p>Choose a scenario.</p>`;
    return html`<header><h2>Start</h2></header>
      <form
        @submit=${(event: Event) => {
          event.preventDefault();
          void this.start(scenario.name);
        }}>
        <h3>${scenario.name} <small>${lengthText(scenario.duration_s)}</small></h3>
        <p>${scenario.text}</p>
        <label class="row"
          ><code>seed</code
          ><span class="field"
            ><input
              name="seed"
              inputmode="numeric"
              pattern="[0-9]*"
              placeholder=${scenario.seed ?? 1}
              .value=${this.seed}
              @input=${(event: Event) => {
                this.seed = (event.target as HTMLInputElement).value.trim();
              }} /></span
        ></label>
        <button class="main">${icon('play', 15)} Start ${scenario.name}</button>
        ${this.note === '' ? nothing : html`<p class="note bad" role="alert">${this.note}</p>`}
        <p class="command"><code>rave run ${scenario.name} --gui</code> does the same.</p>
      </form>`;
  }

  private renderPeople(): TemplateResult {
    const {model} = this.context;
    const {others} = model;
    return html`<header>
        <h2>Here now <small>${others.length + 1}</small></h2>
      </header>
      <ul>
        <li>
          <i class="face you" style=${faceStyle(model.user)}>${initials(model.user)}</i><b>You</b
          ><span>${roleText(model.hello?.user.role ?? '')}</span>
        </li>
        ${others.map(
          ({name, role}) =>
            html`<li>
              <i class="face" style=${faceStyle(name)}>${initials(name)}</i><b>${name}</b
              ><span>${roleText(role)}</span>
            </li>`,
        )}
      </ul>
      <p>They see the run when you start it.</p>`;
  }

  private choose(name: string): void {
    this.chosen = name;
    this.seed = '';
    this.note = '';
    this.requestUpdate();
  }

  private start(name: string): Promise<void> {
    const seed = this.seed === '' ? {} : {seed: Number(this.seed)};
    return this.ask({type: 'conduct', do: 'start', name, ...seed});
  }

  private async ask(request: Omit<AskConduct, 'request'>): Promise<void> {
    const answer = await this.context.commands.ask(request);
    this.note = answer.good ? '' : answer.text;
    if (answer.good) this.chosen = '';
    this.requestUpdate();
  }

  static override styles = [controls, conductStyles, startStyles];
}

customElements.define('rave-start', StartPage);
