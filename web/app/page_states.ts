// SPDX-License-Identifier: Apache-2.0
// What the page says when there is no run to show, or no line to it.
import {css, html, nothing, type TemplateResult} from 'lit';
import type {Link} from '../model/link';
import type {RunModel} from '../model/run_model';
import {countStopped} from '../model/stop_state';
import {clockText} from '../ui/clock';
import {icon} from '../ui/icons';
import {logo} from './logo';
import {namesText, roleText} from '../ui/words';

/** Who stands, as the hosts say, and whom no stop of this page can reach. */
function reachText(model: RunModel, link: Link): string {
  const hosts = link.direct?.open.length ?? 0;
  const {robots, stopped} = countStopped(model, (slot) => link.reachesRobot(slot));
  const reached = new Set(robots);
  const names = (slots: readonly number[]) =>
    namesText(slots.map((slot) => model.robots[slot].name));
  const out = [...model.robots.keys()].filter((slot) => model.stops(slot) && !reached.has(slot));
  return [
    hosts > 0
      ? `Orders and STOP still go straight to ${hosts === 1 ? 'the host' : `${hosts} hosts`}.`
      : '',
    stopped.length > 0 ? `${names(stopped)} ${stopped.length === 1 ? 'is' : 'are'} stopped.` : '',
    out.length > 0
      ? `${names(out)} ${out.length === 1 ? 'is' : 'are'} out of reach: stop ` +
        (out.length === 1 ? 'it at its machine.' : 'them at their machines.')
      : '',
  ]
    .filter((text) => text !== '')
    .join(' ');
}

/** The picture stays, without colour, with its time. */
export function renderLost(model: RunModel, link: Link): TemplateResult {
  const now_ms = performance.now();
  const shown = model.poses.newest;
  const again_s = Math.max(0, Math.ceil((link.retryAt_ms - now_ms) / 1000));
  const reach = model.live && model.may('stop') ? ` ${reachText(model, link)}` : '';
  return html`<div class="strip lost" role="alert">
    ${icon('wifiOff', 16)}
    <span
      ><b>Link lost ${((now_ms - link.lostAt_ms) / 1000).toFixed(1)} s ago.</b> ${shown === null
        ? ''
        : `This is ${clockText(shown.time_s)} s. `}Trying
      again in ${again_s} s.${reach}</span
    >
    <button @click=${() => link.open()}>Now</button>
  </div>`;
}

/** Amber, with the name of whom it waits for. */
export function renderWaits(model: RunModel): TemplateResult | typeof nothing {
  const {time} = model;
  if (
    time === null ||
    time.reason === '' ||
    (time.state !== 'waiting' && !(model.live && time.state === 'ended'))
  )
    return nothing;
  return html`<div class="strip waits" role="status">
    ${icon('hourglass', 16)}<span>${time.reason}</span>
  </div>`;
}

/** A super-user looks at the run as another user. */
export function renderSeenBy(model: RunModel, back: () => void): TemplateResult | typeof nothing {
  const hello = model.hello;
  if (hello?.seen_by === undefined) return nothing;
  return html`<div class="strip seen" role="status">
    ${icon('eye', 16)}
    <span
      >This is what <b>${hello.user.name}</b>, ${roleText(hello.user.role).toLowerCase()},
      gets.</span
    ><button @click=${back}>Back</button>
  </div>`;
}

/** The frame stands at once; the world fills in as it comes. */
export function renderOpening(): TemplateResult {
  return html`<div class="opening" role="status"><b>Loading the run ...</b></div>`;
}

/** The server runs, but no run does. The page keeps asking. */
export function renderNoRun(): TemplateResult {
  return html`<div class="whole">
    ${logo()}
    <h1>No run in progress</h1>
    <p>Start one in a terminal, or open a recording.</p>
    <code>rave run mixed-reality --gui</code>
  </div>`;
}

export function renderRefused(reason: string): TemplateResult {
  return html`<div class="whole">
    ${logo()}
    <h1>${reason === '' || reason === 'not signed in' ? 'You are not signed in' : reason}</h1>
    <p>Open the link that the terminal printed when the run began. It works once.</p>
    <p>If you have an account on this server, <a href="./">sign in</a>.</p>
  </div>`;
}

export const stateStyles = css`
  .strip {
    display: flex;
    align-items: center;
    gap: 12px;
    margin: 0 6px 6px;
    padding: 8px 14px;
    border: 1px solid var(--line-2);
    border-radius: var(--r-3);
    font-size: var(--fs-12);
  }
  .strip span {
    flex: 1;
    color: var(--text-1);
  }
  .strip.lost,
  .strip.refused {
    border-color: var(--danger);
    background: var(--danger-soft);
    color: var(--danger);
  }
  .strip.waits {
    border-color: var(--warn);
    background: var(--warn-soft);
    color: var(--warn);
  }
  .strip.seen {
    border-color: var(--intent);
    background: var(--intent-soft);
    color: var(--intent);
  }
  .strip button {
    padding: 3px 12px;
    border: 1px solid var(--line-2);
    border-radius: var(--r-3);
    color: var(--text-1);
    background: var(--bg-2);
  }
  .opening {
    position: absolute;
    inset: 44px 0 90px;
    display: grid;
    place-items: center;
    color: var(--text-2);
    pointer-events: none;
    z-index: 2;
  }
  .whole {
    height: 100%;
    display: grid;
    place-content: center;
    justify-items: center;
    text-align: center;
    gap: 6px;
    padding: 24px;
  }
  .whole > svg {
    width: 52px;
    height: 36px;
  }
  .whole h1 {
    font-size: var(--fs-20);
    font-weight: 600;
    margin: 14px 0 0;
  }
  .whole p {
    color: var(--text-2);
    margin: 4px 0;
  }
  .whole a {
    color: var(--intent);
  }
  .whole code {
    padding: 6px 14px;
    border-radius: var(--r-3);
    background: var(--bg-2);
    font: 400 var(--fs-13) var(--font-code);
    color: var(--text-1);
  }
`;
