// SPDX-License-Identifier: Apache-2.0
import {LitElement, css, html, svg, type TemplateResult} from 'lit';
import {icon, type IconName} from '../../../ui/icons';
import {controls} from '../../../ui/styles';

/** One of the six sectors, clockwise from the one upwards. */
export interface Sector {
  id: 'goal' | 'path' | 'drive' | 'stop' | 'say' | 'follow';
  label: string;
  icon: IconName;
  /** Why it is of no use; empty if it is. */
  why: string;
}

const kInner = 34;
const kOuter = 104;
export const kRing_px = 2 * kOuter;

/** Six things to do with a robot, about the place that was pressed for long or with the right
 * button. */
export class RingMenu extends LitElement {
  declare sectors: readonly Sector[];
  declare name: string;
  static override properties = {sectors: {attribute: false}, name: {}};

  override firstUpdated(): void {
    this.renderRoot
      .querySelector<HTMLElement>('button:not([disabled])')
      ?.focus({preventScroll: true});
  }

  /** Where the press that opened the menu ends is no choice: a choice begins in the menu, or is
   * made by a key. */
  private begun = false;

  private press(event: MouseEvent, sector: Sector | null): void {
    if (this.begun || event.detail === 0) this.choose(sector);
  }

  private choose(sector: Sector | null): void {
    this.dispatchEvent(new CustomEvent('choose', {detail: sector?.id ?? null}));
  }

  private key(event: KeyboardEvent): void {
    const buttons = [
      ...this.renderRoot.querySelectorAll<HTMLButtonElement>('button.sector:not([disabled])'),
    ];
    const at = buttons.indexOf((this.renderRoot as ShadowRoot).activeElement as HTMLButtonElement);
    if (event.key === 'Escape') this.choose(null);
    else if (event.key === 'ArrowRight' || event.key === 'ArrowDown')
      buttons[(at + 1) % buttons.length]?.focus();
    else if (event.key === 'ArrowLeft' || event.key === 'ArrowUp')
      buttons[(at + buttons.length - 1) % buttons.length]?.focus();
    else return;
    event.preventDefault();
    event.stopPropagation();
  }

  override render(): TemplateResult {
    return html`<div class="shade" @pointerdown=${() => this.choose(null)}></div>
      <span class="name">${this.name}</span>
      <div
        class="ring"
        role="menu"
        aria-label="Orders for ${this.name}"
        @pointerdown=${() => {
          this.begun = true;
        }}
        @keydown=${this.key}>
        <svg viewBox="${-kOuter} ${-kOuter} ${kRing_px} ${kRing_px}" aria-hidden="true">
          ${this.sectors.map(
            (sector, i) =>
              svg`<path class="${sector.id} ${sector.why === '' ? '' : 'off'}" d=${wedge(i)} />`,
          )}
        </svg>
        ${this.sectors.map((sector, i) => {
          const a = (i * Math.PI) / 3;
          return html`<button
            class="sector ${sector.id}"
            role="menuitem"
            ?disabled=${sector.why !== ''}
            title=${sector.why || sector.label}
            style="left:${kOuter + 70 * Math.sin(a)}px;top:${kOuter - 70 * Math.cos(a)}px"
            @click=${(event: MouseEvent) => this.press(event, sector)}>
            ${icon(sector.icon, 20)}${sector.label}
          </button>`;
        })}
        <button
          class="close"
          aria-label="Close"
          @click=${(event: MouseEvent) => this.press(event, null)}>
          ${icon('x', 18)}
        </button>
      </div>`;
  }

  static override styles = [
    controls,
    css`
      :host {
        position: absolute;
        z-index: 8;
        width: ${kRing_px}px;
        height: ${kRing_px}px;
        transform: translate(-50%, -50%);
      }
      .shade {
        position: fixed;
        inset: -200vh -200vw;
      }
      .name {
        position: absolute;
        left: 50%;
        top: -36px;
        transform: translateX(-50%);
        padding: 4px 18px;
        border-radius: var(--r-4);
        background: var(--text-1);
        color: var(--bg-1);
        font-weight: var(--fw-strong);
        white-space: nowrap;
      }
      .ring {
        position: absolute;
        inset: 0;
      }
      .ring > svg {
        position: absolute;
        inset: 0;
        width: 100%;
        height: 100%;
        filter: drop-shadow(0 6px 14px rgba(0, 0, 0, 0.3));
      }
      .ring > svg path {
        fill: var(--bg-1);
        stroke: var(--line-3);
        stroke-width: 1.5;
      }
      .ring > svg path.goal {
        fill: var(--intent-fill);
      }
      .ring > svg path.stop {
        fill: var(--stop-fill);
      }
      .ring > svg path.off {
        fill: var(--bg-3);
      }
      .sector {
        position: absolute;
        transform: translate(-50%, -50%);
        display: flex;
        flex-direction: column;
        align-items: center;
        justify-content: center;
        gap: 3px;
        width: 58px;
        height: 52px;
        font-weight: var(--fw-medium);
        font-size: 12.5px;
        color: var(--text-1);
      }
      .sector.goal:not(:disabled),
      .sector.stop:not(:disabled) {
        color: #fff;
      }
      .sector:disabled {
        opacity: 1;
        color: var(--text-3);
      }
      .close {
        position: absolute;
        left: 50%;
        top: 50%;
        width: 56px;
        height: 56px;
        transform: translate(-50%, -50%);
        display: grid;
        place-items: center;
        border: 3px solid var(--intent);
        border-radius: 50%;
        background: var(--bg-1);
      }
    `,
  ];
}

function wedge(i: number): string {
  const [a, b] = [((i - 0.5) * Math.PI) / 3 + 0.03, ((i + 0.5) * Math.PI) / 3 - 0.03];
  const at = (r: number, angle: number) =>
    `${(r * Math.sin(angle)).toFixed(2)} ${(-r * Math.cos(angle)).toFixed(2)}`;
  const outer = kOuter - 2;
  const rim = `L ${at(outer, a)} A ${outer} ${outer} 0 0 1 ${at(outer, b)}`;
  const hole = `L ${at(kInner, b)} A ${kInner} ${kInner} 0 0 0 ${at(kInner, a)}`;
  return `M ${at(kInner, a)} ${rim} ${hole} Z`;
}

customElements.define('rave-ring', RingMenu);
