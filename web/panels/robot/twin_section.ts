// SPDX-License-Identifier: Apache-2.0
import {css, html, nothing, type TemplateResult} from 'lit';
import {icon} from '../../ui/icons';
import {LiveElement} from '../../ui/live_element';
import {controls} from '../../ui/styles';
import type {KnownRobot} from '../../model/run_model';
import type {Shadow, Twin} from '../../protocol/messages';

const kDegrees = 180 / Math.PI;

/** The set of drivers that a robot is handed over to next, in the words of a request; `mixed`: one
 * set is real. */
export function nextDrivers(mixed: boolean, twin: Twin): 'real' | 'simulated' | 'first' | 'twin' {
  if (mixed) return twin.simulated ? 'real' : 'simulated';
  // Each that was made has changed sides.
  return twin.made % 2 === 0 ? 'twin' : 'first';
}

/** A difference with its unit: metres, or a share in percent. */
export function differenceText(value: number, unit: string): string {
  return unit === 'share' ? `${(100 * value).toFixed(1)} %` : `${value.toFixed(3)} m`;
}

/** The two sets of drivers of a robot: hand-over, and the shadow while it is real. */
export class TwinSection extends LiveElement {
  static override properties = {robot: {type: Number}};
  declare robot: number;
  /** Of which robot a hand-over was pressed once. */
  private sure: number | null = null;
  /** What was refused before it began, by robot. */
  private readonly notes = new Map<string, string>();
  /** Refusals that were there before this page asked, by robot. */
  private readonly seen = new Map<string, number>();

  protected override listen(): (() => void)[] {
    return this.renderAfter(this.context.model.drivesChanged);
  }

  override willUpdate(changed: Map<string, unknown>): void {
    if (changed.has('robot')) this.sure = null;
  }

  private async ask(
    what: 'hand_over' | 'reset_shadow',
    to?: ReturnType<typeof nextDrivers>,
  ): Promise<void> {
    const {model, commands} = this.context;
    const {name} = model.robots[this.robot];
    this.sure = null;
    this.notes.delete(name);
    const answer = await commands.ask({
      type: 'twin',
      do: what,
      slots: [this.robot],
      ...(to === undefined ? {} : {to}),
    });
    if (!answer.good) this.notes.set(name, answer.text);
    this.requestUpdate();
  }

  override render(): TemplateResult | typeof nothing {
    const {model} = this.context;
    const robot = model.robots[this.robot];
    const state = model.drives.get(this.robot);
    if (!model.live || robot === undefined || state === undefined) return nothing;
    return html`${state.twin === undefined ? nothing : this.renderTwin(robot, state.twin)}
    ${state.shadow === undefined ? nothing : this.renderShadow(robot, state.shadow)}`;
  }

  private renderTwin(robot: KnownRobot, twin: Twin): TemplateResult {
    if (!this.seen.has(robot.name)) this.seen.set(robot.name, twin.refused);
    const to = nextDrivers(robot.mixed === true, twin);
    const serves =
      to === 'first' || to === 'twin'
        ? `${to === 'twin' ? 'first' : 'second'} set in use`
        : `${twin.simulated ? 'simulated' : 'real'} drivers in use`;
    const word =
      to === 'first' || to === 'twin' ? `the ${to === 'twin' ? 'second' : 'first'} set` : to;
    const refused = twin.refused > (this.seen.get(robot.name) ?? 0) && !twin.under_way;
    const note = this.notes.get(robot.name);
    return html`<h4>
        Hand-over<span class="space"></span><em class=${twin.simulated ? '' : 'real'}>${serves}</em>
      </h4>
      ${twin.under_way
        ? html`<p role="status">
            ${icon('refresh', 14)} Hand-over in progress: the other drivers are opened, and the
            robot slows down until it stands.
          </p>`
        : html`<div class="row">
              ${this.sure === this.robot
                ? html`<button class="main" @click=${() => void this.ask('hand_over', to)}>
                      Hand over now</button
                    ><button
                      class="plain"
                      @click=${() => {
                        this.sure = null;
                        this.requestUpdate();
                      }}>
                      Keep
                    </button>`
                : html`<button
                    class="plain"
                    @click=${() => {
                      this.sure = this.robot;
                      this.requestUpdate();
                    }}>
                    ${icon('refresh', 14)} Hand over to ${word} …
                  </button>`}
            </div>
            ${this.sure === this.robot
              ? html`<p class="faint">
                  ${to === 'real'
                    ? 'Put the real robot where this one is, with the same heading. Its program ' +
                      'continues with the hardware. A stop stays in effect.'
                    : 'The robot stops for the change; its program continues.'}
                </p>`
              : nothing}
            ${note !== undefined
              ? html`<p class="bad" role="alert">${note}</p>`
              : twin.last === ''
                ? nothing
                : html`<p class=${refused ? 'bad' : 'faint'} role="status">
                    ${refused ? 'Refused: ' : 'Last: '}${twin.last}
                  </p>`}`}`;
  }

  private renderShadow(robot: KnownRobot, shadow: Shadow): TemplateResult {
    const {model} = this.context;
    const since_s = Math.max(0, (model.poses.newest?.time_s ?? shadow.since_s) - shadow.since_s);
    return html`<h4>
        Shadow<span class="space"></span
        ><em>${shadow.running ? `for ${since_s.toFixed(0)} s` : 'not running'}</em>
      </h4>
      ${shadow.running
        ? html`<table>
              <thead>
                <tr>
                  <th>difference</th>
                  <th>now</th>
                  <th>largest</th>
                </tr>
              </thead>
              <tbody>
                <tr>
                  <td>position</td>
                  <td>${differenceText(shadow.m, 'm')}</td>
                  <td>${differenceText(shadow.most_m, 'm')}</td>
                </tr>
                <tr>
                  <td>heading</td>
                  <td>${(kDegrees * shadow.rad).toFixed(1)}°</td>
                  <td>${(kDegrees * shadow.most_rad).toFixed(1)}°</td>
                </tr>
                ${shadow.readings.map(
                  ({sensor, unit, last, most}) =>
                    html`<tr>
                      <td>${sensor}</td>
                      <td>${differenceText(last, unit)}</td>
                      <td>${differenceText(most, unit)}</td>
                    </tr>`,
                )}
              </tbody>
            </table>
            ${model.commands(this.robot)
              ? html`<div class="row">
                  <button class="plain" @click=${() => void this.ask('reset_shadow')}>
                    Reset the shadow
                  </button>
                </div>`
              : nothing}`
        : html`<p class="faint">
            The simulated twin runs beside ${robot.name} while its real drivers are in use.
          </p>`}`;
  }

  static override styles = [
    controls,
    css`
      :host {
        display: block;
        font-size: var(--fs-12);
      }
      h4 {
        display: flex;
        align-items: center;
        gap: 6px;
        margin: 14px 0 6px;
        color: var(--text-2);
        font-size: var(--fs-12);
        font-weight: var(--fw-medium);
      }
      h4 em {
        font-style: normal;
        font-weight: 400;
        color: var(--text-3);
        font-size: var(--fs-11);
      }
      h4 em.real {
        color: var(--text-1);
        font-weight: var(--fw-strong);
      }
      .row {
        display: flex;
        flex-wrap: wrap;
        gap: 8px;
      }
      .row button {
        display: inline-flex;
        align-items: center;
        gap: 6px;
        height: var(--h-control);
        padding: 0 10px;
        border-radius: var(--r-3);
        font-size: var(--fs-12);
      }
      .main {
        background: var(--intent-fill);
        color: #fff;
      }
      .plain {
        background: var(--bg-3);
        color: var(--text-1);
        border: 1px solid var(--line-2);
      }
      p {
        display: flex;
        align-items: center;
        gap: 6px;
        margin: 6px 0 0;
        line-height: 1.35;
      }
      p svg {
        flex: none;
      }
      .faint {
        color: var(--text-3);
      }
      .bad {
        color: var(--danger);
      }
      table {
        width: 100%;
        margin-bottom: 6px;
        border-collapse: collapse;
        font-variant-numeric: tabular-nums;
      }
      th {
        color: var(--text-3);
        font-size: var(--fs-11);
        font-weight: 400;
        text-align: right;
      }
      th:first-child,
      td:first-child {
        text-align: left;
      }
      td {
        padding: 2px 0;
        text-align: right;
        border-top: 1px solid var(--line-1);
      }
      td:first-child {
        color: var(--text-2);
      }
    `,
  ];
}

customElements.define('rave-twin', TwinSection);
