// SPDX-License-Identifier: Apache-2.0
import {html, nothing, type TemplateResult} from 'lit';
import type {Dock} from './dock';
import {icon} from '../ui/icons';

/** Panels had windows of their own when the page was left. A browser opens one window for each
 * press. */
export function renderAway(dock: Dock | null): TemplateResult | typeof nothing {
  if (dock === null || dock.away.length === 0) return nothing;
  const count = dock.away.length;
  return html`<div class="strip away" role="status">
    ${icon('appWindow', 16)}
    <span
      >${count === 1 ? 'A panel was in another window.' : `${count} other windows were open.`}</span
    >
    ${dock.away.map(
      (kept) => html`<button @click=${() => dock.reopen(kept)}>Open ${dock.titleOf(kept)}</button>`,
    )}
    <button @click=${() => dock.stay()}>Stay here</button>
  </div>`;
}
