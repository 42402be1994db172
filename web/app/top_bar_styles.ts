// SPDX-License-Identifier: Apache-2.0
import {css} from 'lit';

export const topBarStyles = css`
  :host {
    display: flex;
    align-items: center;
    gap: 10px;
    height: var(--h-topbar);
    flex: none;
    padding: 0 14px;
  }
  .brand {
    display: flex;
    align-items: center;
    gap: 8px;
    letter-spacing: 0.04em;
  }
  .rule {
    width: 1px;
    height: 20px;
    background: var(--line-2);
  }
  h1 {
    margin: 0;
    font-size: var(--fs-15);
    font-weight: var(--fw-strong);
    flex: none;
    max-width: 34vw;
    white-space: nowrap;
    overflow: hidden;
    text-overflow: ellipsis;
  }
  .state {
    display: inline-flex;
    align-items: center;
    gap: 6px;
    height: 22px;
    padding: 0 10px;
    border-radius: var(--r-full);
    font-size: var(--fs-12);
    background: linear-gradient(var(--soft, var(--ok-soft)) 0 0), var(--bg-1);
    color: var(--ok);
    white-space: nowrap;
  }
  .state i {
    width: 7px;
    height: 7px;
    border-radius: 50%;
    background: currentColor;
  }
  .state.replay {
    --soft: var(--intent-soft);
    color: var(--intent);
  }
  .state.waits {
    --soft: var(--warn-soft);
    color: var(--warn);
  }
  .state.lost {
    --soft: var(--danger-soft);
    color: var(--danger);
  }
  .state.opening {
    --soft: var(--bg-2);
    color: var(--text-2);
  }
  .about {
    color: var(--text-2);
    font-size: var(--fs-12);
    white-space: nowrap;
  }
  .find {
    display: flex;
    align-items: center;
    gap: 8px;
    flex: 0 1 300px;
    min-width: 40px;
    height: 30px;
    padding: 0 8px;
    border: 1px solid var(--line-2);
    border-radius: var(--r-3);
    background: var(--bg-1);
    color: var(--text-3);
    font-size: var(--fs-12);
    overflow: hidden;
  }
  .find span {
    flex: 1;
    text-align: left;
    white-space: nowrap;
    overflow: hidden;
    text-overflow: ellipsis;
  }
  kbd {
    padding: 0 6px;
    border: 1px solid var(--line-2);
    border-radius: var(--r-2);
    background: var(--bg-2);
    color: var(--text-2);
    font: 500 var(--fs-11) var(--font-ui);
    white-space: nowrap;
  }
  .rate em {
    font-style: normal;
    color: var(--text-3);
  }
  .rate.slow {
    background: linear-gradient(var(--warn-soft) 0 0), var(--bg-1);
    color: var(--warn);
  }
  .rate.slow em {
    color: inherit;
  }
  .person {
    display: flex;
    align-items: center;
    gap: 8px;
    font-size: var(--fs-12);
    white-space: nowrap;
  }
  .people {
    display: flex;
    align-items: center;
    height: var(--h-control);
    padding-left: 4px;
    border-radius: var(--r-full);
  }
  button.people:hover {
    background: var(--bg-3);
  }
  .pen {
    display: none;
  }
  @media (max-width: 599px) and (max-height: 700px) {
    .pen {
      display: flex;
      align-items: center;
    }
    rave-clock {
      margin-right: 8px;
      font-weight: var(--fw-strong);
      font-variant-numeric: tabular-nums;
    }
    .find,
    .person {
      display: none !important;
    }
  }
  .face {
    display: grid;
    place-items: center;
    width: 24px;
    height: 24px;
    border-radius: 50%;
    background: var(--person-fill);
    color: var(--on-fill);
    font-style: normal;
    font-size: 10px;
    font-weight: 600;
  }
  .face.you {
    background: var(--intent-fill);
    color: #fff;
  }
  .people .face {
    margin-left: -3px;
    box-shadow: 0 0 0 1.5px var(--bg-0);
  }
  .people .rest {
    background: var(--bg-1);
    color: var(--text-2);
  }
  @media (max-width: 1279px) {
    .about,
    .rate em,
    .wide,
    .find kbd,
    .person span {
      display: none;
    }
  }
  @media (max-width: 1099px) {
    .brand b,
    .find span {
      display: none;
    }
    .find {
      flex: none;
      justify-content: center;
    }
  }
  @media (max-width: 899px) and (min-width: 600px) {
    .rate,
    .brand + .rule,
    .segments + .icon-button {
      display: none;
    }
  }
  @media (max-width: 800px) {
    .people,
    .rule {
      display: none;
    }
  }
  @media (max-width: 700px) {
    h1 {
      flex: 0 1 auto;
    }
  }
  @media (max-width: 599px) {
    :host {
      padding: 0 10px;
      height: 52px;
    }
    .brand b,
    .find span,
    .find kbd,
    .rate {
      display: none;
    }
    .find svg {
      width: 20px;
      height: 20px;
    }
    .find {
      flex: none;
      width: 40px;
      height: 40px;
      justify-content: center;
      background: none;
      border-color: transparent;
    }
    .theme,
    .foxglove,
    rave-bell {
      display: none;
    }
    .space ~ .space {
      display: none;
    }
    h1 {
      max-width: 46vw;
    }
    .state {
      order: 1;
    }
    .find {
      order: 2;
    }
    .person {
      order: 3;
    }
  }
`;
