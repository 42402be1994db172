// SPDX-License-Identifier: Apache-2.0
import {html, type TemplateResult} from 'lit';
import type {Sensor} from '../../protocol/messages';
import {beamText} from './course_fields';

/** Which beam of a range sensor is drawn over time. */
export function renderBeam(
  sensor: Sensor,
  beam: number,
  set: (beam: number) => void,
): TemplateResult {
  const bearings = sensor.bearings ?? [];
  return html`<label class="beam"
    ><input
      type="range"
      min="0"
      max=${bearings.length - 1}
      .value=${String(beam)}
      aria-label="Beam"
      aria-valuetext=${beamText(bearings[beam] ?? 0)}
      @input=${(event: Event) =>
        set(Number((event.target as HTMLInputElement).value))} />${beamText(
      bearings[beam] ?? 0,
    )}</label
  >`;
}
