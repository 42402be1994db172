// SPDX-License-Identifier: Apache-2.0
import {html, type TemplateResult} from 'lit';

/** A disc, which is real, behind a diamond, which is simulated. */
export function logo(): TemplateResult {
  return html`<svg width="26" height="18" viewBox="0 0 26 18" aria-hidden="true">
    <circle cx="8.5" cy="9" r="7.5" fill="var(--text-1)" />
    <path
      d="M17 2.2 23.8 9 17 15.8 10.2 9z"
      fill="none"
      stroke="var(--intent)"
      stroke-width="2.2"
      stroke-linejoin="round" />
  </svg>`;
}
