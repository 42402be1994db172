// SPDX-License-Identifier: Apache-2.0
import {css, html, nothing, svg, type TemplateResult} from 'lit';
import {icon} from '../../app/icons';
import {LiveElement} from '../../app/live_element';
import {controls, glyphs} from '../../app/styles';
import {RobotFlag, kCommandsOf} from '../../protocol/frames';
import type {Parameter} from '../../protocol/messages';
import '../lease_bar';
import {usefulRange} from '../parameter_range';
import {guardOf, lastAct} from './guard_act';
import './twin_section';
import {toldLines} from './told';
import {SetValues, type SetValue} from './set_values';
import {SpeedTrace, askedLines, kTrace_s, type DrivenVelocity} from './speed_trace';

const kRefresh_ms = 250;
const kTakes = ['goal', 'path', 'drive', 'text', 'place'];

/** One robot: who drives it, what it takes, its parameters, its guard and how fast it goes. */
export class RobotPanel extends LiveElement {
  private readonly values = new SetValues();
  private readonly notes = new Map<string, string>();
  private readonly trace = new SpeedTrace();

  protected override listen(): (() => void)[] {
    const {model, selection, palette, link} = this.context;
    const look = () => {
      const slot = selection.primary;
      link.look(this, slot === null || !model.live ? [] : [[slot, kCommandsOf]]);
    };
    look();
    return [
      ...this.renderAfter(
        model.rosterChanged,
        model.drivesChanged,
        selection.changed,
        palette.changed,
      ),
      ...[model.rosterChanged, selection.changed].map((signal) => signal.on(look)),
      () => link.look(this, []),
      this.every(kRefresh_ms, () => this.requestUpdate()),
    ];
  }

  override render(): TemplateResult {
    const {model, selection, palette, link} = this.context;
    const slot = selection.primary;
    const robot = slot === null ? undefined : model.robots[slot];
    if (slot === null || robot === undefined)
      return html`<div class="empty">
        ${icon('bot', 28)}
        <p>Select a robot to see it in detail.</p>
      </div>`;
    const hue = palette.hue(slot);
    const drive = model.drives.get(slot);
    const stopped = ((model.poses.newest?.flags[slot] ?? 0) & RobotFlag.stopped) !== 0;
    const mayStop = model.stops(slot) && !robot.recorded;
    const halt = (what: 'stop' | 'release') => link.send({type: 'halt', do: what, slots: [slot]});
    return html` <header>
        <i
          class="glyph ${robot.kind}"
          style="--hue:${robot.kind === 'real' ? hue.fill : hue.ink}"></i
        ><b style=${robot.kind === 'real' ? `color:${hue.ink}` : ''}>${robot.name}</b>
        <span class="chip"
          >${robot.kind}${robot.twin === undefined ? '' : ' now'}${robot.recorded
            ? ', recorded'
            : ''}</span
        ><span class="space"></span>${robot.team === ''
          ? nothing
          : html`<span class="chip">team ${robot.team}</span>`}
      </header>
      <div class="scroll">
        <rave-lease .context=${this.context} .robot=${slot}></rave-lease>
        ${mayStop
          ? html`<div class="halt">
              ${stopped && model.may('release')
                ? html`<button class="release" @click=${() => halt('release')}>
                    ${icon('play', 14)} Release ${robot.name}
                  </button>`
                : html`<button class="stop" ?disabled=${stopped} @click=${() => halt('stop')}>
                    ${icon('octagonX', 16)} ${stopped ? 'Stopped' : `Stop ${robot.name}`}
                  </button>`}
              ${drive?.order
                ? html`<span class="order">${drive.order}</span
                    ><button
                      class="plain"
                      @click=${() => void this.context.commands.cancel([slot])}>
                      Cancel
                    </button>`
                : nothing}
            </div>`
          : nothing}
        ${this.renderTakes(slot, drive?.takes ?? [])}
        <rave-twin .context=${this.context} .robot=${slot}></rave-twin>
        ${this.renderParameters(slot, robot.program, robot.parameters ?? [])}
        ${this.renderGuard(slot)}
        ${robot.sensors.length + robot.drivers.length === 0
          ? nothing
          : html`<h4>Drivers</h4>
              <dl>
                ${robot.sensors.map((sensor, i) => {
                  const {driver, origin} =
                    (robot.handedOver ? robot.twin?.sensors[i] : undefined) ?? sensor;
                  return html`<dt>${sensor.name}</dt>
                    <dd>
                      ${driver || 'unknown'}
                      ${origin === 'real'
                        ? nothing
                        : html`<span class="tag ${origin}">${origin}</span>`}
                    </dd>`;
                })}
                ${(robot.handedOver ? (robot.twin?.drivers ?? []) : robot.drivers).map(
                  (driver) =>
                    html`<dt>actuator</dt>
                      <dd>${driver}</dd>`,
                )}
                ${robot.host
                  ? html`<dt>host</dt>
                      <dd>${robot.host}</dd>`
                  : nothing}
              </dl>`}
        ${this.renderSpeed(slot)}
      </div>`;
  }

  private renderTakes(slot: number, takes: readonly string[]): TemplateResult | typeof nothing {
    const {model} = this.context;
    if (!model.live) return nothing;
    const why = model.whyNotTaken(slot, 'goal');
    return html`<h4>Takes</h4>
      <div class="takes">
        ${takes.length === 0 || model.robots[slot]?.recorded
          ? html`<span class="faint">${why}</span>`
          : kTakes.map(
              (what) =>
                html` <span class="chip ${takes.includes(what) ? 'yes' : ''}"
                  >${icon(takes.includes(what) ? 'check' : 'x', 12)} ${what}</span
                >`,
            )}
      </div>`;
  }

  private renderParameters(
    slot: number,
    program: string,
    parameters: readonly Parameter[],
  ): TemplateResult | typeof nothing {
    if (parameters.length === 0)
      return program === '' ? nothing : html`<h4>Program <code>${program}</code></h4>`;
    const may = this.context.model.commands(slot);
    return html`<h4>
        Program <code>${program}</code><span class="space"></span
        ><em>${may ? 'live' : 'read-only'}</em>
      </h4>
      <div class="parameters">
        ${parameters.map((parameter) => this.renderParameter(slot, parameter, may))}
      </div>`;
  }

  private renderParameter(slot: number, parameter: Parameter, may: boolean): TemplateResult {
    const name = `${this.context.model.robots[slot].name} ${parameter.key}`;
    const present = this.context.model.drives.get(slot)?.values?.[parameter.key] ?? parameter.value;
    const value = this.values.shown(name, present) ?? '';
    const set = (to: SetValue) => {
      this.values.ask(name, to, present);
      void this.set(slot, parameter.key, name, to);
    };
    const label = parameter.key.replace(/^program\./, '');
    const read = (event: Event) => (event.target as HTMLInputElement | HTMLSelectElement).value;
    let control: TemplateResult;
    if (parameter.kind === 'flag') {
      control = html`<input
        type="checkbox"
        aria-label=${parameter.key}
        .checked=${value === true}
        ?disabled=${!may}
        @change=${() => set(value !== true)} />`;
    } else if (parameter.kind === 'choice') {
      control = html`<select
        aria-label=${parameter.key}
        ?disabled=${!may}
        @change=${(event: Event) => set(read(event))}>
        ${(parameter.choices ?? []).map(
          (choice) => html`<option ?selected=${choice === value}>${choice}</option>`,
        )}
      </select>`;
    } else if (parameter.kind === 'text') {
      control = html`<input
        type="text"
        aria-label=${parameter.key}
        .value=${String(value)}
        ?disabled=${!may}
        @change=${(event: Event) => set(read(event))} />`;
    } else {
      const [low, high] = usefulRange(parameter, Number(value));
      const step = parameter.kind === 'integer' ? 1 : (high - low) / 200;
      control = html`<input
          type="range"
          aria-label=${parameter.key}
          min=${low}
          max=${high}
          step=${step}
          .value=${String(value)}
          ?disabled=${!may}
          @change=${(event: Event) => set(Number(read(event)))} />
        <input
          type="number"
          aria-label="${parameter.key}, value"
          step="any"
          min=${parameter.range?.[0] ?? nothing}
          max=${parameter.range?.[1] ?? nothing}
          .value=${String(value)}
          ?disabled=${!may}
          @change=${(event: Event) => set(Number(read(event)))} />`;
    }
    const note = this.notes.get(name);
    return html`<label
        title="${parameter.doc}${parameter.range
          ? ` From ${parameter.range[0]} to ${parameter.range[1]}.`
          : ''}"
        ><code>${label}</code>${control}<em>${parameter.unit}</em></label
      >
      ${note === undefined ? nothing : html`<p class="bad" role="alert">${note}</p>`}`;
  }

  private async set(slot: number, key: string, name: string, value: SetValue): Promise<void> {
    const answer = await this.context.commands.ask({type: 'set', slots: [slot], key, value});
    if (answer.good) this.notes.delete(name);
    else {
      this.notes.set(name, answer.text);
      this.values.refuse(name);
    }
    this.requestUpdate();
  }

  private renderGuard(slot: number): TemplateResult | typeof nothing {
    const {model} = this.context;
    const act = guardOf(model, slot, null);
    if (act !== null)
      return html`<h4>Guard</h4>
        <p class="guard">
          ${icon('shield', 14)} <b>${act.limit_mps.toFixed(2)} m/s</b> ${act.why}
        </p>`;
    const last = lastAct(model, slot);
    return last === null
      ? nothing
      : html`<h4>Guard</h4>
          <p class="faint">Lets it drive. ${last.ago_s.toFixed(0)} s ago: ${last.why}</p>`;
  }

  private renderSpeed(slot: number): TemplateResult | typeof nothing {
    const {model, commands} = this.context;
    const {past, newest} = model.poses;
    if (newest === null) return nothing;
    this.trace.take(slot, newest, past);
    const {points} = this.trace;
    if (points.length < 2) return nothing;
    const asked = (of: 'v' | 'w') => {
      const told = toldLines(model, slot, of, newest.time_s - kTrace_s);
      return told.length > 0 ? told : askedLines(commands.asked.of(slot), of, newest.time_s);
    };
    const last = points[points.length - 1];
    return html`<h4>
        Speed <em>${kTrace_s} s</em><span class="space"></span><em class="asked">asked</em
        ><em class="driven">driven</em>
      </h4>
      ${this.renderPlot(
        'forward',
        'm/s',
        0.25,
        points,
        (point) => point.v,
        asked('v'),
        newest.time_s,
      )}
      ${this.renderPlot(
        'turn left',
        'rad/s',
        0.5,
        points,
        (point) => point.w,
        asked('w'),
        newest.time_s,
      )}
      <p class="now"><b>${signed(last.v)}</b> m/s and <b>${signed(last.w ?? 0)}</b> rad/s now</p>`;
  }

  /** One velocity: what was asked of it by whomever, dashed, and what was driven. */
  private renderPlot(
    name: string,
    unit: string,
    least: number,
    driven: readonly DrivenVelocity[],
    of: (point: DrivenVelocity) => number | null,
    asked: [number, number][][],
    now_s: number,
  ): TemplateResult {
    const values = [...driven.map(of), ...asked.flat().map(([, value]) => value)].filter(
      (value): value is number => value !== null,
    );
    const top = Math.max(least, ...values);
    const low = Math.min(0, ...values);
    const at = (t: number, value: number) => [
      (240 * (1 - (now_s - t) / kTrace_s)).toFixed(1),
      (3 + (38 * (top - value)) / (top - low)).toFixed(1),
    ];
    const [, zero] = at(0, 0);
    const line = driven.flatMap((point) => {
      const value = of(point);
      return value === null ? [] : [at(point.t, value).join(',')];
    });
    return html`<div class="trace">
      <span>${signed(top)}<br />${name}<br />${signed(low)}</span>
      <svg
        class="plot"
        viewBox="0 0 240 44"
        preserveAspectRatio="none"
        role="img"
        aria-label=${`${name}, asked and driven, over the last ${kTrace_s} seconds; ` +
        `scale from ${signed(low)} to ${signed(top)} ${unit}`}>
        ${svg`<line x1="0" y1=${zero} x2="240" y2=${zero} />`}
        ${asked
          .map((part) => part.map(([t, value]) => at(t, value).join(',')).join(' '))
          .map((points) => svg`<polyline class="asked" points=${points} />`)}
        ${svg`<polyline points=${line.join(' ')} />`}
      </svg>
    </div>`;
  }

  static override styles = [
    controls,
    glyphs,
    css`
      :host {
        display: flex;
        flex-direction: column;
        height: 100%;
        background: var(--bg-1);
        font-size: var(--fs-12);
      }
      header {
        display: flex;
        align-items: center;
        gap: 8px;
        padding: 10px 12px;
        flex: none;
      }
      header b {
        font-size: var(--fs-15);
        overflow: hidden;
        text-overflow: ellipsis;
      }
      .scroll {
        flex: 1;
        overflow: auto;
        padding: 0 12px 12px;
      }
      .halt {
        display: flex;
        align-items: center;
        gap: 8px;
        margin-top: 8px;
      }
      .halt button {
        display: inline-flex;
        align-items: center;
        gap: 6px;
        height: var(--h-control);
        padding: 0 10px;
        border-radius: var(--r-3);
        font-size: var(--fs-12);
      }
      .halt .stop {
        background: var(--stop-fill);
        color: #fff;
        font-weight: var(--fw-medium);
      }
      .halt .stop:disabled {
        opacity: 1;
        background: var(--danger-soft);
        color: var(--danger);
      }
      .halt .release {
        border: 1px solid var(--danger);
        color: var(--danger);
      }
      .plain {
        background: var(--bg-3);
        border: 1px solid var(--line-2);
      }
      .order {
        flex: 1;
        min-width: 0;
        color: var(--intent);
        overflow: hidden;
        text-overflow: ellipsis;
        white-space: nowrap;
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
      h4 em,
      label em {
        font-style: normal;
        font-weight: 400;
        color: var(--text-3);
        font-size: var(--fs-11);
      }
      code {
        font: 400 var(--fs-11) var(--font-code);
        color: var(--text-2);
      }
      .takes {
        display: flex;
        flex-wrap: wrap;
        gap: 6px;
      }
      .takes .chip {
        gap: 4px;
        color: var(--text-3);
      }
      .takes .chip.yes {
        background: linear-gradient(var(--ok-soft) 0 0), var(--bg-1);
        color: var(--ok);
      }
      .faint {
        color: var(--text-3);
      }
      .parameters label {
        display: grid;
        grid-template-columns: minmax(84px, 1fr) minmax(50px, 84px) 62px 40px;
        gap: 8px;
        align-items: center;
        min-height: var(--h-row);
      }
      .parameters code {
        overflow: hidden;
        text-overflow: ellipsis;
        white-space: nowrap;
      }
      .parameters input[type='checkbox'],
      .parameters select,
      .parameters input[type='text'] {
        grid-column: 2 / 4;
        justify-self: start;
        max-width: 100%;
      }
      input[type='range'] {
        width: 100%;
        accent-color: var(--intent);
      }
      input[type='number'],
      input[type='text'],
      select {
        width: 100%;
        height: 22px;
        padding: 0 4px;
        font: inherit;
        color: var(--text-1);
        background: var(--bg-2);
        border: 1px solid var(--line-2);
        border-radius: var(--r-2);
      }
      .bad {
        margin: 0 0 4px;
        color: var(--danger);
      }
      .guard {
        display: flex;
        align-items: center;
        gap: 6px;
        margin: 0;
      }
      .guard svg {
        color: var(--warn);
      }
      dl {
        display: grid;
        grid-template-columns: 84px 1fr;
        gap: 4px 8px;
        margin: 0;
      }
      dt {
        color: var(--text-3);
        overflow: hidden;
        text-overflow: ellipsis;
      }
      dd {
        margin: 0;
      }
      .tag {
        padding: 0 5px;
        border-radius: var(--r-2);
        background: var(--virtual-fill);
        color: var(--virtual-ink);
        font-size: var(--fs-11);
      }
      h4 .asked::before,
      h4 .driven::before {
        content: '';
        display: inline-block;
        width: 16px;
        margin: 0 4px 3px 6px;
        border-top: 1.5px solid var(--text-1);
      }
      h4 .asked::before {
        border-top: 1.5px dashed var(--intent);
      }
      .trace {
        display: grid;
        grid-template-columns: 62px 1fr;
        gap: 6px;
        margin-bottom: 4px;
      }
      .trace span {
        color: var(--text-3);
        font-size: var(--fs-11);
        line-height: 15px;
        text-align: right;
      }
      .plot {
        display: block;
        width: 100%;
        height: 44px;
      }
      .plot line {
        stroke: var(--line-2);
      }
      .plot polyline {
        fill: none;
        stroke: var(--text-1);
        stroke-width: 1.5;
        vector-effect: non-scaling-stroke;
      }
      .plot polyline.asked {
        stroke: var(--intent);
        stroke-dasharray: 4 3;
      }
      .now {
        margin: 2px 0 0;
        color: var(--text-2);
      }
      .now b {
        color: var(--text-1);
      }
      .empty {
        display: grid;
        place-content: center;
        justify-items: center;
        gap: 4px;
        height: 100%;
        color: var(--text-3);
      }
    `,
  ];
}

/** Two digits, without the sign of a zero. */
function signed(value: number): string {
  return (Math.abs(value) < 0.005 ? 0 : value).toFixed(2).replace('-', '−');
}

customElements.define('rave-robot', RobotPanel);
