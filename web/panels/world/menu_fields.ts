// SPDX-License-Identifier: Apache-2.0
import {html, type TemplateResult} from 'lit';

export function renderFlag(
  text: string,
  note: string,
  on: boolean,
  turn: () => void,
): TemplateResult {
  return html` <label
    ><span>${text}</span><em>${note}</em>
    <input type="checkbox" role="switch" .checked=${on} @change=${turn}
  /></label>`;
}

export function renderChoice<T extends string>(
  text: string,
  value: T,
  values: readonly (readonly [T, string])[],
  take: (value: T) => void,
): TemplateResult {
  return html` <label
    ><span>${text}</span
    ><select
      aria-label=${text}
      @change=${(event: Event) => take((event.target as HTMLSelectElement).value as T)}>
      ${values.map(
        ([other, word]) =>
          html`<option value=${other} ?selected=${other === value}>${word}</option>`,
      )}
    </select></label
  >`;
}
