// SPDX-License-Identifier: Apache-2.0
import {css} from 'lit';

/** Controls that look the same in every panel. */
export const controls = css`
  :host {
    color: var(--text-1);
    font: var(--fw-regular) var(--fs-13) / var(--lh-body) var(--font-ui);
    font-variant-numeric: tabular-nums;
    scrollbar-width: thin;
  }
  * {
    box-sizing: border-box;
    scrollbar-width: thin;
  }
  button {
    font: inherit;
    color: inherit;
    background: none;
    border: 0;
    padding: 0;
    cursor: pointer;
  }
  button:disabled {
    cursor: default;
    opacity: 0.45;
  }
  :focus-visible {
    outline: 2px solid var(--intent);
    outline-offset: 1px;
  }
  .space {
    flex: 1;
  }
  .icon-button {
    display: inline-grid;
    place-items: center;
    width: var(--h-control);
    height: var(--h-control);
    border-radius: var(--r-3);
    color: var(--text-2);
    transition: background var(--t-fast) var(--ease);
  }
  .icon-button:hover:not(:disabled) {
    background: var(--bg-3);
    color: var(--text-1);
  }
  .icon-button[aria-pressed='true'] {
    background: var(--intent-soft);
    color: var(--intent);
  }
  .segments {
    display: inline-flex;
    background: var(--bg-2);
    border: 1px solid var(--line-1);
    border-radius: var(--r-3);
    padding: 1px;
    gap: 1px;
  }
  .segments button {
    height: 24px;
    padding: 0 10px;
    border-radius: 5px;
    color: var(--text-2);
    font-size: var(--fs-12);
  }
  .segments button[aria-pressed='true'],
  .segments button[aria-checked='true'] {
    background: var(--bg-4);
    color: var(--text-1);
    font-weight: var(--fw-medium);
  }
  .chip {
    display: inline-flex;
    align-items: center;
    gap: 6px;
    height: 22px;
    padding: 0 8px;
    border-radius: var(--r-2);
    background: var(--bg-2);
    color: var(--text-2);
    font-size: var(--fs-12);
    white-space: nowrap;
  }
  .field {
    display: flex;
    align-items: center;
    gap: 8px;
    height: var(--h-control);
    padding: 0 8px;
    border: 1px solid var(--line-2);
    border-radius: var(--r-3);
    background: var(--bg-2);
    color: var(--text-3);
  }
  .field input {
    flex: 1;
    min-width: 0;
    border: 0;
    outline: 0;
    background: none;
    color: var(--text-1);
    font: inherit;
    font-size: var(--fs-12);
  }
  .field input::placeholder {
    color: var(--text-3);
  }
  .field:focus-within {
    border-color: var(--intent);
  }
  svg {
    display: block;
    flex: none;
  }
  @media (pointer: coarse) {
    .icon-button {
      width: 40px;
      height: 40px;
    }
    .segments button {
      height: 34px;
    }
  }
`;

/** Glyphs of kinds: filled is real, hollow is simulated, hatched is virtual. */
export const glyphs = css`
  .glyph {
    display: inline-block;
    flex: none;
    width: 11px;
    height: 11px;
  }
  .glyph.real {
    border-radius: 50%;
    background: var(--hue, var(--text-1));
  }
  .glyph.simulated {
    width: 9px;
    height: 9px;
    margin: 1px;
    border: 1.5px solid var(--hue, var(--sim-ink));
    transform: rotate(45deg);
  }
  .glyph.virtual {
    border: 1.5px solid var(--virtual-line);
    background: repeating-linear-gradient(135deg, var(--virtual-line) 0 1px, transparent 1px 3.5px);
  }
  .glyph.landmark {
    width: 7px;
    height: 7px;
    margin: 2px;
    border-radius: 50%;
    background: var(--landmark);
  }
  .glyph.wall {
    height: 5px;
    margin: 3px 0;
    background: var(--wall);
  }
`;
