// SPDX-License-Identifier: Apache-2.0
import {css, html, nothing, type TemplateResult} from 'lit';
import {icon} from '../../ui/icons';
import {controls, glyphs} from '../../ui/styles';
import type {Signal} from '../../model/signal';
import type {Reading} from '../../protocol/frames';
import type {ProbeMade, Sensor, VirtualSensor} from '../../protocol/messages';
import {LookingPanel} from '../looking_panel';
import {renderParameter} from '../parameter_control';
import {drawPolar} from '../sensors/polar_plot';
import {aboutText, metBy, nearestText, readingStyles, renderValues} from '../sensors/reading_texts';
import {renderWithheld, withheldStyles} from '../withheld';
import {Surface} from '../world/surface';
import {ProbeDraft, kMount, type MountKey} from './probe_draft';

const kTextRefresh_ms = 200;
/** After so long without a reading something is wrong. */
const kPatience_ms = 3000;
const kCopied_ms = 2000;

/** Tries a virtual sensor on a robot: its form is made from the description of its driver. No part
 * of the run. */
export class ProbePanel extends LookingPanel {
  protected readonly refresh_ms = kTextRefresh_ms;
  private readonly draft = new ProbeDraft();
  /** Whatever is selected; null: the selected robot. */
  private kept: number | null = null;
  private surface: Surface | null = null;
  private askedAt_ms = 0;
  private copiedAt_ms = -Infinity;

  protected override signals(): Signal[] {
    const {model} = this.context;
    return [model.sceneChanged, model.probes.changed];
  }

  protected override rosterChanged(): void {
    this.kept = null;
  }

  override connectedCallback(): void {
    super.connectedCallback();
    this.context.link.wantsCatalogue = true;
    this.context.link.askCatalogue();
  }

  protected lookAway(): void {
    this.context.link.tryProbe(this, null);
  }

  /** The selected robot, and it stays if nothing is selected then. */
  private get shownSlot(): number | null {
    const {model, selection} = this.context;
    const {primary} = selection;
    if (primary !== null && model.robots[primary] !== undefined) this.kept = primary;
    return this.kept !== null && model.robots[this.kept] !== undefined ? this.kept : null;
  }

  private get driver(): VirtualSensor | null {
    const drivers = this.context.model.probes.drivers ?? [];
    return (
      drivers.find(({name}) => name === this.draft.driver) ??
      drivers.find(({name}) => name === 'virtual_laser') ??
      drivers[0] ??
      null
    );
  }

  protected lookAround(): void {
    const {model, palette, link} = this.context;
    this.surface = new Surface(model.bodies.values(), model.robots, palette);
    const {driver, shownSlot: slot} = this;
    if (driver === null || slot === null || !model.may('probe')) return link.tryProbe(this, null);
    const request = this.draft.request(slot, model.robots[slot], driver);
    if (model.probes.of(this) === null) this.askedAt_ms ||= performance.now();
    else this.askedAt_ms = 0;
    link.tryProbe(this, request);
  }

  private set(change: () => void): void {
    change();
    this.askedAt_ms = performance.now();
    this.changed();
  }

  private async copy(block: string): Promise<void> {
    await navigator.clipboard?.writeText(block);
    this.copiedAt_ms = performance.now();
    this.requestUpdate();
  }

  override render(): TemplateResult {
    const {model, palette} = this.context;
    if (!model.may('probe')) return renderWithheld(this.context, 'probe');
    const {driver, shownSlot: slot} = this;
    if (slot === null)
      return html`<p class="none">
        Select a robot, real or simulated, to try a virtual sensor on it.
      </p>`;
    if (driver === null)
      return html`<p class="none">
        ${model.probes.drivers === null
          ? 'Loading the list of virtual sensors.'
          : 'There are no virtual sensors here.'}
      </p>`;
    const robot = model.robots[slot];
    const hue = palette.hue(slot);
    const made = model.probes.of(this);
    return html`<div class="form">
        <header>
          <i
            class="glyph ${robot.kind}"
            style="--hue:${robot.kind === 'real' ? hue.fill : hue.ink}"></i
          ><b style="color:${hue.ink}">${robot.name}</b><span class="tag">no part of the run</span>
        </header>
        <label class="driver"
          ><select
            aria-label="Virtual sensor"
            @change=${(event: Event) =>
              this.set(() => this.draft.choose((event.target as HTMLSelectElement).value))}>
            ${(model.probes.drivers ?? []).map(
              ({name}) => html`<option ?selected=${name === driver.name}>${name}</option>`,
            )}</select
          >${icon('chevronDown', 14)}</label
        >
        <p class="summary">${driver.summary}</p>
        <div class="fields">
          ${kMount.map((field) => this.renderMount(field))}${driver.parameters.map((parameter) =>
            renderParameter(parameter, parameter.key, {
              value: this.draft.valueOf(driver, parameter),
              following: true,
              set: (to) => this.set(() => this.draft.set(driver, parameter, to)),
            }),
          )}
        </div>
        ${made?.error === undefined ? nothing : html`<p class="bad" role="alert">${made.error}</p>`}
        <button
          class="copy"
          ?disabled=${made?.block === undefined}
          @click=${() => void this.copy(made?.block ?? '')}>
          ${icon(this.copied ? 'check' : 'copy', 14)}
          ${this.copied ? 'Copied' : 'Copy for the robot file'}
        </button>
      </div>
      ${this.renderReading(slot, made)}`;
  }

  private get copied(): boolean {
    return performance.now() - this.copiedAt_ms < kCopied_ms;
  }

  private renderMount({key, unit, most, doc}: (typeof kMount)[number]): TemplateResult {
    const value = this.draft.mount[key];
    const set = (event: Event) => {
      const number = Number((event.target as HTMLInputElement).value);
      if (Number.isFinite(number))
        this.set(
          () =>
            (this.draft.mount[key as MountKey] = Math.max(
              -100 * most,
              Math.min(100 * most, number),
            )),
        );
    };
    return html`<label title=${doc}
      ><code>${key}</code>
      <input
        type="range"
        aria-label=${key}
        min=${-most}
        max=${most}
        step=${most / 100}
        .value=${String(value)}
        @input=${set} />
      <input
        type="number"
        aria-label="${key}, value"
        step="any"
        .value=${String(value)}
        @change=${set} /><em>${unit}</em></label
    >`;
  }

  private renderReading(slot: number, made: ProbeMade | null): TemplateResult {
    const {model, palette} = this.context;
    const sensor = made?.sensor;
    if (sensor === undefined)
      return html`<div class="view">
        <p class="none">
          ${made?.error === undefined
            ? 'The sensor is being made.'
            : 'This description gives no sensor.'}
        </p>
      </div>`;
    const reading = this.reading(slot);
    const late =
      reading === null &&
      this.askedAt_ms !== 0 &&
      performance.now() - this.askedAt_ms > kPatience_ms;
    const met = (ray: number) =>
      reading === null ? null : metBy(this.surface, this.placed, slot, sensor, reading, ray);
    return html`<div class="view">
      <p class="about">${aboutText(sensor, reading, model.poses.newest?.time_s ?? 0)}</p>
      ${late
        ? html`<p class="none">
            No reading yet: a host makes at most 16 probes, and none while the run does not advance.
          </p>`
        : nothing}
      ${sensor.kind === 'ranges'
        ? html`<canvas
              class="polar"
              role="img"
              aria-label="Readings of the probe; ahead is up"></canvas>
            <p class="sentence">${nearestText(sensor, reading, met, palette)}</p>`
        : renderValues(sensor, reading)}
    </div>`;
  }

  private reading(slot: number): Reading | null {
    const {model} = this.context;
    return model.readings.of(slot, model.probes.indexOf(this));
  }

  protected paint(): void {
    const {model, palette} = this.context;
    const slot = this.shownSlot;
    const sensor: Sensor | undefined = model.probes.of(this)?.sensor;
    if (slot === null || sensor === undefined) return;
    model.poses.interpolate(performance.now(), this.placed);
    if (this.surface !== null) this.surface.placed = this.placed;
    const reading = this.reading(slot);
    if (reading !== null) this.askedAt_ms = 0;
    const hue = {fill: palette.token('virtual'), ink: palette.token('virtual-ink')};
    this.onCanvas('.polar', (ctx, width, height) => {
      drawPolar(ctx, width, height, sensor, reading, hue, palette, (ray) =>
        reading === null ? null : metBy(this.surface, this.placed, slot, sensor, reading, ray),
      );
    });
  }

  static override styles = [
    controls,
    glyphs,
    readingStyles,
    withheldStyles,
    css`
      :host {
        display: flex;
        flex-wrap: wrap;
        height: 100%;
        overflow: auto;
        background: var(--bg-1);
        font-size: var(--fs-12);
        align-content: flex-start;
      }
      .form {
        flex: 1 1 230px;
        max-width: 420px;
        padding: 10px 12px;
        box-sizing: border-box;
      }
      .view {
        flex: 2 1 220px;
        display: flex;
        flex-direction: column;
        min-width: 0;
        min-height: 240px;
        align-self: stretch;
      }
      header {
        display: flex;
        align-items: center;
        gap: 8px;
        margin-bottom: 8px;
      }
      .tag {
        padding: 1px 8px;
        border-radius: var(--r-2);
        background: var(--virtual-fill);
        color: var(--virtual-ink);
        white-space: nowrap;
      }
      .driver {
        position: relative;
        display: flex;
        align-items: center;
      }
      .driver select {
        appearance: none;
        width: 100%;
        height: var(--h-control);
        padding: 0 26px 0 10px;
        border: 0;
        border-radius: var(--r-3);
        background: var(--bg-3);
        color: var(--text-1);
        font: 400 var(--fs-12) var(--font-code);
      }
      .driver svg {
        position: absolute;
        right: 8px;
        pointer-events: none;
      }
      .summary {
        margin: 6px 0 8px;
        color: var(--text-3);
      }
      .fields label {
        display: grid;
        grid-template-columns: minmax(84px, 1fr) minmax(50px, 84px) 62px 34px;
        gap: 8px;
        align-items: center;
        min-height: var(--h-row);
      }
      .fields input[type='checkbox'],
      .fields select,
      .fields input[type='text'] {
        grid-column: 2 / 4;
        justify-self: start;
        max-width: 100%;
        box-sizing: border-box;
      }
      code {
        overflow: hidden;
        text-overflow: ellipsis;
        white-space: nowrap;
        font: 400 var(--fs-11) var(--font-code);
        color: var(--text-2);
      }
      label em {
        font-style: normal;
        color: var(--text-3);
        font-size: var(--fs-11);
      }
      input[type='range'] {
        width: 100%;
        accent-color: var(--intent);
      }
      input[type='number'],
      input[type='text'],
      .fields select {
        width: 100%;
        height: 22px;
        padding: 0 4px;
        font: inherit;
        color: var(--text-1);
        background: var(--bg-2);
        border: 1px solid var(--line-2);
        border-radius: var(--r-2);
      }
      .copy {
        display: flex;
        align-items: center;
        justify-content: center;
        gap: 8px;
        width: 100%;
        height: var(--h-control);
        margin-top: 10px;
        border: 1px solid var(--line-2);
        border-radius: var(--r-3);
        background: var(--bg-2);
        color: var(--text-1);
        font-size: var(--fs-12);
      }
      .copy:disabled {
        opacity: 0.5;
      }
      .about {
        margin: 12px 14px 0;
        color: var(--text-2);
      }
      .polar {
        flex: 1 1 200px;
        min-height: 180px;
        width: 100%;
      }
      .sentence {
        padding-bottom: 12px;
      }
      .bad {
        margin: 6px 0 0;
        color: var(--danger);
      }
    `,
  ];
}

customElements.define('rave-probe', ProbePanel);
