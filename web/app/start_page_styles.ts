// SPDX-License-Identifier: Apache-2.0
import {css} from 'lit';

export const startStyles = css`
  :host {
    display: grid;
    grid-template-columns: minmax(0, 3fr) minmax(280px, 1fr);
    gap: 6px;
    height: 100%;
    padding: 0 6px 6px;
    font-size: var(--fs-12);
    overflow: hidden;
  }
  .left,
  .right {
    display: grid;
    gap: 6px;
    min-height: 0;
  }
  .left {
    grid-template-rows: minmax(0, 2fr) minmax(0, 1fr);
  }
  .right {
    grid-template-rows: minmax(0, 2fr) minmax(0, 1fr);
  }
  .panel {
    display: flex;
    flex-direction: column;
    min-height: 0;
    border-radius: var(--r-4);
    background: var(--bg-1);
    overflow: hidden;
  }
  header {
    display: flex;
    align-items: center;
    gap: 8px;
    min-height: var(--h-tabs);
    padding: 2px 14px;
    border-bottom: 1px solid var(--line-1);
    flex: none;
  }
  h2,
  h3 {
    margin: 0;
    font-size: var(--fs-13);
    font-weight: var(--fw-strong);
  }
  h3 {
    font-size: var(--fs-15);
  }
  small {
    margin-left: 4px;
    color: var(--text-2);
    font-size: var(--fs-11);
    font-weight: 400;
  }
  p {
    margin: 8px 14px;
    color: var(--text-2);
  }
  .filter {
    flex: 0 1 220px;
  }
  .cards {
    display: grid;
    grid-template-columns: repeat(auto-fill, minmax(230px, 1fr));
    grid-auto-rows: max-content;
    align-content: start;
    gap: 10px;
    padding: 12px 14px;
    overflow: auto;
  }
  .card {
    min-height: 86px;
    display: flex;
    flex-direction: column;
    align-items: flex-start;
    gap: 6px;
    padding: 12px;
    border: 1px solid var(--line-1);
    border-radius: var(--r-4);
    text-align: left;
  }
  .card:hover {
    background: var(--bg-2);
  }
  .card[aria-pressed='true'] {
    border-color: var(--intent);
    box-shadow: 0 0 0 1px var(--intent);
  }
  .head {
    display: flex;
    justify-content: space-between;
    align-self: stretch;
    font-size: var(--fs-13);
  }
  .text {
    color: var(--text-2);
  }
  .scroll {
    overflow: auto;
  }
  table {
    width: 100%;
    border-collapse: collapse;
    white-space: nowrap;
  }
  thead th {
    padding: 6px 8px;
    color: var(--text-2);
    font-weight: 400;
    text-align: left;
  }
  tbody tr {
    border-top: 1px solid var(--line-1);
  }
  tbody th {
    font-weight: var(--fw-medium);
    text-align: left;
  }
  th:first-child {
    padding-left: 14px;
  }
  td,
  tbody th {
    padding: 2px 8px;
  }
  td {
    color: var(--text-2);
  }
  th.number,
  td.number {
    text-align: right;
  }
  form {
    display: flex;
    flex-direction: column;
    gap: 10px;
    padding: 12px 14px;
    overflow: auto;
  }
  form p {
    margin: 0;
  }
  .row {
    display: grid;
    grid-template-columns: 90px 1fr;
    align-items: center;
    gap: 8px;
  }
  form .main {
    min-height: 36px;
  }
  rave-run-control {
    flex: 1;
  }
  ul {
    margin: 0;
    padding: 6px 14px;
    list-style: none;
    overflow: auto;
  }
  li {
    display: flex;
    align-items: center;
    gap: 8px;
    min-height: var(--h-row);
  }
  li span {
    color: var(--text-2);
  }
  .face {
    display: grid;
    place-items: center;
    width: 24px;
    height: 24px;
    border-radius: 50%;
    background: var(--person-fill);
    color: var(--on-fill);
    font: 600 10px var(--font-ui);
  }
  .face.you {
    background: var(--intent-fill);
    color: #fff;
  }
  .alone {
    grid-column: 1 / -1;
    align-self: center;
    justify-self: center;
    text-align: center;
  }
  .alone h1 {
    font-size: var(--fs-20);
    font-weight: var(--fw-strong);
  }
  @media (max-width: 899px) {
    :host {
      display: block;
      overflow: auto;
    }
    .left,
    .right {
      display: block;
    }
    .panel {
      margin-bottom: 6px;
    }
    .start rave-run-control {
      min-height: 260px;
    }
    .name,
    th.seed,
    td.seed {
      display: none;
    }
  }
`;
