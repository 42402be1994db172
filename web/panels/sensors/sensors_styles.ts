// SPDX-License-Identifier: Apache-2.0
import {css} from 'lit';

export const sensorsStyles = css`
  :host {
    display: flex;
    flex-direction: column;
    height: 100%;
    background: var(--bg-1);
    overflow: hidden;
  }
  .head,
  .about {
    display: flex;
    align-items: center;
    gap: 8px;
    padding: 8px 12px 0;
    flex-wrap: wrap;
  }
  .about {
    color: var(--text-2);
    font-size: var(--fs-12);
    padding-top: 4px;
    flex-wrap: nowrap;
    white-space: nowrap;
    overflow: hidden;
  }
  .old {
    color: var(--stale-ink);
  }
  :host([embedded]) .head > :is(.glyph, b, .icon-button, .space),
  :host([compact]) :is(.course, .fields) {
    display: none;
  }
  .tag {
    display: inline-flex;
    align-items: center;
    gap: 6px;
    padding: 1px 8px;
    border-radius: var(--r-2);
    background: var(--virtual-fill);
    color: var(--virtual-ink);
  }
  .polar {
    flex: 1 1 160px;
    min-height: 100px;
    width: 100%;
  }
  .sightings {
    flex: 1 1 180px;
    min-height: 120px;
    width: 100%;
  }
  .halves {
    display: flex;
    flex-wrap: wrap;
    gap: 4px 14px;
    margin: 6px 12px 0;
    color: var(--text-2);
    font-size: var(--fs-11);
  }
  .halves span {
    display: inline-flex;
    align-items: center;
    gap: 6px;
  }
  .halves em {
    color: var(--text-3);
    font-style: normal;
  }
  .halves .dot {
    width: 6px;
    height: 6px;
    border-radius: 50%;
    background: var(--wall-ink);
  }
  .halves .saw {
    background: var(--text-1);
  }
  .halves .square {
    width: 7px;
    height: 7px;
    border: 1.5px solid var(--virtual-ink);
  }
  .halves .line {
    width: 14px;
    height: 0;
    border-top: 1.5px solid var(--wall-ink);
  }
`;
