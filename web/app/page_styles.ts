// SPDX-License-Identifier: Apache-2.0
import {css} from 'lit';

export const pageStyles = css`
  :host {
    display: flex !important;
    flex-direction: column;
    height: 100%;
    background: var(--bg-0);
  }
  main {
    position: relative;
    flex: 1;
    min-height: 0;
    padding: 0 6px 6px;
  }
  /* What is old has no colour. The stick still drives over a direct line. */
  main.old .phone,
  main.old rave-sheet {
    filter: grayscale(1) opacity(0.55);
  }
  .dock {
    height: 100%;
  }
  rave-run-bar {
    flex: none;
    margin: 0 6px 6px;
  }
  @media (max-width: 599px) {
    main {
      display: flex;
      flex-direction: column;
      padding: 0;
    }
    rave-run-bar {
      margin: 0;
    }
  }
`;
