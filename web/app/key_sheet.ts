// SPDX-License-Identifier: Apache-2.0
import {css, html, type TemplateResult} from 'lit';
import type {KeyAction} from './keys';

/** All keys and what they do. */
export function renderKeys(actions: readonly KeyAction[], close: () => void): TemplateResult {
  return html`<div class="scrim" @click=${close}>
    <div class="keys" role="dialog" aria-modal="true" tabindex="0" aria-label="Keyboard">
      <h2>Keyboard</h2>
      <dl>
        ${actions.map(
          (action) =>
            html`<div>
              <dt>${action.what}</dt>
              <dd>${action.keys.map((key) => html`<kbd>${key}</kbd>`)}</dd>
            </div>`,
        )}
      </dl>
    </div>
  </div>`;
}

export const keySheetStyles = css`
  .scrim {
    position: fixed;
    inset: 0;
    display: grid;
    place-items: center;
    background: var(--scrim);
    z-index: 30;
  }
  .keys {
    width: min(620px, 92vw);
    max-height: 86vh;
    overflow: auto;
    padding: 18px 24px;
    background: var(--bg-2);
    border: 1px solid var(--line-2);
    border-radius: var(--r-4);
    box-shadow: var(--shadow-pop);
  }
  .keys h2 {
    margin: 0 0 10px;
    font-size: var(--fs-15);
  }
  .keys dl {
    columns: 2;
    column-gap: 32px;
    margin: 0;
    font-size: var(--fs-12);
  }
  .keys dl > div {
    display: flex;
    justify-content: space-between;
    gap: 8px;
    padding: 6px 0;
    border-bottom: 1px solid var(--line-1);
    break-inside: avoid;
  }
  .keys dd {
    margin: 0;
    display: flex;
    gap: 4px;
  }
  .keys kbd {
    padding: 0 6px;
    border: 1px solid var(--line-2);
    border-radius: var(--r-2);
    background: var(--bg-2);
    color: var(--text-2);
    font: 500 var(--fs-11) var(--font-ui);
    white-space: nowrap;
  }
  @media (max-width: 599px) {
    .keys dl {
      columns: 1;
    }
  }
`;
