// SPDX-License-Identifier: Apache-2.0
// What stands around the stick. Each part has a place of fixed size: a message takes the place of
// another text, and moves nothing.
import {css, html, nothing, type TemplateResult} from 'lit';
import {icon} from '../../ui/icons';
import type {Link} from '../../model/link';
import type {RunModel} from '../../model/run_model';
import type {GuardAct} from '../robot/guard_act';
import type {DriveLoop} from './drive_loop';

const kTop_mps = [0.1, 0.2, 0.4, 0.8, 1.6];
const kRecent = 3;

/** Two digits, without the sign of a zero. */
export function signed(value: number): string {
  return (Math.abs(value) < 0.005 ? 0 : value).toFixed(2).replace('-', '−');
}

/** The measured speed; a dash while the last picture is an old one. */
export function drivenText(model: RunModel, link: Link, slot: number): string {
  return link.state === 'open' ? signed(model.poses.newest?.speed[slot] ?? 0) : '–';
}

/** Asked and driven speed, turn, and what a full stick is. */
export function renderFigures(
  model: RunModel,
  link: Link,
  loop: DriveLoop,
  slot: number,
): TemplateResult {
  const [v, w] = loop.velocity;
  return html`<dl class="figures">
    <div>
      <dt>asked</dt>
      <dd><b>${signed(v)}</b> m/s</dd>
    </div>
    <div>
      <dt>driven</dt>
      <dd title=${link.state === 'open' ? nothing : 'The last picture is old'}>
        <b>${drivenText(model, link, slot)}</b> m/s
      </dd>
    </div>
    <div>
      <dt>turn left</dt>
      <dd><b>${signed(w)}</b> rad/s</dd>
    </div>
    <div>
      <dt>full stick</dt>
      <dd>
        <select
          aria-label="Full stick"
          @change=${(event: Event) => {
            loop.v_mps = Number((event.target as HTMLSelectElement).value);
          }}>
          ${kTop_mps.map(
            (top) => html`<option value=${top} ?selected=${top === loop.v_mps}>${top} m/s</option>`,
          )}
        </select>
      </dd>
    </div>
  </dl>`;
}

/** Two lines: what holding means, or why the robot does not obey; and what the guard lets
 * through. */
export function renderNotes(
  held: boolean,
  why: string,
  refusal: string,
  guard: GuardAct | null,
): TemplateResult {
  const said =
    refusal !== ''
      ? html`<p class="why bad" role="alert" title=${refusal}>${refusal}</p>`
      : why !== ''
        ? html`<p class="why" title=${why}>${why}</p>`
        : html`<p class=${held ? 'held' : ''}>
            <b>${held ? 'dead-man held' : 'hold to drive'}</b> let go: it stands
          </p>`;
  return html`<div class="notes ${guard === null ? 'both' : ''}" role="status">
    ${said}
    ${guard === null
      ? nothing
      : html`<p class="guarded" title=${guard.why}>
          <i></i>guard ${guard.limit_mps.toFixed(2)} m/s <span>${guard.why}</span>
        </p>`}
  </div>`;
}

/** Which way the velocities go, and how long they take. */
export function renderLine(link: Link, loop: DriveLoop, name: string): TemplateResult {
  const direct = link.direct?.way(name) === 'direct';
  const {delays_ms} = loop;
  const top = Math.max(50, ...delays_ms);
  const points = delays_ms.map((delay, i) => `${i * 1.6},${14 - (12 * delay) / top}`).join(' ');
  return html`<div class="line">
    <span class="chip ${direct ? 'direct' : ''}"
      >${icon(direct ? 'zap' : 'server', 13)} ${direct ? 'Direct line' : 'through the server'}</span
    >
    <span class="delay"
      ><svg width="64" height="16" aria-hidden="true"><polyline points=${points} /></svg
      ><b>${loop.delay_ms === 0 ? '–' : `${Math.round(loop.delay_ms)} ms`}</b></span
    >
  </div>`;
}

/** The last messages, in rows that are there also while there are none. */
export function renderRecent(model: RunModel): TemplateResult {
  const now_s = model.poses.newest?.time_s ?? model.time?.now_s ?? 0;
  const said = model.lines.slice(-kRecent).map((line) => ({
    t: line.t,
    glyph: 'message' as const,
    text: `${line.from.name}: ${line.text}`,
  }));
  const alerts = model.events
    .filter((event) => event.level !== 'info')
    .slice(-kRecent)
    .map((event) => ({t: event.until, glyph: 'alert' as const, text: event.text}));
  const rows = [...said, ...alerts].sort((a, b) => b.t - a.t).slice(0, kRecent);
  return html`<ul class="recent" aria-label="Last messages">
    ${Array.from({length: kRecent}, (_, i) => rows[i]).map((row) =>
      row === undefined
        ? html`<li></li>`
        : html` <li class=${row.glyph} title=${row.text}>
            ${icon(row.glyph === 'message' ? 'message' : 'info', 13)}<span>${row.text}</span
            ><em>${agoText(now_s - row.t)}</em>
          </li>`,
    )}
  </ul>`;
}

function agoText(ago_s: number): string {
  if (ago_s < 1) return 'now';
  return ago_s < 60 ? `${Math.floor(ago_s)} s` : `${Math.floor(ago_s / 60)} min`;
}

export const driveStyles = css`
  .figures {
    display: grid;
    grid-template-columns: repeat(4, auto);
    justify-content: space-between;
    gap: 8px;
    height: 44px;
    margin: 0;
    padding: 2px 14px 0;
    flex: none;
    overflow: hidden;
    border-bottom: 1px solid var(--line-1);
    color: var(--text-2);
    font-size: var(--fs-11);
    white-space: nowrap;
  }
  .figures dd {
    margin: 0;
    min-width: 62px;
  }
  .figures b {
    color: var(--text-1);
    font-size: var(--fs-15);
  }
  .figures select {
    height: 20px;
    padding: 0;
    font: inherit;
    font-size: var(--fs-12);
    color: var(--text-1);
    background: var(--bg-3);
    border: 1px solid var(--line-2);
    border-radius: var(--r-2);
  }
  .notes {
    height: 42px;
    padding: 0 14px;
    flex: none;
    font-size: var(--fs-12);
    color: var(--text-2);
  }
  .notes p {
    height: 20px;
    margin: 0;
    overflow: hidden;
    text-align: center;
    text-overflow: ellipsis;
    white-space: nowrap;
  }
  /* Without a guard that acts a message has both lines. */
  .notes.both .why {
    display: -webkit-box;
    height: 40px;
    -webkit-box-orient: vertical;
    -webkit-line-clamp: 2;
    line-height: 20px;
    white-space: normal;
  }
  .notes .held b {
    color: var(--intent);
  }
  .notes .bad {
    color: var(--danger);
  }
  .notes .guarded {
    color: var(--warn);
  }
  .guarded i {
    display: inline-block;
    width: 22px;
    margin-right: 8px;
    border-top: 2.5px dashed var(--warn);
    vertical-align: middle;
  }
  .line {
    display: flex;
    align-items: center;
    justify-content: space-between;
    gap: 10px;
    height: 34px;
    padding: 0 12px;
    flex: none;
    border-top: 1px solid var(--line-1);
    font-size: var(--fs-12);
  }
  .chip.direct {
    background: linear-gradient(var(--ok-soft) 0 0), var(--bg-1);
    color: var(--ok);
  }
  .delay {
    display: flex;
    align-items: center;
    gap: 8px;
    white-space: nowrap;
  }
  polyline {
    fill: none;
    stroke: var(--ok);
    stroke-width: 1.25;
  }
  .recent {
    display: none;
    flex: none;
    margin: 0;
    padding: 6px 12px;
    list-style: none;
    border-top: 1px solid var(--line-1);
    font-size: var(--fs-12);
    color: var(--text-2);
  }
  .recent li {
    display: flex;
    align-items: center;
    gap: 8px;
    height: 21px;
  }
  .recent span {
    flex: 1;
    min-width: 0;
    overflow: hidden;
    text-overflow: ellipsis;
    white-space: nowrap;
  }
  .recent .alert svg {
    color: var(--warn);
  }
  .recent em {
    color: var(--text-3);
    font-style: normal;
  }
  @container (min-height: 520px) {
    .recent {
      display: block;
    }
  }
`;
