// SPDX-License-Identifier: Apache-2.0
import {css, html, nothing, type TemplateResult} from 'lit';
import {controls} from '../../ui/styles';
import {kHistory_s} from '../../model/pose_history';
import type {Signal} from '../../model/signal';
import type {Reading} from '../../protocol/frames';
import type {Sensor} from '../../protocol/messages';
import {LookingPanel} from '../looking_panel';
import {isCurrent, strengthOf} from '../reading_age';
import {sparkline} from '../robots/sparkline';
import {Surface} from '../world/surface';
import {drawPolar} from './polar_plot';
import {ageText, metBy, nearestText} from './reading_texts';

const kRefresh_ms = 250;
const kSparkline_px = 84;

/** The selected robot in a few lines: what its range sensor sees, the nearest of it, and its
 * speed. */
export class Glance extends LookingPanel {
  protected readonly refresh_ms = kRefresh_ms;
  private surface: Surface | null = null;

  protected override signals(): Signal[] {
    return [this.context.model.sceneChanged];
  }

  /** The first range sensor of the selected robot. */
  private get shown(): {
    slot: number;
    index: number;
    sensor: Sensor;
    reading: Reading | null;
  } | null {
    const {model, selection} = this.context;
    const slot = selection.primary;
    const robot = slot === null ? undefined : model.robots[slot];
    if (slot === null || robot === undefined) return null;
    const index = robot.sensors.findIndex(({kind}) => kind === 'ranges');
    return index < 0
      ? null
      : {slot, index, sensor: robot.sensors[index], reading: model.readings.of(slot, index)};
  }

  protected lookAround(): void {
    const {model, palette, link} = this.context;
    const {shown} = this;
    this.surface =
      shown === null ? null : new Surface(model.bodies.values(), model.robots, palette);
    link.look(this, shown === null ? [] : [[shown.slot, shown.index]]);
  }

  protected lookAway(): void {
    this.context.link.look(this, []);
  }

  override render(): TemplateResult | typeof nothing {
    const {model, selection, palette} = this.context;
    const slot = selection.primary;
    if (slot === null || model.robots[slot] === undefined) return nothing;
    const speed = Math.abs(model.poses.newest?.speed[slot] ?? 0).toFixed(2);
    return html`${this.renderRanges()}
      <dl class="speeds">
        <div>
          <dt>Speed</dt>
          <dd><b>${speed}</b> m/s</dd>
        </div>
        <div>
          <dt>${kHistory_s} s</dt>
          <dd>${sparkline(model.poses, slot, palette.hue(slot).ink, kSparkline_px)}</dd>
        </div>
      </dl>`;
  }

  private renderRanges(): TemplateResult | typeof nothing {
    const {model, palette} = this.context;
    const {shown} = this;
    if (shown === null) return nothing;
    const {slot, sensor, reading} = shown;
    const age_s = reading === null ? 0 : (model.poses.newest?.time_s ?? 0) - reading.stamp_s;
    return html`<canvas
        class="polar"
        role="img"
        aria-label="Ranges around ${model.robots[slot].name}"></canvas>
      <dl class="nearest">
        <dt>
          Nearest ${isCurrent(age_s, sensor.period_s) ? nothing : html`<em>${ageText(age_s)}</em>`}
        </dt>
        <dd>
          ${nearestText(
            sensor,
            reading,
            (ray) =>
              reading === null
                ? null
                : metBy(this.surface, this.placed, slot, sensor, reading, ray),
            palette,
          )}
        </dd>
      </dl>`;
  }

  protected paint(): void {
    const {model, palette} = this.context;
    const {shown} = this;
    if (shown === null) return;
    const {slot, sensor, reading} = shown;
    model.poses.interpolate(performance.now(), this.placed);
    if (this.surface !== null) this.surface.placed = this.placed;
    this.onCanvas('.polar', (ctx, width, height) => {
      drawPolar(
        ctx,
        width,
        height,
        sensor,
        reading,
        palette.hue(slot),
        palette,
        (ray) =>
          reading === null ? null : metBy(this.surface, this.placed, slot, sensor, reading, ray),
        {
          small: true,
          strength:
            reading === null
              ? 1
              : strengthOf(this.placed.time_s - reading.stamp_s, sensor.period_s),
        },
      );
    });
  }

  static override styles = [
    controls,
    css`
      :host {
        display: grid;
        grid-template-columns: 150px minmax(0, 1fr);
        grid-template-rows: 1fr 1fr;
        column-gap: 12px;
        padding: 2px 14px 10px;
      }
      .polar {
        grid-row: 1 / 3;
        width: 150px;
        height: 112px;
      }
      dl {
        margin: 0;
        align-self: center;
        font-size: 12.5px;
        color: var(--text-2);
      }
      dl:only-child {
        grid-column: 1 / 3;
        grid-row: 1 / 3;
      }
      dt {
        line-height: 1.4;
      }
      dt em {
        font-style: normal;
        color: var(--stale-ink);
      }
      dd {
        margin: 0;
        color: var(--text-1);
        white-space: nowrap;
        overflow: hidden;
        text-overflow: ellipsis;
      }
      .nearest b {
        margin-right: 4px;
        font-size: 17px;
        font-weight: var(--fw-strong);
      }
      .speeds {
        display: flex;
        gap: 26px;
      }
      .speeds dd {
        display: flex;
        align-items: center;
        gap: 4px;
        height: 20px;
        color: var(--text-2);
      }
      .speeds b {
        color: var(--text-1);
        font-size: var(--fs-15);
        font-weight: var(--fw-strong);
      }
    `,
  ];
}

customElements.define('rave-glance', Glance);
