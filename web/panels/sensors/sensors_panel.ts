// SPDX-License-Identifier: Apache-2.0
import {html, nothing, type TemplateResult} from 'lit';
import {icon} from '../../ui/icons';
import {spanOf} from '../../model/moment';
import {controls, glyphs} from '../../ui/styles';
import type {Interest} from '../../model/link';
import type {Signal} from '../../model/signal';
import {rightText} from '../../model/withheld';
import type {Reading} from '../../protocol/frames';
import type {Robot, Sensor} from '../../protocol/messages';
import {LookingPanel} from '../looking_panel';
import {isCurrent, strengthOf} from '../reading_age';
import {renderNote, renderWithheld, withheldStyles} from '../withheld';
import {Surface, type Met} from '../world/surface';
import {renderBeam} from './beam_choice';
import {courseFieldsOf, pointedText, type CourseField} from './course_fields';
import {gapsText} from './course_gaps';
import {CoursePlot, type CourseLine} from './course_plot';
import {courseStyles} from './course_styles';
import {drawPolar} from './polar_plot';
import {
  aboutText,
  metBy,
  nearestText,
  readingStyles,
  renderTable,
  renderValues,
} from './reading_texts';
import {drawSightingsPlot, namedBy, pairsOf} from './sightings_plot';
import {twinOf} from './twin';
import {sensorsStyles} from './sensors_styles';

const kTextRefresh_ms = 200;
const kAsTable = 'the button Show the numbers shows them as a table';

/** What the sensors of the selected robot read. */
export class SensorsPanel extends LookingPanel {
  protected readonly refresh_ms = kTextRefresh_ms;
  private chosen = new Map<number, number>();
  private pinned: number | null = null;
  private asTable = false;
  private field = 0;
  /** The beam of a range sensor whose course is drawn; null: the middle one. */
  private beam: number | null = null;
  private surface: Surface | null = null;
  private readonly course = new CoursePlot(() => this.requestUpdate());

  protected override signals(): Signal[] {
    return [this.context.model.sceneChanged];
  }

  protected override rosterChanged(): void {
    this.pinned = null;
    this.chosen.clear();
  }

  protected lookAway(): void {
    this.context.link.courses = [];
    this.context.link.look(this, []);
    this.course.dispose();
  }

  /** Pinned, else selected, else the first robot that has a sensor. */
  private get shownSlot(): number | null {
    const {model, selection} = this.context;
    const slot = this.pinned ?? selection.primary;
    if (slot !== null && model.robots[slot]) return slot;
    const first = model.robots.findIndex((robot) => robot.sensors.length > 0);
    return first < 0 ? null : first;
  }

  private sensorIndex(slot: number, robot: Robot): number {
    const chosen = this.chosen.get(slot);
    if (chosen !== undefined && chosen < robot.sensors.length) return chosen;
    const ranges = robot.sensors.findIndex((sensor) => sensor.kind === 'ranges');
    return ranges < 0 ? 0 : ranges;
  }

  protected lookAround(): void {
    const {model, palette} = this.context;
    this.surface = new Surface(model.bodies.values(), model.robots, palette);
    const slot = this.shownSlot;
    const robot = slot === null ? undefined : this.context.model.robots[slot];
    const {link} = this.context;
    if (slot === null || robot === undefined || robot.sensors.length === 0) {
      link.look(this, []);
      return;
    }
    const index = this.sensorIndex(slot, robot);
    const twin = twinOf(robot, index);
    // Halves are asked for where they are shown: they triple the readings.
    link.parts = robot.sensors[index].origin === 'hybrid';
    const looked: Interest =
      twin === null
        ? [[slot, index]]
        : [
            [slot, index],
            [slot, twin],
          ];
    link.courses = model.live ? [] : looked;
    link.look(this, looked);
  }

  override render(): TemplateResult {
    const {model, palette} = this.context;
    const slot = this.shownSlot;
    const robot = slot === null ? undefined : model.robots[slot];
    if (!model.may('readings')) return renderWithheld(this.context, 'readings');
    if (slot === null || robot === undefined) return this.renderNone('No robot of this run');
    if (robot.sensors.length === 0) return this.renderNone(robot.name);
    const index = this.sensorIndex(slot, robot);
    const sensor = robot.sensors[index];
    const reading = model.readings.of(slot, index);
    const hue = palette.hue(slot);
    return html` <div class="head">
        <i
          class="glyph ${robot.kind}"
          style="--hue:${robot.kind === 'real' ? hue.fill : hue.ink}"></i>
        <b style="color:${hue.ink}">${robot.name}</b>
        <button
          class="icon-button"
          title="Keep showing this robot when the selection changes"
          aria-label="Keep this robot"
          aria-pressed=${this.pinned !== null}
          @click=${() => {
            this.pinned = this.pinned === null ? slot : null;
            this.requestUpdate();
          }}>
          ${icon('pin', 14)}
        </button>
        <span class="space"></span>
        <div class="segments" role="radiogroup" aria-label="Sensor">
          ${robot.sensors.map(
            (other, i) =>
              html`<button
                role="radio"
                aria-checked=${i === index}
                @click=${() => this.choose(slot, i)}>
                ${other.name}
              </button>`,
          )}
        </div>
      </div>
      ${this.renderAbout(sensor, reading)}
      ${this.asTable ? renderTable(sensor, reading) : this.renderPlots(slot, sensor, reading)}`;
  }

  /** What the sensor is, and how old its reading. */
  private renderAbout(sensor: Sensor, reading: Reading | null): TemplateResult {
    const now_s = this.context.model.poses.newest?.time_s ?? 0;
    return html`<div class="about">
      ${sensor.origin === 'real'
        ? nothing
        : html`<span class="tag"
            ><i class="glyph virtual"></i>${sensor.origin === 'virtual'
              ? 'virtual sensor'
              : 'hybrid sensor'}</span
          >`}
      <span class="space"></span
      ><span
        class=${reading === null || isCurrent(now_s - reading.stamp_s, sensor.period_s)
          ? ''
          : 'old'}
        >${aboutText(sensor, reading, now_s)}</span
      >
      <button
        class="icon-button"
        title="Show the numbers"
        aria-label="Show the numbers"
        aria-pressed=${this.asTable}
        @click=${() => {
          this.asTable = !this.asTable;
          this.requestUpdate();
        }}>
        ${icon('list', 14)}
      </button>
    </div>`;
  }

  /** Robots whose readings are withheld have no sensors at all. */
  private renderNone(whose: string): TemplateResult {
    const {model} = this.context;
    const many = whose.startsWith('No ');
    if (!model.seesLess)
      return html`<p class="none">${whose} ${many ? 'has a sensor' : 'has no sensors'}.</p>`;
    return renderNote(
      this.context,
      `${whose} has ${many ? 'a sensor' : 'no sensors'} that you may see. ` +
        rightText('readings', model.others),
    );
  }

  private choose(slot: number, index: number): void {
    this.chosen.set(slot, index);
    this.field = 0;
    this.beam = null;
    this.lookAround();
    this.requestUpdate();
  }

  private renderPlots(slot: number, sensor: Sensor, reading: Reading | null): TemplateResult {
    const ranges = sensor.kind === 'ranges';
    if (sensor.kind === 'sightings') return this.renderSightings(slot, sensor, reading);
    return html` ${sensor.origin === 'hybrid' && this.context.model.isWithheld('hybrid_parts')
      ? renderWithheld(this.context, 'hybrid_parts')
      : nothing}
    ${sensor.origin === 'hybrid'
      ? html`<p class="halves">
          ${this.context.model.may('hybrid_parts')
            ? html`<span><i class="line"></i>real half</span>`
            : nothing}<span><i class="dot"></i>result from it</span
          ><span><i class="square"></i>result from the virtual half</span>
        </p>`
      : nothing}
    ${ranges
      ? html`<canvas
          class="polar"
          role="img"
          aria-label="Ranges around the robot; ${kAsTable}"></canvas>`
      : renderValues(sensor, reading)}
    ${ranges ? html`<p class="sentence">${this.nearest(slot, sensor, reading)}</p>` : nothing}
    ${this.renderCourse(sensor)}`;
  }

  /** Which field is drawn over time, and the plot. */
  private renderCourse(sensor: Sensor): TemplateResult | typeof nothing {
    const fields = courseFieldsOf(sensor, this.beamOf(sensor));
    const field = fields[Math.min(this.field, fields.length - 1)];
    if (field === undefined) return nothing;
    const {pointed, gaps} = this.course;
    const choose = (i: number) => {
      this.field = i;
      this.requestUpdate();
    };
    return html` <div class="fields">
        ${fields.length > 1
          ? html`<div class="segments" role="radiogroup" aria-label="Field over time">
              ${fields.map(
                (other, i) =>
                  html`<button
                    role="radio"
                    aria-checked=${other === field}
                    @click=${() => choose(i)}>
                    ${other.label}
                  </button>`,
              )}
            </div>`
          : html`<span>${field.label}</span>`}
        ${field.label === 'beam'
          ? renderBeam(sensor, this.beamOf(sensor), (beam) => {
              this.beam = beam;
              this.requestUpdate();
            })
          : nothing}
        <em>${pointed === null ? '15 s' : pointedText(pointed, field)}</em>
      </div>
      <div
        class="course"
        role="img"
        aria-label="${field.label} of ${sensor.name} in the last 15 seconds${gaps.length === 0
          ? ''
          : `; no readings ${gapsText(gaps)}`}"
        title=${gaps.length > 0 && this.context.model.live
          ? 'A sensor is read while a panel shows it'
          : nothing}></div>`;
  }

  private beamOf(sensor: Sensor): number {
    const last = (sensor.bearings?.length ?? 1) - 1;
    return Math.min(this.beam ?? Math.floor(last / 2), last);
  }

  /** A camera beside its twin: what it saw, and what it should see. */
  private renderSightings(slot: number, sensor: Sensor, reading: Reading | null): TemplateResult {
    const robot = this.context.model.robots[slot];
    const twin = twinOf(robot, robot.sensors.indexOf(sensor));
    const expected = twin === null ? null : this.context.model.readings.of(slot, twin);
    const count = pairsOf(sensor, reading, expected);
    const saw = `${sensor.origin === 'virtual' ? 'saw' : 'expects'} ${expected?.rows ?? 0}`;
    return html` <p class="halves">
        <span><i class="dot saw"></i>saw ${reading?.rows ?? 0}</span> ${twin === null
          ? nothing
          : html`<span><i class="square"></i>${robot.sensors[twin].name} ${saw}</span>
              <span class="space"></span><em>${count} of ${expected?.rows ?? 0} in both</em>`}
      </p>
      <canvas
        class="sightings"
        role="img"
        aria-label="Ranges and bearings of the sightings of the camera; ${kAsTable}"></canvas>
      ${this.renderCourse(sensor)}`;
  }

  private met(slot: number, sensor: Sensor, reading: Reading, ray: number): Met | null {
    return metBy(this.surface, this.placed, slot, sensor, reading, ray);
  }

  private nearest(slot: number, sensor: Sensor, reading: Reading | null): TemplateResult | string {
    return nearestText(
      sensor,
      reading,
      (ray) => (reading === null ? null : this.met(slot, sensor, reading, ray)),
      this.context.palette,
    );
  }

  protected paint(): void {
    const {model, palette} = this.context;
    const slot = this.shownSlot;
    const robot = slot === null ? undefined : model.robots[slot];
    if (slot === null || robot === undefined || robot.sensors.length === 0) return;
    const index = this.sensorIndex(slot, robot);
    const sensor = robot.sensors[index];
    const reading = model.readings.of(slot, index);
    model.poses.interpolate(performance.now(), this.placed);
    // What a ray met depends on where robots are now.
    if (this.surface !== null) this.surface.placed = this.placed;
    const hue = palette.hue(slot);
    const halves = sensor.origin === 'hybrid' ? model.readings.of(slot, index, 1) : null;
    this.onCanvas('.polar', (ctx, width, height) => {
      drawPolar(
        ctx,
        width,
        height,
        sensor,
        reading,
        hue,
        palette,
        (ray) => (reading === null ? null : this.met(slot, sensor, reading, ray)),
        {
          real: halves,
          beam: this.field === 1 ? this.beamOf(sensor) : null,
          strength:
            reading === null
              ? 1
              : strengthOf(this.placed.time_s - reading.stamp_s, sensor.period_s),
        },
      );
    });
    this.onCanvas('.sightings', (ctx, width, height) => {
      const twin = twinOf(robot, index);
      drawSightingsPlot(
        ctx,
        width,
        height,
        sensor,
        reading,
        twin === null ? null : model.readings.of(slot, twin),
        (code) => namedBy(this.context, code),
        palette,
        this.placed.time_s,
      );
    });
    this.paintCourse(slot, index, sensor, hue.ink);
  }

  private paintCourse(slot: number, index: number, sensor: Sensor, ink: string): void {
    const host = this.renderRoot.querySelector<HTMLElement>('.course');
    const fields: readonly CourseField[] = courseFieldsOf(sensor, this.beamOf(sensor));
    const field = fields[Math.min(this.field, fields.length - 1)];
    if (host === null || field === undefined) return;
    const {model, palette} = this.context;
    const lines: CourseLine[] = [
      {points: model.readings.course(slot, index), colour: ink, dots: sensor.kind === 'sightings'},
    ];
    const twin = twinOf(model.robots[slot], index);
    if (twin !== null)
      lines.push({
        points: model.readings.course(slot, twin),
        colour: palette.token('virtual-ink'),
        dashed: true,
      });
    this.course.draw(
      host,
      lines,
      field,
      {now_s: this.placed.time_s, begin_s: spanOf(model)[0], period_s: sensor.period_s},
      palette,
    );
  }

  static override styles = [
    controls,
    glyphs,
    readingStyles,
    courseStyles,
    withheldStyles,
    sensorsStyles,
  ];
}

customElements.define('rave-sensors', SensorsPanel);
