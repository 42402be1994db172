// SPDX-License-Identifier: Apache-2.0
import {css} from 'lit';

export const robotStyles = css`
  :host {
    display: flex;
    flex-direction: column;
    height: 100%;
    background: var(--bg-1);
    font-size: var(--fs-12);
  }
  header {
    display: flex;
    align-items: center;
    gap: 8px;
    padding: 10px 12px;
    flex: none;
  }
  header b {
    font-size: var(--fs-15);
    overflow: hidden;
    text-overflow: ellipsis;
  }
  .scroll {
    flex: 1;
    overflow: auto;
    padding: 0 12px 12px;
  }
  .halt {
    display: flex;
    align-items: center;
    gap: 8px;
    margin-top: 8px;
  }
  .halt button {
    display: inline-flex;
    align-items: center;
    gap: 6px;
    height: var(--h-control);
    padding: 0 10px;
    border-radius: var(--r-3);
    font-size: var(--fs-12);
  }
  .halt .stop {
    background: var(--stop-fill);
    color: #fff;
    font-weight: var(--fw-medium);
  }
  .halt .stop:disabled {
    opacity: 1;
    background: var(--danger-soft);
    color: var(--danger);
  }
  .halt .release {
    border: 1px solid var(--danger);
    color: var(--danger);
  }
  .plain {
    background: var(--bg-3);
    border: 1px solid var(--line-2);
  }
  .order {
    flex: 1;
    min-width: 0;
    color: var(--intent);
    overflow: hidden;
    text-overflow: ellipsis;
    white-space: nowrap;
  }
  h4 {
    display: flex;
    align-items: center;
    gap: 6px;
    margin: 14px 0 6px;
    color: var(--text-2);
    font-size: var(--fs-12);
    font-weight: var(--fw-medium);
  }
  h4 em,
  label em {
    font-style: normal;
    font-weight: 400;
    color: var(--text-3);
    font-size: var(--fs-11);
  }
  code {
    font: 400 var(--fs-11) var(--font-code);
    color: var(--text-2);
  }
  .takes {
    display: flex;
    flex-wrap: wrap;
    gap: 6px;
  }
  .takes .chip {
    gap: 4px;
    color: var(--text-3);
  }
  .takes .chip.yes {
    background: linear-gradient(var(--ok-soft) 0 0), var(--bg-1);
    color: var(--ok);
  }
  .faint {
    color: var(--text-3);
  }
  .parameters label {
    display: grid;
    grid-template-columns: minmax(84px, 1fr) minmax(50px, 84px) 62px 40px;
    gap: 8px;
    align-items: center;
    min-height: var(--h-row);
  }
  .parameters code {
    overflow: hidden;
    text-overflow: ellipsis;
    white-space: nowrap;
  }
  .parameters input[type='checkbox'],
  .parameters select,
  .parameters input[type='text'] {
    grid-column: 2 / 4;
    justify-self: start;
    max-width: 100%;
  }
  input[type='range'] {
    width: 100%;
    accent-color: var(--intent);
  }
  input[type='number'],
  input[type='text'],
  select {
    width: 100%;
    height: 22px;
    padding: 0 4px;
    font: inherit;
    color: var(--text-1);
    background: var(--bg-2);
    border: 1px solid var(--line-2);
    border-radius: var(--r-2);
  }
  .bad {
    margin: 0 0 4px;
    color: var(--danger);
  }
  .guard {
    display: flex;
    align-items: center;
    gap: 6px;
    margin: 0;
  }
  .guard svg {
    color: var(--warn);
  }
  dl {
    display: grid;
    grid-template-columns: 84px 1fr;
    gap: 4px 8px;
    margin: 0;
  }
  dt {
    color: var(--text-3);
    overflow: hidden;
    text-overflow: ellipsis;
  }
  dd {
    margin: 0;
  }
  .tag {
    padding: 0 5px;
    border-radius: var(--r-2);
    background: var(--virtual-fill);
    color: var(--virtual-ink);
    font-size: var(--fs-11);
  }
  h4 .asked::before,
  h4 .driven::before {
    content: '';
    display: inline-block;
    width: 16px;
    margin: 0 4px 3px 6px;
    border-top: 1.5px solid var(--text-1);
  }
  h4 .asked::before {
    border-top: 1.5px dashed var(--intent);
  }
  .trace {
    display: grid;
    grid-template-columns: 62px 1fr;
    gap: 6px;
    margin-bottom: 4px;
  }
  .trace span {
    color: var(--text-3);
    font-size: var(--fs-11);
    line-height: 15px;
    text-align: right;
  }
  .plot {
    display: block;
    width: 100%;
    height: 44px;
  }
  .plot line {
    stroke: var(--line-2);
  }
  .plot polyline {
    fill: none;
    stroke: var(--text-1);
    stroke-width: 1.5;
    vector-effect: non-scaling-stroke;
  }
  .plot polyline.asked {
    stroke: var(--intent);
    stroke-dasharray: 4 3;
  }
  .now {
    margin: 2px 0 0;
    color: var(--text-2);
  }
  .now b {
    color: var(--text-1);
  }
  .empty {
    display: grid;
    place-content: center;
    justify-items: center;
    gap: 4px;
    height: 100%;
    color: var(--text-3);
  }
`;
