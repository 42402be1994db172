// SPDX-License-Identifier: Apache-2.0
import {css, html, nothing, type TemplateResult} from 'lit';
import type {AskConduct, ConductedRun, DueEntry} from '../../protocol/messages';
import {clockText} from '../../ui/clock';
import {icon} from '../../ui/icons';
import {LiveElement} from '../../ui/live_element';
import {controls} from '../../ui/styles';
import {completions, readLine} from './command_line';
import {dueState, inProgress, stateText} from './conduct';
import {conductStyles} from './styles';

/** The run that this server started: end it, start it again, what it has in store, its log. */
export class RunControl extends LiveElement {
  private note = '';
  private line = '';
  private said = '';
  /** As it is typed; empty: the same. */
  private seed = '';

  protected override listen(): (() => void)[] {
    const {model} = this.context;
    return this.renderAfter(
      model.conductChanged,
      model.runChanged,
      model.eventsChanged,
      model.timeChanged,
    );
  }

  override render(): TemplateResult {
    const {conduct} = this.context.model;
    if (conduct === null)
      return html`<p>
        This server shows a run that was started elsewhere. Started without an argument,
        <code>rave gui</code> starts and ends runs.
      </p>`;
    const {run} = conduct;
    return html`<div class="bar">
        ${run === null
          ? html`<span>No run was started here.</span>`
          : html`<b>${run.scenario}</b
              ><span class="state ${run.state}" role="status">${stateText(run.state)}</span
              >${run.seed === undefined ? nothing : html`<span>seed ${run.seed}</span>`}`}
        <span class="space"></span>
        ${conduct.may ? this.renderButtons(run) : nothing}
      </div>
      ${this.note === '' ? nothing : html`<p class="note bad" role="alert">${this.note}</p>`}
      ${run === null ? nothing : this.renderRun(run)} ${conduct.may ? this.renderLine() : nothing}`;
  }

  private renderButtons(run: ConductedRun | null): TemplateResult {
    const going = inProgress(run);
    return html`${run === null
      ? nothing
      : html`<label class="field seed"
            >seed<input
              inputmode="numeric"
              placeholder=${run.seed ?? 'same'}
              aria-label="Seed of the next start"
              .value=${this.seed}
              @input=${(event: Event) => {
                this.seed = (event.target as HTMLInputElement).value.trim();
              }} /></label
          ><button class="plain restart" @click=${() => void this.restart()}>
            ${icon('rotateCcw', 14)} ${going ? 'Restart' : 'Start again'}
          </button>`}
    ${going
      ? html`<button
          class="plain bad end"
          title=${run?.state === 'ending' ? 'Kill it: results may be missing' : 'End the run'}
          @click=${() => void this.ask({type: 'conduct', do: 'end'})}>
          ${icon('x', 14)} ${run?.state === 'ending' ? 'Kill it' : 'End run'}
        </button>`
      : html`<button
          class="plain close"
          @click=${() => void this.ask({type: 'conduct', do: 'close'})}>
          ${icon('list', 14)} Scenarios
        </button>`}`;
  }

  private renderRun(run: ConductedRun): TemplateResult {
    const {due = [], log = []} = run;
    return html`<div class="scroll">
      ${run.text === '' ? nothing : html`<p class="ended">${run.text}</p>`}
      ${run.folder
        ? html`<p class="where">
            ${icon('fileText', 13)} <code>${run.folder}</code>${run.process
              ? html` · process ${run.process}`
              : nothing}
          </p>`
        : nothing}
      ${due.length === 0
        ? nothing
        : html`<h3>What the scenario has in store</h3>
            <ul class="due">
              ${due.map((entry) => this.renderDue(entry))}
            </ul>`}
      ${log.length === 0
        ? nothing
        : html`<h3>Log of its processes</h3>
            <pre tabindex="0" aria-label="Log of the run">${log.join('\n')}</pre>`}
    </div>`;
  }

  private renderDue(entry: DueEntry): TemplateResult {
    const {state, times_s} = dueState(entry, this.context.model);
    const glyph = ({happened: 'check', refused: 'circleX', waits: 'hourglass'} as const)[state];
    return html`<li class=${state}>
      ${icon(glyph, 14)}<span class="what">${entry.name || entry.text}</span
      ><span class="when">${entry.trigger}</span
      ><span class="times"
        >${state === 'waits' ? 'waits' : times_s.map((t) => clockText(t)).join(', ')}</span
      >
    </li>`;
  }

  private renderLine(): TemplateResult {
    const known = completions(this.line);
    return html`${this.said === '' ? nothing : html`<p class="said" role="status">${this.said}</p>`}
      <form
        class="line"
        @submit=${(event: Event) => {
          event.preventDefault();
          void this.obey();
        }}>
        <span aria-hidden="true">›</span
        ><input
          aria-label="Command"
          placeholder="start, end, restart, pace ..."
          autocomplete="off"
          spellcheck="false"
          .value=${this.line}
          @keydown=${(event: KeyboardEvent) => {
            if (event.key !== 'Tab' || event.shiftKey || known.length !== 1) return;
            event.preventDefault();
            this.type(`${known[0][0].split(' ')[0]} `);
          }}
          @input=${(event: Event) => this.type((event.target as HTMLInputElement).value)} /><small
          >${known.map(([usage, what]) => `${usage}: ${what}`).join(' · ')}</small
        >
      </form>`;
  }

  private type(line: string): void {
    this.line = line;
    this.requestUpdate();
  }

  private async obey(): Promise<void> {
    const {model, link} = this.context;
    const asked = readLine(
      this.line,
      (model.conduct?.scenarios ?? []).map(({name}) => name),
    );
    this.said = 'text' in asked ? asked.text : '';
    this.note = 'error' in asked ? asked.error : '';
    if ('error' in asked) return this.requestUpdate();
    this.type('');
    if ('transport' in asked) link.send(asked.transport);
    if ('conduct' in asked) await this.ask(asked.conduct);
  }

  private restart(): Promise<void> {
    const seed = Number(this.seed);
    const given = this.seed !== '' && Number.isInteger(seed) && seed >= 0;
    return this.ask({type: 'conduct', do: 'restart', ...(given ? {seed} : {})});
  }

  private async ask(request: Omit<AskConduct, 'request'>): Promise<void> {
    const answer = await this.context.commands.ask(request);
    this.note = answer.good ? '' : answer.text;
    this.requestUpdate();
  }

  static override styles = [
    controls,
    conductStyles,
    css`
      :host {
        display: flex;
        flex-direction: column;
        height: 100%;
        min-height: 0;
        background: var(--bg-1);
        font-size: var(--fs-12);
      }
      :host > p {
        padding: 0 14px;
        color: var(--text-2);
      }
      .seed input {
        width: 56px;
      }
      .scroll {
        flex: 1;
        min-height: 0;
        overflow: auto;
        padding: 0 14px 10px;
      }
      h3 {
        margin: 12px 0 4px;
        font-size: var(--fs-11);
        font-weight: 400;
        color: var(--text-2);
      }
      .where {
        display: flex;
        flex-wrap: wrap;
        align-items: center;
        gap: 6px;
        margin: 4px 0;
        color: var(--text-2);
      }
      .due {
        margin: 0;
        padding: 0;
        list-style: none;
      }
      .due li {
        display: flex;
        align-items: center;
        gap: 8px;
        min-height: var(--h-row);
        border-top: 1px solid var(--line-1);
      }
      .due .what {
        flex: 1;
        min-width: 0;
        overflow-wrap: anywhere;
      }
      .due .when,
      .due .times {
        color: var(--text-2);
      }
      .due .happened svg {
        color: var(--ok);
      }
      .due .refused svg {
        color: var(--danger);
      }
      .due .waits svg {
        color: var(--text-3);
      }
      .said {
        margin: 0;
        padding: 4px 14px;
      }
      .line {
        display: flex;
        flex-wrap: wrap;
        align-items: center;
        gap: 8px;
        flex: none;
        margin: 6px 10px 8px;
        padding: 4px 10px;
        border: 1px solid var(--line-2);
        border-radius: var(--r-3);
      }
      .line:focus-within {
        border-color: var(--intent);
      }
      .line input {
        flex: 1 1 160px;
        min-width: 0;
        min-height: 24px;
        border: 0;
        outline: 0;
        background: none;
        color: var(--text-1);
        font: 400 var(--fs-12) var(--font-code);
      }
      .line small {
        color: var(--text-2);
      }
      pre {
        margin: 0;
        max-height: 240px;
        overflow: auto;
        padding: 8px 10px;
        border-radius: var(--r-3);
        background: var(--bg-2);
        font: 400 var(--fs-11) / 1.5 var(--font-code);
        white-space: pre-wrap;
        overflow-wrap: anywhere;
      }
    `,
  ];
}

customElements.define('rave-run-control', RunControl);
