// SPDX-License-Identifier: Apache-2.0
import {css} from 'lit';

/** What the parts of the Super-User panel share. */
export const peopleStyles = css`
  :host {
    display: flex;
    flex-direction: column;
    height: 100%;
    min-height: 0;
    background: var(--bg-1);
    font-size: var(--fs-12);
    container-type: inline-size;
  }
  .bar {
    display: flex;
    flex-wrap: wrap;
    align-items: center;
    gap: 8px;
    padding: 8px 14px;
    flex: none;
  }
  .bar .field {
    flex: 1 1 160px;
  }
  .scroll {
    flex: 1;
    min-height: 0;
    overflow: auto;
    padding-bottom: 8px;
  }
  .face {
    display: grid;
    place-items: center;
    width: 24px;
    height: 24px;
    border-radius: 50%;
    flex: none;
    background: var(--person-fill);
    color: var(--on-fill);
    font: 600 10px var(--font-ui);
  }
  .face.you {
    background: var(--intent-fill);
    color: #fff;
  }
  small {
    display: block;
    color: var(--text-2);
    font-size: var(--fs-11);
    font-weight: 400;
  }
  .main {
    display: inline-flex;
    align-items: center;
    gap: 6px;
    height: 28px;
    padding: 0 12px;
    border-radius: var(--r-3);
    background: var(--intent-fill);
    color: #fff;
    font-weight: var(--fw-medium);
  }
  .plain {
    display: inline-flex;
    align-items: center;
    gap: 6px;
    height: 28px;
    padding: 0 12px;
    border: 1px solid var(--line-2);
    border-radius: var(--r-3);
    background: var(--bg-1);
  }
  .plain.bad {
    color: var(--danger);
  }
  form {
    display: flex;
    flex-wrap: wrap;
    align-items: end;
    gap: 10px 14px;
    padding: 10px 14px 12px;
    background: var(--bg-2);
  }
  form label,
  form fieldset {
    display: flex;
    flex-direction: column;
    gap: 4px;
    margin: 0;
    padding: 0;
    border: 0;
    color: var(--text-2);
    font-size: var(--fs-11);
  }
  form select,
  form input:not([type='checkbox']) {
    height: 28px;
    padding: 0 8px;
    border: 1px solid var(--line-3);
    border-radius: var(--r-3);
    background: var(--bg-1);
    color: var(--text-1);
    font: inherit;
    font-size: var(--fs-12);
  }
  form input[type='number'] {
    width: 76px;
  }
  fieldset div {
    display: flex;
    flex-wrap: wrap;
    align-items: center;
    gap: 4px 10px;
    min-height: 28px;
  }
  fieldset legend {
    padding: 0 0 4px;
  }
  form fieldset label {
    flex-direction: row;
    align-items: center;
    gap: 5px;
    color: var(--text-1);
    font-size: var(--fs-12);
  }
  form fieldset input:not([type='checkbox']) {
    width: 110px;
  }
  form input[type='checkbox'] {
    accent-color: var(--intent-fill);
    margin: 0;
  }
  .note {
    margin: 0;
    padding: 6px 14px;
  }
  .note.good {
    color: var(--ok);
  }
  .note.bad {
    color: var(--danger);
  }
  p {
    margin: 12px 14px;
    color: var(--text-2);
    max-width: 70ch;
  }
  @media (pointer: coarse) {
    .main,
    .plain,
    form select,
    form input:not([type='checkbox']) {
      height: 40px;
    }
    form input[type='checkbox'] {
      width: 20px;
      height: 20px;
    }
  }
`;
