// SPDX-License-Identifier: Apache-2.0
// The stick over the World View of a phone or a pen: the world stays in sight, and no text of it
// moves the stick.
import {css, html, nothing, type TemplateResult} from 'lit';
import {icon} from '../../ui/icons';
import {initials} from '../../ui/words';
import type {PanelContext} from '../../panel_api';
import type {GuardAct} from '../robot/guard_act';
import type {DriveLoop} from './drive_loop';
import {drivenText, signed} from './drive_view';

/** What the controls cover of the picture, pixels: the stick, or the pedals with the line above
 * them. */
export const kCovers_px = {stick: 178, pedals: 216};

export interface OverView {
  slot: number;
  loop: DriveLoop;
  guard: GuardAct | null;
  /** Why the robot does not obey; empty if it does. */
  why: string;
  /** The stick, or the pedals. */
  controls: TemplateResult;
  layouts: TemplateResult;
  swap(): void;
}

export function renderOver({model, link, palette}: PanelContext, view: OverView): TemplateResult {
  const {slot, loop, guard, why} = view;
  const robot = model.robots[slot];
  const hue = palette.hue(slot);
  const drive = model.drives.get(slot);
  const direct = link.direct?.way(robot.name) === 'direct';
  const lease =
    drive === undefined || drive.lease === ''
      ? nothing
      : html`<span class="chip ${drive.yours ? 'you' : ''}"
          >${icon('hand', 13)} ${drive.yours ? 'you' : initials(drive.lease)}</span
        >`;
  const [v] = loop.velocity;
  const note =
    why !== ''
      ? html`<p class="why" role="alert">${why}</p>`
      : guard === null
        ? html`<p>${loop.held === null ? 'hold to drive' : 'let go: it stands'}</p>`
        : html`<p class="guarded">guard ${guard.limit_mps.toFixed(2)}, ${guard.why}</p>`;
  return html` <div class="who">
      <i class="glyph ${robot.kind}" style="--hue:${robot.kind === 'real' ? hue.fill : hue.ink}"></i
      ><b style="color:${hue.ink}">${robot.name}</b>${lease}
      <span
        class="way ${direct ? 'direct' : ''}"
        title=${direct ? 'Direct line' : 'Through the server'}
        >${icon(direct ? 'zap' : 'server', 14)}
        ${loop.delay_ms === 0 ? '–' : `${Math.round(loop.delay_ms)} ms`}</span
      >
    </div>
    ${view.controls}
    <div class="read">
      <div class="set">
        ${view.layouts}<button
          class="icon-button"
          title="The stick for the other hand"
          aria-label="The stick for the other hand"
          @click=${view.swap}>
          ${icon('move', 16)}
        </button>
      </div>
      <div class="says">
        <span>asked <b>${signed(v)}</b> m/s</span
        ><span>driven <b>${drivenText(model, link, slot)}</b> m/s</span>${note}
      </div>
    </div>`;
}

export const overStyles = css`
  :host([over]) {
    position: absolute;
    inset: 0;
    z-index: 4;
    display: block;
    height: auto;
    background: none;
    overflow: hidden;
    pointer-events: none;
    container-type: normal;
  }
  .who {
    position: absolute;
    left: 10px;
    top: 10px;
    display: flex;
    align-items: center;
    gap: 10px;
    max-width: calc(100% - 84px);
    height: 38px;
    padding: 0 14px;
    border: 1px solid var(--line-2);
    border-radius: var(--r-4);
    background: var(--bg-1);
    font-size: 12.5px;
    white-space: nowrap;
  }
  .who b {
    overflow: hidden;
    text-overflow: ellipsis;
  }
  .who .you {
    background: linear-gradient(var(--intent-soft) 0 0), var(--bg-1);
    color: var(--intent);
  }
  .way {
    display: inline-flex;
    align-items: center;
    gap: 6px;
    min-width: 62px;
    font-weight: var(--fw-medium);
  }
  .way.direct svg {
    color: var(--ok);
  }
  :host([over]) .stick {
    pointer-events: auto;
    inset: auto auto 10px 12px;
    margin: 0;
    width: 162px;
    height: 162px;
    max-width: none;
  }
  :host([over][swapped]) .stick {
    inset: auto 12px 10px auto;
  }
  :host([over]) .plate {
    fill: color-mix(in srgb, var(--bg-2) 82%, transparent);
  }
  :host([over]) .car {
    pointer-events: auto;
    inset: auto 10px 10px;
    height: 158px;
    max-height: none;
    margin: 0;
    padding: 8px;
    background: color-mix(in srgb, var(--bg-1) 82%, transparent);
  }
  .read {
    position: absolute;
    right: 10px;
    bottom: 10px;
    width: 182px;
    text-align: right;
    font-size: 12.5px;
    color: var(--text-2);
  }
  :host([over][swapped]) .read {
    right: auto;
    left: 10px;
    text-align: left;
  }
  .set {
    display: flex;
    justify-content: flex-end;
    gap: 4px;
    margin-bottom: 6px;
    pointer-events: auto;
  }
  :host([over][swapped]) .set {
    justify-content: flex-start;
    flex-direction: row-reverse;
  }
  .set .segments,
  .set .icon-button {
    background: var(--bg-1);
    border: 1px solid var(--line-2);
  }
  .says {
    height: 84px;
    padding: 6px 10px;
    border-radius: var(--r-3);
    background: var(--bg-1);
    overflow: hidden;
    line-height: 1.35;
  }
  .says span {
    display: block;
  }
  .says b {
    color: var(--text-1);
  }
  .says p {
    display: -webkit-box;
    -webkit-box-orient: vertical;
    -webkit-line-clamp: 2;
    margin: 0;
    overflow: hidden;
  }
  .says .guarded {
    color: var(--warn);
  }
  .says .why {
    color: var(--danger);
  }
  /* Pedals need the whole width: the figures stand above them, on one line. */
  :host([over][pedals]) .read {
    left: 10px;
    bottom: 172px;
    display: flex;
    flex-direction: row-reverse;
    align-items: center;
    gap: 6px;
    width: auto;
  }
  :host([over][pedals]) .set {
    margin: 0;
  }
  :host([over][pedals]) .set .icon-button {
    display: none;
  }
  :host([over][pedals]) .says {
    display: flex;
    flex: 1;
    gap: 10px;
    min-width: 0;
    height: 36px;
    line-height: 24px;
    white-space: nowrap;
  }
  :host([over][pedals]) .says span {
    flex: none;
  }
  :host([over][pedals]) .says p {
    display: block;
    min-width: 0;
    text-overflow: ellipsis;
  }
`;
