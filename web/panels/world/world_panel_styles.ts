// SPDX-License-Identifier: Apache-2.0
import {css} from 'lit';

/** The legend lies over the world, so that neither it nor the tools lose their words. */
const overWorld = css`
  position: absolute;
  left: 34px;
  top: 62px;
  z-index: 3;
  max-width: calc(100% - 44px);
  padding: 0 4px;
  gap: 0;
  background: var(--bg-2);
  border: 1px solid var(--line-1);
  border-radius: var(--r-full);
`;

/** The bar, the canvas and the note of the World View, on wide and small screens. */
export const worldPanelStyles = css`
  :host {
    display: flex;
    flex-direction: column;
    height: 100%;
    background: var(--bg-1);
    position: relative;
  }
  .bar {
    display: flex;
    align-items: center;
    gap: 2px;
    height: 40px;
    flex: none;
    padding: 0 10px;
    border-bottom: 1px solid var(--line-1);
    overflow: hidden;
  }
  .rule {
    width: 1px;
    height: 18px;
    margin: 0 8px;
    background: var(--line-2);
    flex: none;
  }
  .segments {
    flex: none;
  }
  .tools {
    display: flex;
    gap: 2px;
    flex: none;
  }
  .colour-by {
    display: flex;
    align-items: center;
    gap: 8px;
    margin-right: 6px;
    color: var(--text-3);
    font-size: var(--fs-12);
    white-space: nowrap;
  }
  :host {
    container-type: inline-size;
  }
  @container (max-width: 960px) {
    .colour-by {
      display: none;
    }
  }
  .mode {
    display: none;
    font-weight: var(--fw-medium);
    font-size: var(--fs-12);
  }
  @container (min-width: 521px) and (max-width: 1150px) {
    .order-tools ~ .legend {
      ${overWorld}
    }
    .order-tools + .rule {
      display: none;
    }
    .bar:has(.order-tools) ~ .stage .note {
      top: 62px;
    }
  }
  @container (min-width: 521px) and (max-width: 1420px) {
    .order-tools ~ .legend:has(~ .colour-by) {
      ${overWorld}
    }
    .order-tools + .rule:has(~ .colour-by) {
      display: none;
    }
    .bar:has(.order-tools ~ .colour-by) ~ .stage .note {
      top: 62px;
    }
  }
  @container (min-width: 521px) and (max-width: 680px) {
    .legend {
      ${overWorld}
    }
    .rule:not(:has(+ .order-tools)) {
      display: none;
    }
    .bar ~ .stage .note {
      top: 62px;
    }
  }
  @container (max-width: 700px) {
    .tool span {
      display: none;
    }
  }
  .stage {
    position: relative;
    flex: 1;
    min-height: 0;
  }
  .canvas {
    position: absolute;
    inset: 0;
    background: var(--floor);
  }
  /* The canvases lie over an outline of their own place. */
  .canvas:focus-visible {
    outline: none;
  }
  .canvas:focus-visible::after {
    content: '';
    position: absolute;
    inset: 0;
    z-index: 2;
    border: 2px solid var(--intent);
    pointer-events: none;
  }
  .said {
    position: absolute;
    width: 1px;
    height: 1px;
    overflow: hidden;
    clip-path: inset(50%);
    white-space: nowrap;
  }
  .stage-top,
  .stage-3d {
    position: absolute;
    inset: 0;
    touch-action: none;
    overflow: hidden;
  }
  canvas {
    position: absolute;
    inset: 0;
    width: 100%;
    height: 100%;
    display: block;
    pointer-events: none;
  }
  canvas[hidden] {
    display: none;
  }
  .note {
    position: absolute;
    left: 14px;
    top: 26px;
    display: flex;
    gap: 7px;
    align-items: center;
    height: 30px;
    padding: 0 12px;
    background: var(--bg-2);
    border: 1px solid var(--line-1);
    border-radius: var(--r-3);
    font-size: var(--fs-12);
    color: var(--text-2);
  }
  .note svg {
    color: var(--intent);
  }
  @container (max-width: 520px) {
    .kind i {
      display: none;
    }
    .kind {
      padding: 0 5px;
    }
    .bar {
      display: contents;
    }
    .segments,
    .rule,
    .space,
    .order-tools,
    .tools .ruler,
    .tools .maximize,
    .tools .camera {
      display: none;
    }
    .legend {
      position: absolute;
      left: 10px;
      top: 10px;
      z-index: 3;
      padding: 0 6px;
      background: var(--bg-2);
      border: 1px solid var(--line-1);
      border-radius: var(--r-full);
      gap: 0;
    }
    .tools {
      position: absolute;
      right: 10px;
      top: 10px;
      z-index: 3;
      flex-direction: column;
      padding: 2px;
      gap: 2px;
      background: var(--bg-2);
      border: 1px solid var(--line-1);
      border-radius: var(--r-4);
    }
    .tools .icon-button {
      width: 44px;
      height: 44px;
    }
    .tools svg {
      width: 19px;
      height: 19px;
    }
    .mode {
      display: inline-grid;
    }
    .menu {
      right: 64px;
      max-width: calc(100% - 76px);
    }
    .note {
      top: 48px;
      left: 10px;
    }
    :host([driving]) .legend,
    :host([driving]) .note {
      display: none;
    }
  }
`;
