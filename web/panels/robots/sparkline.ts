// SPDX-License-Identifier: Apache-2.0
import {html, svg, type TemplateResult} from 'lit';
import {kHistory_s, type PoseHistory} from '../../model/pose_history';

const kHeight_px = 16;
/** The speed at the upper edge, m/s: the same for all robots, so that they can be compared. */
const kTop_mps = 0.4;

/** The speed of a robot in the last seconds, as a line. `width` is in pixels. */
export function sparkline(
  {past, newest}: PoseHistory,
  slot: number,
  colour: string,
  width: number,
): TemplateResult {
  if (newest === null || past.length < 2)
    return html`<svg class="spark" width=${width} height=${kHeight_px}></svg>`;
  const points = past
    // Frames of before a change of the run may have fewer robots.
    .filter((frame) => frame.speed.length > slot)
    .map((frame) => {
      const x = width * (1 - (newest.time_s - frame.time_s) / kHistory_s);
      const y = 14 - 12 * Math.min(Math.abs(frame.speed[slot]) / kTop_mps, 1);
      return `${x.toFixed(1)},${y.toFixed(1)}`;
    });
  return html`<svg class="spark" width=${width} height=${kHeight_px} aria-hidden="true">
    ${svg`<polyline points=${points.join(' ')} fill="none" stroke=${colour} />`}
  </svg>`;
}
