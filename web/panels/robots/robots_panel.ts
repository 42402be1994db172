// SPDX-License-Identifier: Apache-2.0
import {html, nothing, svg, type TemplateResult} from 'lit';
import {icon} from '../../ui/icons';
import {LiveElement} from '../../ui/live_element';
import {controls, glyphs} from '../../ui/styles';
import {initials} from '../../ui/words';
import {kHistory_s} from '../../model/pose_history';
import {rightText} from '../../model/withheld';
import {RobotFlag} from '../../protocol/frames';
import {renderNote, withheldStyles} from '../withheld';
import {parseFilter, type Filter} from './filter';
import {stateOf, stoppable} from './robot_state';
import {sparkline} from './sparkline';
import {robotsStyles} from './robots_styles';

/** Beyond this number of robots a team is a histogram, and its rows come on demand. */
const kMany = 200;
const kRefresh_ms = 250;
const kRows = 400;
const kBins = 12;
/** Robots of one message, which has 64 KiB at most. */
const kMostStopped = 5000;
const kStands_mps = 0.02;

/** All robots by team: what they are, how fast they go, and what is not normal about them. */
export class RobotsPanel extends LiveElement {
  private filterText = '';
  private filter: Filter = parseFilter('');
  private readonly closed = new Set<string>();
  private readonly opened = new Set<string>();

  protected override listen(): (() => void)[] {
    const {model, selection, palette} = this.context;
    // Speeds change with each frame; a list that changed 60 times a second could not be read.
    return [
      ...this.renderAfter(model.rosterChanged, selection.changed, palette.changed),
      this.every(kRefresh_ms, () => this.requestUpdate()),
    ];
  }

  private speed(slot: number): number {
    return this.context.model.poses.newest?.speed[slot] ?? 0;
  }

  private flags(slot: number): number {
    return this.context.model.poses.newest?.flags[slot] ?? 0;
  }

  private shownSlots(): number[] {
    const {robots} = this.context.model;
    const slots: number[] = [];
    robots.forEach((robot, slot) => {
      if (this.filter({robot, speed: this.speed(slot), flags: this.flags(slot)})) slots.push(slot);
    });
    return slots;
  }

  override render(): TemplateResult {
    const {robots} = this.context.model;
    const real = robots.filter((robot) => robot.kind === 'real').length;
    const teams = new Map<string, number[]>();
    for (const slot of this.shownSlots()) {
      const team = robots[slot].team;
      const members = teams.get(team);
      if (members === undefined) teams.set(team, [slot]);
      else members.push(slot);
    }
    if (!this.context.model.rosterCame)
      return html`<p class="none" role="status">Loading the robots ...</p>`;
    return html` <label class="field"
        >${icon('search', 14)}<input
          aria-label="Filter robots"
          placeholder=${robots.length > kMany
            ? 'Name, team, or speed < 0.02'
            : 'Filter by name, team, state'}
          .value=${this.filterText}
          @input=${(event: Event) => this.setFilter((event.target as HTMLInputElement).value)}
      /></label>
      <div class="kinds">
        <span class="chip"><i class="glyph real"></i>${real} real</span>
        <span class="chip"><i class="glyph simulated"></i>${robots.length - real} simulated</span>
        <span class="space"></span><em>last ${kHistory_s} s</em>
      </div>
      ${robots.length > kMany
        ? html`<div class="heads">
            <span>By team</span><span>speed 0 … ${this.topSpeed.toFixed(1)}</span><span>mean</span>
          </div>`
        : nothing}
      <div class="rows" role="group" aria-label="Robots">
        ${[...teams].map(([team, slots]) => this.renderTeam(team, slots, robots.length > kMany))}
        ${teams.size === 0 ? this.renderNone() : nothing}
      </div>
      ${this.renderDetail()}`;
  }

  private renderNone(): TemplateResult {
    const {model} = this.context;
    if (model.robots.length > 0) return html`<p class="none">No robot matches the filter.</p>`;
    if (!model.seesLess) return html`<p class="none">No robots in this run.</p>`;
    return renderNote(
      this.context,
      `There is no robot that you may see. ${rightText('pose', model.others)}`,
    );
  }

  private setFilter(text: string): void {
    this.filterText = text;
    this.filter = parseFilter(text);
    this.requestUpdate();
  }

  private renderTeam(team: string, slots: number[], many: boolean): TemplateResult {
    const open = many ? this.opened.has(team) : !this.closed.has(team);
    const toggle = () => {
      // Two sets, because teams are open by default if robots are few and closed if they are many.
      const set = many ? this.opened : this.closed;
      if (!set.delete(team)) set.add(team);
      this.requestUpdate();
    };
    return html`<div class="head ${many ? 'many' : ''}">
        <button class="team ${many ? 'many' : ''}" aria-expanded=${open} @click=${toggle}>
          <span class="turn ${open ? 'open' : ''}">${icon('chevronDown', 13)}</span>
          <span class="who"
            ><span>${team === '' ? 'no team' : team} <em>${slots.length}</em></span> ${many
              ? html`<small>${this.standText(slots)}</small>`
              : nothing}</span
          >
          ${many ? this.renderHistogram(slots) : nothing}</button
        >${this.renderStopTeam(team)}
      </div>
      ${open ? slots.slice(0, kRows).map((slot) => this.renderRow(slot)) : nothing}
      ${open && slots.length > kRows
        ? html`<p class="none">${slots.length - kRows} more: filter to see them.</p>`
        : nothing}`;
  }

  /** Stops all robots of the team in which one is selected, whether the filter shows them or
   * not. */
  private renderStopTeam(team: string): TemplateResult | typeof nothing {
    const {model, selection} = this.context;
    if (
      team === '' ||
      !model.live ||
      !model.may('stop') ||
      ![...selection.slots].some((slot) => model.robots[slot]?.team === team)
    )
      return nothing;
    const members = stoppable(model.robots, team);
    if (members.length === 0) return nothing;
    const stand = members.every((slot) => (this.flags(slot) & RobotFlag.stopped) !== 0);
    return html`<button
      class="halt"
      ?disabled=${stand}
      title="Stops ${members.length} robots of ${team} at once"
      @click=${() => this.stopTeam(members)}>
      ${icon('octagonX', 13)} ${stand ? 'Team stopped' : 'Stop team'}
    </button>`;
  }

  private stopTeam(members: readonly number[]): void {
    for (let i = 0; i < members.length; i += kMostStopped)
      this.context.link.send({type: 'halt', do: 'stop', slots: members.slice(i, i + kMostStopped)});
  }

  /** The same scale for all teams, so that they can be compared. */
  private get topSpeed(): number {
    let top = 0.4;
    for (const speed of this.context.model.poses.newest?.speed ?? [])
      top = Math.max(top, Math.abs(speed));
    return top;
  }

  private standText(slots: readonly number[]): string {
    const stand = slots.filter((slot) => Math.abs(this.speed(slot)) < kStands_mps).length;
    const stopped = slots.filter((slot) => (this.flags(slot) & RobotFlag.stopped) !== 0).length;
    return stopped > 0 ? `${stopped} stopped` : `${stand} stand`;
  }

  private renderHistogram(slots: number[]): TemplateResult {
    const speeds = slots.map((slot) => Math.abs(this.speed(slot)));
    const top = this.topSpeed;
    const bins = new Array<number>(kBins).fill(0);
    for (const speed of speeds) bins[Math.min(kBins - 1, Math.floor((speed / top) * kBins))] += 1;
    const most = Math.max(1, ...bins);
    const mean = speeds.reduce((sum, speed) => sum + speed, 0) / Math.max(1, speeds.length);
    return html`<span class="space"></span>
      <svg
        width="60"
        height="18"
        role="img"
        aria-label="Speeds from 0 to ${top.toFixed(1)} metres per second">
        ${bins
          .map((count) => (16 * count) / most)
          .map(
            (high, i) => svg`<rect x=${i * 5} y=${17 - high} width="3.5" height=${1 + high} />`,
          )}</svg
      ><span class="value">${mean.toFixed(2)} m/s</span>`;
  }

  private renderRow(slot: number): TemplateResult {
    const {selection, palette, model} = this.context;
    const robot = model.robots[slot];
    const hue = palette.hue(slot);
    const marked = robot.kind === 'real' || robot.word !== '';
    const state = stateOf(robot, this.flags(slot));
    return html`<div
      class="row ${selection.has(slot) ? 'selected' : ''} ${selection.hovered === slot
        ? 'hovered'
        : ''}"
      role="button"
      tabindex="0"
      aria-pressed=${selection.has(slot)}
      @click=${(event: MouseEvent) =>
        event.ctrlKey || event.metaKey ? selection.toggle(slot) : selection.set([slot])}
      @keydown=${(event: KeyboardEvent) => this.rowKey(event, slot)}
      @pointerenter=${() => selection.hover(slot)}
      @pointerleave=${() => selection.hover(null)}>
      <i
        class="glyph ${robot.kind}"
        style="--hue:${robot.kind === 'real' ? hue.fill : hue.ink}"></i>
      <span class="name" style=${marked ? `color:${hue.ink};font-weight:600` : ''}
        >${robot.name}</span
      >
      ${sparkline(model.poses, slot, marked ? hue.ink : palette.token('text-3'), 48)}
      ${state === ''
        ? html`<span class="value">${speedText(this.speed(slot))}</span>`
        : html`<span class="state">${state}</span>`}
      ${this.renderDriver(slot)}
      <span class="mark" title=${robot.recorded ? 'Recorded: it obeys no orders' : ''}
        >${robot.recorded
          ? icon('lock', 13)
          : (this.flags(slot) & RobotFlag.touching) !== 0
            ? icon('zap', 13)
            : nothing}</span
      >
    </div>`;
  }

  /** Initials of who drives it. */
  private renderDriver(slot: number): TemplateResult | typeof nothing {
    const {model} = this.context;
    const drive = model.drives.get(slot);
    if (drive === undefined || drive.lease === '') return nothing;
    const own = drive.lease === model.knownAs;
    const name = drive.yours || own ? (model.hello?.user.name ?? '') : drive.lease;
    const title = drive.yours
      ? 'You drive it'
      : own
        ? 'You drive it on another page'
        : `${name} drives it`;
    return html`<span class="driver ${drive.yours ? 'you' : ''}" title=${title}
      >${initials(name)}</span
    >`;
  }

  private rowKey(event: KeyboardEvent, slot: number): void {
    if (event.key === 'Enter' || event.key === ' ') {
      event.preventDefault();
      this.context.selection.set([slot]);
    } else if (event.key === 'ArrowDown' || event.key === 'ArrowUp') {
      event.preventDefault();
      const rows = [...this.renderRoot.querySelectorAll<HTMLElement>('.row')];
      rows[
        rows.indexOf(event.target as HTMLElement) + (event.key === 'ArrowDown' ? 1 : -1)
      ]?.focus();
    }
  }

  private renderDetail(): TemplateResult | typeof nothing {
    const {selection, model, palette} = this.context;
    const slot = selection.primary;
    const robot = slot === null ? undefined : model.robots[slot];
    const frame = model.poses.newest;
    if (slot === null || robot === undefined) return nothing;
    const known = frame !== null && (frame.flags[slot] & RobotFlag.known) !== 0;
    const degrees = known ? Math.round(((frame.yaw[slot] * 180) / Math.PI) % 360) : 0;
    const row = (name: string, value: string, faint = '') =>
      value === ''
        ? nothing
        : html`<dt>${name}</dt>
            <dd>${value} <em>${faint}</em></dd>`;
    return html`<section class="detail">
      <h3>
        <i
          class="glyph ${robot.kind}"
          style="--hue:${robot.kind === 'real'
            ? palette.hue(slot).fill
            : palette.hue(slot).ink}"></i>
        <span style="color:${palette.hue(slot).ink}">${robot.name}</span>
        <span class="chip">${robot.kind}${robot.recorded ? ', recorded' : ''}</span>
      </h3>
      <dl>
        ${row('Program', robot.program, robot.recorded ? '(ignores commands)' : '')}
        ${row(
          'Pose',
          known
            ? `${frame.x[slot].toFixed(2)}, ${frame.y[slot].toFixed(2)} m · ${degrees}°`.replaceAll(
                '-',
                '−',
              )
            : 'not known',
        )}
        ${row('Speed', known ? speedText(frame.speed[slot]) : '')}
        ${row('Sensors', robot.sensors.map((sensor) => sensor.name).join(', '))}
        ${row('Drivers', robot.drivers.join(', '))} ${row('Host', robot.host ?? '')}
      </dl>
    </section>`;
  }

  static override styles = [controls, glyphs, withheldStyles, robotsStyles];
}

/** Without the sign of a zero. */
function speedText(speed: number): string {
  return `${(Math.abs(speed) < 0.005 ? 0 : speed).toFixed(2).replace('-', '−')} m/s`;
}

customElements.define('rave-robots', RobotsPanel);
