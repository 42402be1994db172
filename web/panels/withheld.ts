// SPDX-License-Identifier: Apache-2.0
import {css, html, nothing, type TemplateResult} from 'lit';
import {icon} from '../ui/icons';
import type {PanelContext} from '../panel_api';
import type {Power} from '../protocol/messages';

/** In place of what is missing: what it is, which roles have it and whom to ask, or why there is
 * none at all. */
export function renderWithheld(context: PanelContext, power: Power): TemplateResult {
  const {model} = context;
  return renderNote(context, model.whyNot(power), model.isWithheld(power) || power === 'rights');
}

/** The same with a sentence of the panel itself. `ask`: a super-user can change it. */
export function renderNote(context: PanelContext, text: string, ask = true): TemplateResult {
  const {model, commands} = context;
  const chat = () => {
    commands.address('super-users');
    context.show('chat');
  };
  return html`<div class="withheld" role="note">
    ${icon('lock', 15)}
    <p>
      ${text}
      ${ask && model.live && model.may('chat')
        ? html`<button @click=${chat}>${icon('message', 13)} Ask in the chat</button>`
        : nothing}
    </p>
  </div>`;
}

export const withheldStyles = css`
  .withheld {
    display: flex;
    gap: 8px;
    margin: 12px 14px;
    color: var(--text-3);
    font-size: var(--fs-12);
  }
  .withheld svg {
    margin-top: 2px;
  }
  .withheld p {
    margin: 0;
    max-width: 60ch;
    color: var(--text-2);
  }
  .withheld button {
    display: flex;
    align-items: center;
    gap: 6px;
    height: var(--h-control);
    margin-top: 6px;
    padding: 0 10px;
    border: 1px solid var(--line-2);
    border-radius: var(--r-3);
    background: var(--bg-2);
    color: var(--text-1);
    font-size: var(--fs-12);
  }
  .withheld button:hover {
    background: var(--bg-3);
  }
  .withheld button svg {
    margin: 0;
  }
`;
