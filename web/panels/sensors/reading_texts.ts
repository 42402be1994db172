// SPDX-License-Identifier: Apache-2.0
// A reading as words and numbers, for all panels that show one.
import {css, html, nothing, type TemplateResult} from 'lit';
import type {Placed} from '../../model/pose_history';
import type {Palette} from '../../panel_api';
import type {Reading} from '../../protocol/frames';
import type {Field, Sensor} from '../../protocol/messages';
import {bearingsOf, mountOf} from '../world/scan_layer';
import {pointSurface, type Met, type Surface} from '../world/surface';
import {nearestRay} from './nearest';

const kTableRows = 200;

/** What a ray met, as far as the page knows the world; null: nothing known. */
export function metBy(
  surface: Surface | null,
  placed: Placed,
  slot: number,
  sensor: Sensor,
  reading: Reading,
  ray: number,
): Met | null {
  if (surface === null || slot >= placed.count) return null;
  const mount = mountOf(placed, slot, sensor);
  const angle = mount.yaw + bearingsOf(sensor, reading.rows)[ray];
  const r = reading.values[ray];
  return pointSurface(surface, mount.x + r * Math.cos(angle), mount.y + r * Math.sin(angle), slot);
}

/** The nearest range as a sentence. */
export function nearestText(
  sensor: Sensor,
  reading: Reading | null,
  met: (ray: number) => Met | null,
  palette: Palette,
): TemplateResult | string {
  if (reading === null) return 'No reading yet.';
  const ray = nearestRay(sensor, reading);
  if (ray === null) return `Nothing within ${sensor.range?.[1] ?? 0} m.`;
  const degrees = Math.round((bearingsOf(sensor, reading.rows)[ray] * 180) / Math.PI);
  const side = degrees === 0 ? 'ahead' : `${Math.abs(degrees)}° ${degrees > 0 ? 'left' : 'right'}`;
  const what = met(ray);
  return html`<b>${reading.values[ray].toFixed(2)} m</b
    ><span
      >${what === null
        ? nothing
        : html`to
            <span style="color:${palette.token(what.token)}">${what.name}</span>, `}${side}</span
    >`;
}

export function renderValues(sensor: Sensor, reading: Reading | null): TemplateResult {
  if (reading === null || reading.rows === 0)
    return html`<p class="none">
      ${reading === null ? 'No reading yet.' : 'It sees nothing at present.'}
    </p>`;
  if (reading.rows > 1 || sensor.list) return renderTable(sensor, reading);
  return html`<dl>
    ${sensor.fields.map(
      (field, i) =>
        html`<div>
          <dt>${field.label}</dt>
          <dd>${numberText(field, reading.values[i])} <em>${field.unit}</em></dd>
        </div>`,
    )}
  </dl>`;
}

export function renderTable(sensor: Sensor, reading: Reading | null): TemplateResult {
  if (reading === null) return html`<p class="none">No reading yet.</p>`;
  const bearings = sensor.kind === 'ranges' ? bearingsOf(sensor, reading.rows) : null;
  const rows = Array.from({length: Math.min(reading.rows, kTableRows)}, (_, row) => row);
  return html`<div class="table" tabindex="0" role="region" aria-label="Numbers of ${sensor.name}">
    <table>
      <thead>
        <tr>
          ${bearings ? html`<th>bearing [°]</th>` : nothing}${sensor.fields.map(
            ({label, unit}) => html`<th>${unit === '' ? label : `${label} [${unit}]`}</th>`,
          )}
        </tr>
      </thead>
      <tbody>
        ${rows.map(
          (row) =>
            html`<tr>
              ${bearings
                ? html`<td>${((bearings[row] * 180) / Math.PI).toFixed(1).replace('-', '−')}</td>`
                : nothing}
              ${sensor.fields.map(
                (field, i) =>
                  html`<td>${numberText(field, reading.values[row * reading.fields + i])}</td>`,
              )}
            </tr>`,
        )}
      </tbody>
    </table>
  </div>`;
}

/** What a sensor is, and how old its reading. */
export function aboutText(sensor: Sensor, reading: Reading | null, now_s: number): string {
  const parts: string[] = [];
  const rays = sensor.bearings?.length ?? 0;
  if (rays > 1) {
    parts.push(`${rays} rays`);
    const bearings = sensor.bearings ?? [];
    const degrees = Math.round((Math.abs(bearings[rays - 1] - bearings[0]) * 180) / Math.PI);
    parts.push(`${degrees}°`);
  }
  if (sensor.period_s > 0) parts.push(`${Number((1 / sensor.period_s).toPrecision(3))} Hz`);
  if (reading !== null) parts.push(ageText(Math.max(0, now_s - reading.stamp_s)));
  return parts.join(' · ');
}

export function ageText(age_s: number): string {
  return age_s < 1 ? `age ${Math.round(age_s * 1000)} ms` : `age ${age_s.toFixed(1)} s`;
}

/** Measured numbers always have three digits, so that they stand still; others what they need. */
export function numberText({unit, format}: Field, value: number | undefined): string {
  if (value === undefined || Number.isNaN(value)) return '–';
  if (!Number.isFinite(value)) return value > 0 ? 'no return' : '−∞';
  const measured = format.startsWith('float') && unit !== '';
  const text = Number.isInteger(value) && !measured ? String(value) : value.toFixed(3);
  return text.replace('-', '−');
}

export const readingStyles = css`
  .sentence {
    display: flex;
    gap: 4px;
    margin: 0;
    padding: 0 12px;
    font-size: var(--fs-12);
    align-items: baseline;
  }
  .sentence b {
    font-size: var(--fs-15);
    font-weight: var(--fw-strong);
  }
  .sentence em {
    margin-left: auto;
    color: var(--text-3);
    font-style: normal;
    font-size: var(--fs-11);
  }
  dl {
    display: flex;
    flex-wrap: wrap;
    gap: 6px 24px;
    margin: 8px 14px;
  }
  dt {
    color: var(--text-3);
    font-size: var(--fs-11);
  }
  dd {
    margin: 0;
    font-size: var(--fs-15);
  }
  dd em {
    font-style: normal;
    color: var(--text-3);
    font-size: var(--fs-12);
  }
  .table {
    flex: 1;
    min-height: 60px;
    overflow: auto;
    margin: 6px 0;
  }
  table {
    border-collapse: collapse;
    width: 100%;
    font-size: var(--fs-12);
  }
  th {
    position: sticky;
    top: 0;
    background: var(--bg-1);
    color: var(--text-3);
    font-weight: 400;
    font-size: var(--fs-11);
  }
  th,
  td {
    text-align: right;
    padding: 2px 12px;
  }
  .none {
    display: flex;
    gap: 8px;
    margin: 12px 14px;
    color: var(--text-3);
    font-size: var(--fs-12);
  }
`;
