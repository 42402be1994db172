// SPDX-License-Identifier: Apache-2.0
import {css, html, nothing, type TemplateResult} from 'lit';
import {stateOf} from '../panels/robots/robot_state';
import '../panels/sensors/glance';
import {icon} from '../ui/icons';
import {LiveElement} from '../ui/live_element';
import {controls, glyphs} from '../ui/styles';

type Height = 'peek' | 'half' | 'full';
const kHeights: readonly Height[] = ['peek', 'half', 'full'];
/** A drag of this number of pixels leads to the next height. */
const kDrag_px = 40;
const kRefresh_ms = 250;

/** On a phone: the selected robot, below the World View, whose scale stays in sight. */
export class Sheet extends LiveElement {
  private height: Height = 'peek';
  private pressedY: number | null = null;

  protected override listen(): (() => void)[] {
    const {model, selection, palette} = this.context;
    return [
      ...this.renderAfter(selection.changed, palette.changed, model.rosterChanged),
      this.every(kRefresh_ms, () => this.requestUpdate()),
    ];
  }

  private go(steps: number): void {
    const next = kHeights.indexOf(this.height) + steps;
    if (next < 0) this.context.selection.set([]);
    else this.height = kHeights[Math.min(next, kHeights.length - 1)];
    this.requestUpdate();
  }

  private lift(event: PointerEvent): void {
    const begin = this.pressedY;
    this.pressedY = null;
    if (begin === null) return;
    const moved = begin - event.clientY;
    if (Math.abs(moved) > kDrag_px) this.go(moved > 0 ? 1 : -1);
  }

  override render(): TemplateResult | typeof nothing {
    const {model, selection, palette} = this.context;
    const slot = selection.primary;
    const robot = slot === null ? undefined : model.robots[slot];
    if (slot === null || robot === undefined) return nothing;
    const hue = palette.hue(slot);
    const frame = model.poses.newest;
    const speed = Math.abs(frame?.speed[slot] ?? 0).toFixed(2);
    const state = stateOf(robot, frame?.flags[slot] ?? 0);
    const about = [robot.kind + (robot.recorded ? ', recorded' : ''), robot.program]
      .filter(Boolean)
      .join(' · ');
    const glance = this.height === 'peek';
    return html`<section class=${this.height} aria-label="Selected robot">
      <div
        class="grip"
        @pointerdown=${(event: PointerEvent) => {
          this.pressedY = event.clientY;
          (event.currentTarget as HTMLElement).setPointerCapture(event.pointerId);
        }}
        @pointerup=${this.lift}
        @pointercancel=${this.lift}>
        <i></i>
        <div class="head">
          <span
            class="glyph ${robot.kind}"
            style="--hue:${robot.kind === 'real' ? hue.fill : hue.ink}"></span>
          <span class="who"
            ><b style="color:${hue.ink}">${robot.name}</b
            ><small>${state === '' ? about : state}</small></span
          >
          ${glance ? nothing : html`<span class="speed"><b>${speed}</b> m/s</span>`}
        </div>
      </div>
      <button class="more" aria-expanded=${!glance} @click=${() => this.go(glance ? 1 : -1)}>
        ${icon('activity', 18)} ${glance ? 'Sensors' : 'Less'}
      </button>
      ${glance
        ? html`<rave-glance .context=${this.context}></rave-glance>`
        : html`<rave-sensors
            ?compact=${this.height === 'half'}
            embedded
            .context=${this.context}></rave-sensors>`}
    </section>`;
  }

  static override styles = [
    controls,
    glyphs,
    css`
      :host {
        flex: none;
        z-index: 5;
      }
      section {
        position: relative;
        display: flex;
        flex-direction: column;
        background: var(--bg-1);
        border-top: 1px solid var(--line-2);
        border-radius: var(--r-6) var(--r-6) 0 0;
        box-shadow: var(--shadow-pop);
      }
      section.half {
        height: min(46dvh, 400px);
      }
      section.full {
        height: 68dvh;
      }
      .grip {
        flex: none;
        padding: 8px 128px 10px 16px;
        touch-action: none;
        cursor: grab;
      }
      .grip > i {
        position: absolute;
        left: calc(50% - 19px);
        top: 7px;
        width: 38px;
        height: 4px;
        border-radius: 2px;
        background: var(--line-3);
      }
      .head {
        display: flex;
        align-items: center;
        gap: 12px;
        min-height: 52px;
        padding-top: 6px;
      }
      .glyph {
        transform: scale(1.25);
      }
      .glyph.simulated {
        transform: rotate(45deg) scale(1.25);
      }
      .who {
        flex: 1;
        min-width: 0;
        display: flex;
        flex-direction: column;
      }
      .who b {
        font-size: 17px;
        font-weight: var(--fw-strong);
        line-height: 1.25;
      }
      .who small {
        color: var(--text-2);
        font-size: 12.5px;
        white-space: nowrap;
        overflow: hidden;
        text-overflow: ellipsis;
      }
      .speed {
        color: var(--text-2);
        font-size: 12.5px;
        white-space: nowrap;
      }
      .speed b {
        color: var(--text-1);
        font-size: var(--fs-15);
      }
      .more {
        position: absolute;
        right: 14px;
        top: 17px;
        display: flex;
        align-items: center;
        gap: 8px;
        height: 44px;
        padding: 0 14px;
        border-radius: var(--r-4);
        background: var(--bg-3);
        font-weight: var(--fw-medium);
      }
      rave-sensors {
        flex: 1;
        min-height: 0;
      }
    `,
  ];
}

customElements.define('rave-sheet', Sheet);
