// SPDX-License-Identifier: Apache-2.0
import {css, html, svg, type TemplateResult} from 'lit';

const kRim = 88;
/** The middle of the knob goes no further. */
export const kReach = 66;
const kTicks = 24;

/** What the dial shows. */
export interface DialState {
  x: number;
  y: number;
  held: boolean;
  disabled: boolean;
  /** Share of full speed that the guard lets through; null: it does not act. */
  guard: number | null;
}

/** The upper third of a circle about the middle. */
function arcOf(radius: number): string {
  const [x, y] = [radius * 0.87, -radius * 0.5];
  return `M ${-x} ${y} A ${radius} ${radius} 0 0 1 ${x} ${y}`;
}

/** One stick: rim for the dead-man, knob, and an arc for the limit of the guard. */
export function renderDial(state: DialState): TemplateResult {
  const [kx, ky] = [state.x * kReach, -state.y * kReach];
  const arc = state.guard === null ? null : Math.max(0.1, Math.min(1, state.guard)) * kReach + 10;
  return html`<svg
    class="dial ${state.held ? 'held' : ''} ${state.disabled ? 'off' : ''}"
    viewBox="-104 -104 208 208"
    aria-hidden="true">
    <circle r="99" class="rim" />
    <circle r=${kRim} class="plate" />
    ${Array.from({length: kTicks}, (_, i) => {
      const a = (2 * Math.PI * i) / kTicks;
      const long = i % 6 === 0;
      const [x, y] = [Math.cos(a), Math.sin(a)];
      const from = long ? 76 : 81;
      return svg`<line x1=${x * from} y1=${y * from} x2=${x * 85} y2=${y * 85} class="tick" />`;
    })}
    ${arc === null ? '' : svg`<path class="guard" d=${arcOf(arc)} />`}
    <line x1="0" y1="0" x2=${kx} y2=${ky} class="arm" />
    <circle r="3" class="hub" />
    <g transform="translate(${kx} ${ky})">
      <circle r="25" class="knob" />
      <path class="grip" d="M-6 -5H6M-6 0H6M-6 5H6" />
    </g>
  </svg>`;
}

export const dialStyles = css`
  .dial {
    display: block;
    width: 100%;
    height: 100%;
  }
  .rim {
    fill: none;
    stroke: var(--bg-4);
    stroke-width: 3;
  }
  .held .rim {
    stroke: var(--intent);
  }
  .plate {
    fill: var(--bg-2);
    stroke: var(--line-2);
  }
  .tick {
    stroke: var(--line-3);
    stroke-width: 1;
  }
  .guard {
    fill: none;
    stroke: var(--warn);
    stroke-width: 2.5;
    stroke-dasharray: 5 4;
  }
  .arm {
    stroke: var(--intent);
    stroke-width: 3;
    opacity: 0;
  }
  .held .arm {
    opacity: 1;
  }
  .hub {
    fill: var(--text-3);
  }
  .knob {
    fill: var(--bg-4);
    stroke: var(--line-3);
    stroke-width: 1.5;
  }
  .held .knob {
    fill: var(--intent-fill);
    stroke: var(--intent);
  }
  .grip {
    fill: none;
    stroke: var(--text-2);
    stroke-width: 1.75;
    stroke-linecap: round;
  }
  .held .grip {
    stroke: #fff;
  }
  .dial.off {
    opacity: 0.4;
  }
`;
