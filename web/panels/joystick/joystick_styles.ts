// SPDX-License-Identifier: Apache-2.0
import {css} from 'lit';

export const joystickStyles = css`
  :host {
    display: flex;
    flex-direction: column;
    height: 100%;
    background: var(--bg-1);
    overflow: auto;
    container-type: size;
  }
  header {
    display: flex;
    align-items: center;
    gap: 8px;
    height: 42px;
    padding: 0 12px;
    flex: none;
  }
  header b {
    font-size: var(--fs-15);
    overflow: hidden;
    text-overflow: ellipsis;
    white-space: nowrap;
  }
  rave-lease {
    margin: 0 12px 4px;
    flex: none;
  }
  .sources {
    display: flex;
    gap: 2px;
    flex: none;
  }
  .source {
    display: grid;
    place-items: center;
    width: 24px;
    height: 24px;
    border-radius: 5px;
    color: var(--text-2);
  }
  .source.on {
    background: var(--intent-soft);
    color: var(--intent);
  }
  .source.off {
    color: var(--text-3);
    opacity: 0.5;
  }
  .middle {
    position: relative;
    flex: 1 0 150px;
  }
  .stick {
    position: absolute;
    inset: 6px 12px;
    margin: auto;
    height: min(100% - 12px, 260px);
    max-width: calc(100% - 24px);
    aspect-ratio: 1;
    touch-action: none;
    user-select: none;
    cursor: grab;
    border-radius: 50%;
  }
  .stick[aria-disabled='true'] {
    cursor: not-allowed;
  }
  .empty {
    display: grid;
    place-content: center;
    justify-items: center;
    gap: 4px;
    height: 100%;
    color: var(--text-3);
    font-size: var(--fs-12);
  }
`;
