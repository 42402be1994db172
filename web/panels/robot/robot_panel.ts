// SPDX-License-Identifier: Apache-2.0
import {html, nothing, svg, type TemplateResult} from 'lit';
import {icon} from '../../ui/icons';
import {LiveElement} from '../../ui/live_element';
import {controls, glyphs} from '../../ui/styles';
import type {KnownRobot} from '../../model/run_model';
import {RobotFlag, kCommandsOf} from '../../protocol/frames';
import type {Parameter} from '../../protocol/messages';
import '../lease_bar';
import {renderParameter} from '../parameter_control';
import {guardOf, lastAct} from './guard_act';
import './twin_section';
import {toldLines} from './told';
import {SetValues, type SetValue} from './set_values';
import {SpeedTrace, askedLines, kTrace_s, type DrivenVelocity} from './speed_trace';
import {robotStyles} from './robot_styles';

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
    const {model, selection, palette} = this.context;
    const slot = selection.primary;
    const robot = slot === null ? undefined : model.robots[slot];
    if (slot === null || robot === undefined)
      return html`<div class="empty">
        ${icon('bot', 28)}
        <p>Select a robot to see it in detail.</p>
      </div>`;
    const hue = palette.hue(slot);
    const drive = model.drives.get(slot);
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
        ${this.renderHalt(slot, robot)} ${this.renderTakes(slot, drive?.takes ?? [])}
        <rave-twin .context=${this.context} .robot=${slot}></rave-twin>
        ${this.renderParameters(slot, robot.program, robot.parameters ?? [])}
        ${this.renderGuard(slot)} ${this.renderDrivers(robot)} ${this.renderSpeed(slot)}
      </div>`;
  }

  /** Stops or releases it, and cancels its order. */
  private renderHalt(slot: number, robot: KnownRobot): TemplateResult | typeof nothing {
    const {model, link} = this.context;
    if (!model.stops(slot) || robot.recorded) return nothing;
    const stopped = ((model.poses.newest?.flags[slot] ?? 0) & RobotFlag.stopped) !== 0;
    const order = model.drives.get(slot)?.order;
    const halt = (what: 'stop' | 'release') => link.send({type: 'halt', do: what, slots: [slot]});
    return html`<div class="halt">
      ${stopped && model.may('release')
        ? html`<button class="release" @click=${() => halt('release')}>
            ${icon('play', 14)} Release ${robot.name}
          </button>`
        : html`<button class="stop" ?disabled=${stopped} @click=${() => halt('stop')}>
            ${icon('octagonX', 16)} ${stopped ? 'Stopped' : `Stop ${robot.name}`}
          </button>`}
      ${order
        ? html`<span class="order">${order}</span
            ><button class="plain" @click=${() => void this.context.commands.cancel([slot])}>
              Cancel
            </button>`
        : nothing}
    </div>`;
  }

  /** Which drivers serve it, and where. */
  private renderDrivers(robot: KnownRobot): TemplateResult | typeof nothing {
    return robot.sensors.length + robot.drivers.length === 0
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
          </dl>`;
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
    const note = this.notes.get(name);
    const control = renderParameter(parameter, parameter.key.replace(/^program\./, ''), {
      value,
      disabled: !may || parameter.kind === 'numbers',
      set: (to) => {
        if (!Array.isArray(to)) set(to);
      },
    });
    return html`${control}
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

  static override styles = [controls, glyphs, robotStyles];
}

/** Two digits, without the sign of a zero. */
function signed(value: number): string {
  return (Math.abs(value) < 0.005 ? 0 : value).toFixed(2).replace('-', '−');
}

customElements.define('rave-robot', RobotPanel);
