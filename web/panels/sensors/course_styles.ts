// SPDX-License-Identifier: Apache-2.0
import {css, unsafeCSS} from 'lit';
import plotStyles from 'uplot/dist/uPlot.min.css?inline';

/** The plot over time and the choice of its field. */
export const courseStyles = css`
  ${unsafeCSS(plotStyles)}
  .course {
    flex: 0 1 110px;
    min-height: 72px;
    width: 100%;
    margin-top: 2px;
    overflow: hidden;
  }
  .course .u-cursor-x {
    border-color: var(--line-3);
  }
  .fields {
    display: flex;
    align-items: center;
    gap: 4px 10px;
    flex-wrap: wrap;
    margin: 6px 12px 0;
    font-size: var(--fs-11);
    color: var(--text-2);
  }
  .fields em {
    margin-left: auto;
    color: var(--text-3);
    font-style: normal;
    font-variant-numeric: tabular-nums;
  }
  .beam {
    display: inline-flex;
    align-items: center;
    gap: 6px;
  }
  .beam input {
    width: 84px;
    accent-color: var(--intent-fill);
  }
`;
