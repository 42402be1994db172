// SPDX-License-Identifier: Apache-2.0
import {css, html, nothing, type TemplateResult} from 'lit';
import {icon} from '../../ui/icons';
import type {Placed} from '../../model/pose_history';
import type {PanelContext} from '../../panel_api';
import {RobotFlag} from '../../protocol/frames';
import {stateOf} from '../robots/robot_state';

/** Where the World View has the page for itself: what the panel Robots would say of the selected
 * robot. */
export function renderCard(
  {model, selection, palette}: PanelContext,
  placed: Placed,
): TemplateResult | typeof nothing {
  const slot = selection.primary;
  const robot = slot === null ? undefined : model.robots[slot];
  if (slot === null || robot === undefined || slot >= placed.count) return nothing;
  const hue = palette.hue(slot);
  const known = (placed.flags[slot] & RobotFlag.known) !== 0;
  const degrees = Math.round(((placed.yaw[slot] * 180) / Math.PI + 720) % 360);
  const speed = Math.abs(model.poses.newest?.speed[slot] ?? 0);
  const state = stateOf(robot, placed.flags[slot]);
  return html`<section class="card" aria-label="Selected robot">
    <h3>
      <i
        class="glyph ${robot.kind}"
        style="--hue:${robot.kind === 'real' ? hue.fill : hue.ink}"></i>
      <span style="color:${hue.ink}">${robot.name}</span
      ><span class="chip">${robot.kind}${robot.recorded ? ', recorded' : ''}</span>
      <button
        class="icon-button"
        title="Clear the selection (Esc)"
        aria-label="Clear the selection"
        @click=${() => selection.set([])}>
        ${icon('x', 14)}
      </button>
    </h3>
    <dl>
      <dt>Pose</dt>
      <dd>
        ${known
          ? `${placed.x[slot].toFixed(2)}, ${placed.y[slot].toFixed(2)} m · ${degrees}°`.replaceAll(
              '-',
              '−',
            )
          : 'not known'}
      </dd>
      <dt>Speed</dt>
      <dd>${speed.toFixed(2)} m/s</dd>
      ${state === ''
        ? nothing
        : html`<dt>State</dt>
            <dd class="care">${state}</dd>`}
      ${robot.program === ''
        ? nothing
        : html`<dt>Program</dt>
            <dd>${robot.program}</dd>`}
    </dl>
  </section>`;
}

export const worldCardStyles = css`
  .card {
    position: absolute;
    left: 12px;
    bottom: 12px;
    z-index: 3;
    width: 264px;
    padding: 8px 12px 12px;
    background: var(--bg-1);
    border: 1px solid var(--line-2);
    border-radius: var(--r-3);
    font-size: var(--fs-12);
  }
  .card h3 {
    display: flex;
    align-items: center;
    gap: 8px;
    margin: 0 0 4px;
    font-size: var(--fs-13);
  }
  .card h3 .icon-button {
    margin-left: auto;
  }
  .card dl {
    display: grid;
    grid-template-columns: 64px 1fr;
    gap: 5px 8px;
    margin: 0;
  }
  .card dt {
    color: var(--text-2);
  }
  .card dd {
    margin: 0;
  }
  .card .care {
    color: var(--warn);
  }
`;
