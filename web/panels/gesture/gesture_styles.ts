// SPDX-License-Identifier: Apache-2.0
import {css} from 'lit';

export const gestureStyles = css`
  :host {
    position: relative;
    display: block;
    flex: none;
    height: 0;
    z-index: 5;
  }
  .row {
    position: absolute;
    left: 10px;
    bottom: 10px;
    display: flex;
    align-items: flex-end;
    gap: 8px;
  }
  .key {
    display: flex;
    flex-direction: column;
    align-items: center;
    justify-content: center;
    gap: 2px;
    width: 76px;
    height: 76px;
    border: 2px solid var(--intent);
    border-radius: 50%;
    background: var(--bg-1);
    color: var(--text-1);
    font-size: 12.5px;
    font-weight: var(--fw-medium);
    touch-action: none;
    user-select: none;
    -webkit-user-select: none;
  }
  .key[aria-pressed='true'] {
    background: var(--intent-fill);
    color: #fff;
    outline: 3px solid var(--intent);
    outline-offset: 3px;
  }
  .teach,
  .lesson,
  .forget,
  .send,
  .cancel {
    min-height: 48px;
    padding: 0 12px;
    border: 1px solid var(--line-3);
    border-radius: var(--r-4);
    background: var(--bg-2);
    color: var(--text-1);
    font-size: 13px;
  }
  .paper {
    position: fixed;
    touch-action: none;
    cursor: crosshair;
  }
  .paper svg {
    width: 100%;
    height: 100%;
    pointer-events: none;
  }
  polyline {
    fill: none;
    stroke: var(--intent);
    stroke-width: 4px;
    stroke-linecap: round;
    stroke-linejoin: round;
  }
  .card {
    position: absolute;
    left: 10px;
    right: 10px;
    bottom: 96px;
    display: flex;
    flex-direction: column;
    gap: 8px;
    padding: 12px;
    border: 1px solid var(--intent);
    border-radius: var(--r-4);
    background: var(--bg-1);
    box-shadow: var(--shadow-pop);
    font-size: 13px;
  }
  .card:not(:has(button)) {
    pointer-events: none;
  }
  .card p {
    margin: 0;
  }
  .proposal {
    display: grid;
    gap: 6px;
  }
  .proposal b {
    font-size: 16px;
  }
  .card small {
    color: var(--text-2);
    font-size: 12.5px;
  }
  .send {
    display: flex;
    align-items: center;
    justify-content: center;
    gap: 8px;
    border-color: var(--intent-fill);
    background: var(--intent-fill);
    color: #fff;
  }
  .send:disabled {
    opacity: 0.5;
  }
  .cancel {
    display: flex;
    align-items: center;
    justify-content: center;
    gap: 8px;
  }
  ul {
    display: grid;
    grid-template-columns: repeat(3, 1fr);
    gap: 6px;
    margin: 0;
    padding: 0;
    list-style: none;
  }
  li {
    color: var(--text-2);
  }
  .lessons {
    display: grid;
    grid-template-columns: 1fr auto 1fr auto;
    gap: 6px;
  }
  .lesson[aria-pressed='true'] {
    background: var(--intent-fill);
    color: #fff;
  }
  .lesson i {
    font-style: normal;
    opacity: 0.75;
  }
  .forget {
    width: 48px;
    padding: 0;
  }
`;
