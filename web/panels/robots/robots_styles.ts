// SPDX-License-Identifier: Apache-2.0
import {css} from 'lit';

export const robotsStyles = css`
  :host {
    display: flex;
    flex-direction: column;
    height: 100%;
    background: var(--bg-1);
    container-type: size;
  }
  @container (max-height: 460px) {
    .detail {
      display: none;
    }
  }
  .field {
    margin: 10px 12px 8px;
  }
  .kinds {
    display: flex;
    align-items: center;
    gap: 6px;
    padding: 0 12px 8px;
    border-bottom: 1px solid var(--line-1);
  }
  .kinds em {
    font-style: normal;
    color: var(--text-3);
    font-size: var(--fs-11);
  }
  .rows {
    flex: 1;
    overflow: auto;
    padding: 4px 0;
  }
  .team {
    display: flex;
    align-items: center;
    gap: 6px;
    width: 100%;
    height: 26px;
    padding: 0 12px;
    color: var(--text-2);
    font-size: var(--fs-12);
    text-align: left;
  }
  .team.many {
    height: 40px;
  }
  .head {
    display: flex;
    align-items: center;
  }
  .head .team {
    flex: 1;
    min-width: 0;
  }
  .head:has(.halt) {
    margin: 4px 0;
  }
  /* Histogram and mean need the width: the button stands below them, under the name. */
  .head.many {
    flex-wrap: wrap;
  }
  .head.many .team {
    flex-basis: 100%;
  }
  .head.many .halt {
    margin: 0 0 4px 31px;
  }
  .halt {
    display: inline-flex;
    align-items: center;
    gap: 5px;
    flex: none;
    height: 24px;
    margin: 0 12px 0 8px;
    padding: 0 10px;
    white-space: nowrap;
    border-radius: var(--r-2);
    background: linear-gradient(var(--danger-soft) 0 0), var(--bg-1);
    color: var(--danger);
    font-size: var(--fs-12);
  }
  .halt:disabled {
    opacity: 1;
    background: none;
    color: var(--text-2);
  }
  @media (pointer: coarse) {
    .halt {
      height: 40px;
      border-radius: var(--r-3);
    }
    .team:not(.many) {
      height: 44px;
    }
  }
  .who {
    display: flex;
    flex-direction: column;
    line-height: 1.3;
  }
  .who small {
    color: var(--text-3);
    font-size: var(--fs-11);
  }
  .heads {
    display: flex;
    justify-content: space-between;
    padding: 6px 12px 0;
    color: var(--text-3);
    font-size: var(--fs-11);
  }
  .team em {
    font-style: normal;
    color: var(--text-3);
  }
  .team rect {
    fill: var(--text-2);
  }
  .turn {
    transform: rotate(-90deg);
  }
  .turn.open {
    transform: none;
  }
  .row {
    display: flex;
    align-items: center;
    gap: 10px;
    height: var(--h-row);
    padding: 0 12px 0 14px;
    border-left: 3px solid transparent;
    font-size: var(--fs-12);
    cursor: pointer;
  }
  .row:hover,
  .row.hovered {
    background: var(--bg-2);
  }
  .row.selected {
    background: var(--intent-soft);
    border-left-color: var(--intent);
  }
  .name {
    flex: 1 0 min(8ch, 40%);
    min-width: 0;
    overflow: hidden;
    text-overflow: ellipsis;
    white-space: nowrap;
  }
  .value {
    color: var(--text-2);
    white-space: nowrap;
  }
  .state {
    flex: 0 1 auto;
    min-width: 0;
    overflow: hidden;
    color: var(--warn);
    text-overflow: ellipsis;
    white-space: nowrap;
  }
  /* What is left of a row is for the name. */
  @container (max-width: 260px) {
    .row svg.spark,
    .kinds em {
      display: none;
    }
  }
  .driver {
    display: grid;
    place-items: center;
    width: 20px;
    height: 20px;
    border-radius: 50%;
    background: var(--person-fill);
    color: var(--on-fill);
    font-size: 10px;
    font-weight: 600;
    flex: none;
  }
  .driver.you {
    background: var(--intent-fill);
    color: #fff;
  }
  .mark {
    width: 14px;
    color: var(--text-3);
  }
  .mark svg {
    color: inherit;
  }
  .none {
    margin: 12px;
    color: var(--text-3);
    font-size: var(--fs-12);
  }
  .detail {
    border-top: 1px solid var(--line-1);
    padding: 10px 14px 12px;
    font-size: var(--fs-12);
    max-height: 45%;
    overflow: auto;
  }
  h3 {
    display: flex;
    align-items: center;
    gap: 8px;
    margin: 0 0 8px;
    font-size: var(--fs-13);
  }
  dl {
    display: grid;
    grid-template-columns: 72px 1fr;
    gap: 4px 8px;
    margin: 0;
  }
  dt {
    color: var(--text-3);
  }
  dd {
    margin: 0;
    overflow-wrap: anywhere;
  }
  dd em {
    font-style: normal;
    color: var(--text-3);
  }
  @media (pointer: coarse) {
    .row {
      height: 44px;
    }
  }
`;
