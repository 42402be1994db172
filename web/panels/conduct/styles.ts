// SPDX-License-Identifier: Apache-2.0
import {css} from 'lit';

/** What the start page and the run control share. */
export const conductStyles = css`
  .bar {
    display: flex;
    flex-wrap: wrap;
    align-items: center;
    gap: 8px;
    padding: 8px 14px;
    flex: none;
  }
  .main,
  .plain {
    display: inline-flex;
    align-items: center;
    justify-content: center;
    gap: 6px;
    min-height: 28px;
    padding: 0 12px;
    border-radius: var(--r-3);
  }
  .main {
    background: var(--intent-fill);
    color: #fff;
    font-weight: var(--fw-medium);
  }
  .plain {
    border: 1px solid var(--line-2);
    background: var(--bg-1);
  }
  .plain:hover:not(:disabled) {
    background: var(--bg-3);
  }
  .plain.bad {
    color: var(--danger);
  }
  .note.bad {
    color: var(--danger);
  }
  .state {
    padding: 1px 8px;
    border-radius: var(--r-2);
    background: var(--bg-3);
    color: var(--text-2);
  }
  .state.running,
  .state.passed {
    background: var(--ok-soft);
    color: var(--ok);
  }
  .state.starting,
  .state.ending,
  .state.broke_off {
    background: var(--warn-soft);
    color: var(--warn);
  }
  .state.failed {
    background: var(--danger-soft);
    color: var(--danger);
  }
  code {
    font: 400 var(--fs-12) var(--font-code);
    overflow-wrap: anywhere;
  }
  @media (pointer: coarse) {
    .main,
    .plain,
    .field {
      min-height: 44px;
    }
  }
`;
