// SPDX-License-Identifier: Apache-2.0
import {html, nothing, type TemplateResult} from 'lit';
import type {Parameter} from '../protocol/messages';
import {usefulRange} from './parameter_range';

/** How a parameter is set. */
export interface ParameterControl {
  /** The value that is shown; undefined: none was given. */
  value: unknown;
  disabled?: boolean;
  /** A slider that is dragged sets every value on its way, rather than the last one alone. */
  following?: boolean;
  set(to: boolean | number | string | number[]): void;
}

const textOf = (event: Event) => (event.target as HTMLInputElement | HTMLSelectElement).value;

/** One parameter: its name, the control of its kind, its unit; what it means as a title. */
export function renderParameter(
  parameter: Parameter,
  name: string,
  control: ParameterControl,
): TemplateResult {
  const {doc, range, unit} = parameter;
  return html`<label title="${doc}${range ? ` From ${range[0]} to ${range[1]}.` : ''}"
    ><code>${name}</code>${renderControl(parameter, control)}<em>${unit}</em></label
  >`;
}

function renderControl(parameter: Parameter, control: ParameterControl): TemplateResult {
  const {key, kind} = parameter;
  const {value, disabled = false, set} = control;
  if (kind === 'flag')
    return html`<input
      type="checkbox"
      aria-label=${key}
      .checked=${value === true}
      ?disabled=${disabled}
      @change=${() => set(value !== true)} />`;
  if (kind === 'choice')
    return html`<select
      aria-label=${key}
      ?disabled=${disabled}
      @change=${(event: Event) => set(textOf(event))}>
      ${(parameter.choices ?? []).map(
        (choice) => html`<option ?selected=${choice === value}>${choice}</option>`,
      )}
    </select>`;
  if (kind === 'text')
    return html`<input
      type="text"
      aria-label=${key}
      .value=${String(value ?? '')}
      ?disabled=${disabled}
      @change=${(event: Event) => set(textOf(event))} />`;
  if (kind === 'numbers')
    return html`<input
      type="text"
      aria-label="${key}, numbers"
      placeholder="0.5, 1, …"
      .value=${Array.isArray(value) ? value.join(', ') : ''}
      ?disabled=${disabled}
      @change=${(event: Event) => set(numbersIn(textOf(event)))} />`;
  return renderNumber(parameter, control);
}

function numbersIn(text: string): number[] {
  return text
    .split(/[\s,]+/)
    .filter((part) => part !== '')
    .map(Number);
}

/** A slider over the useful values, and the number for any other one. */
function renderNumber(parameter: Parameter, control: ParameterControl): TemplateResult {
  const {key, kind, range} = parameter;
  const {disabled = false, following = false} = control;
  const number = Number(control.value ?? 0);
  const [low, high] = usefulRange(parameter, number);
  const read = (event: Event) => {
    const to = Number(textOf(event));
    control.set(kind === 'integer' ? Math.round(to) : to);
  };
  return html`<input
      type="range"
      aria-label=${key}
      min=${low}
      max=${high}
      step=${kind === 'integer' ? 1 : (high - low) / 200}
      .value=${String(number)}
      ?disabled=${disabled}
      @input=${following ? read : nothing}
      @change=${following ? nothing : read} />
    <input
      type="number"
      aria-label="${key}, value"
      step="any"
      min=${range?.[0] ?? nothing}
      max=${range?.[1] ?? nothing}
      .value=${String(number)}
      ?disabled=${disabled}
      @change=${read} />`;
}
