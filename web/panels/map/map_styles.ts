// SPDX-License-Identifier: Apache-2.0
import {css} from 'lit';

export const mapStyles = css`
  :host {
    display: flex;
    flex-direction: column;
    height: 100%;
    background: var(--bg-1);
    overflow: hidden;
    container-type: inline-size;
  }
  .head {
    display: flex;
    flex-wrap: wrap;
    align-items: center;
    gap: 4px 10px;
    flex: none;
    padding: 6px 10px;
    border-bottom: 1px solid var(--line-1);
    font-size: var(--fs-12);
    color: var(--text-2);
  }
  .blend {
    display: inline-flex;
    align-items: center;
    gap: 10px;
    margin-left: auto;
    white-space: nowrap;
  }
  .source {
    position: relative;
    display: inline-flex;
    align-items: center;
    gap: 8px;
    height: var(--h-control);
    padding: 0 8px 0 10px;
    border-radius: var(--r-3);
    background: var(--bg-2);
    color: var(--text-1);
    max-width: 100%;
    min-width: 0;
  }
  .source select {
    appearance: none;
    border: 0;
    background: none;
    color: inherit;
    font: inherit;
    font-weight: var(--fw-medium);
    padding: 4px 22px 4px 0;
    margin-right: -22px;
    cursor: pointer;
    min-width: 0;
    max-width: 220px;
    text-overflow: ellipsis;
  }
  .source option,
  .source optgroup {
    background: var(--bg-2);
    color: var(--text-1);
  }
  .source svg {
    pointer-events: none;
    color: var(--text-2);
  }
  .source:focus-within {
    outline: 2px solid var(--intent);
    outline-offset: 1px;
  }
  .source select:focus-visible {
    outline: 0;
  }
  .about {
    white-space: nowrap;
  }
  .over {
    display: inline-flex;
    align-items: center;
    gap: 6px;
    cursor: pointer;
    white-space: nowrap;
  }
  input {
    accent-color: var(--intent-fill);
  }
  .opacity {
    width: 84px;
  }
  .opacity:disabled {
    opacity: 0.45;
  }
  output {
    min-width: 36px;
    color: var(--text-1);
    text-align: right;
  }
  .stage {
    position: relative;
    flex: 1;
    min-height: 0;
  }
  canvas {
    position: absolute;
    inset: 0;
    width: 100%;
    height: 100%;
    touch-action: none;
    cursor: grab;
  }
  canvas:active {
    cursor: grabbing;
  }
  canvas:focus-visible {
    outline-offset: -2px;
  }
  .legend {
    position: absolute;
    left: 10px;
    bottom: 10px;
    display: flex;
    gap: 14px;
    padding: 5px 10px;
    border: 1px solid var(--line-1);
    border-radius: var(--r-3);
    background: var(--bg-2);
    color: var(--text-2);
    font-size: var(--fs-11);
    pointer-events: none;
  }
  .legend span {
    display: inline-flex;
    align-items: center;
    gap: 6px;
  }
  .legend i {
    width: 11px;
    height: 11px;
    border-radius: 2px;
    border: 1px solid var(--line-2);
    background: var(--floor);
  }
  .legend .free {
    background: color-mix(in srgb, var(--text-3) 20%, var(--floor));
  }
  .legend .occupied {
    background: var(--wall);
    border-color: var(--wall);
  }
  .zoom {
    position: absolute;
    right: 10px;
    top: 10px;
    display: flex;
    flex-direction: column;
    padding: 2px;
    border: 1px solid var(--line-1);
    border-radius: var(--r-4);
    background: var(--bg-2);
  }
  .waits {
    position: absolute;
    left: 50%;
    top: 45%;
    transform: translate(-50%, -50%);
    width: max-content;
    max-width: 80%;
    margin: 0;
    padding: 8px 14px;
    border-radius: var(--r-3);
    background: var(--bg-2);
    color: var(--text-2);
    font-size: var(--fs-12);
    text-align: center;
  }
  .none {
    display: flex;
    gap: 8px;
    margin: 12px 14px;
    color: var(--text-3);
    font-size: var(--fs-12);
  }
  @media (pointer: coarse) {
    .zoom .icon-button {
      width: 44px;
      height: 44px;
    }
    .source select {
      min-height: 40px;
    }
    .over {
      min-height: 40px;
    }
    .legend,
    .head {
      font-size: 12.5px;
    }
  }
`;
