// SPDX-License-Identifier: Apache-2.0
import {css, html, nothing, type TemplateResult} from 'lit';
import {RobotFlag} from '../protocol/frames';
import type {Tool} from '../panels/world/orders/order_desk';
import '../panels/lease_bar';
import {icon, type IconName} from '../ui/icons';
import {LiveElement} from '../ui/live_element';
import {controls} from '../ui/styles';

/** In the hand: what can be asked of the selected robot, in the order that it has everywhere. */
export class RobotBar extends LiveElement {
  static override properties = {tool: {}, driving: {type: Boolean}};
  declare tool: Tool;
  declare driving: boolean;
  private leasing = false;

  protected override listen(): (() => void)[] {
    const {model, selection, link} = this.context;
    let shown = '';
    return [
      ...this.renderAfter(
        model.rosterChanged,
        model.drivesChanged,
        model.runChanged,
        selection.changed,
        link.changed,
      ),
      selection.changed.on(() => selection.primary === null && this.lease(false)),
      model.pictureChanged.on(() => {
        const now = String(this.stopped);
        if (now !== shown) this.requestUpdate();
        shown = now;
      }),
    ];
  }

  private get stopped(): boolean {
    const {selection, model} = this.context;
    return (
      selection.primary !== null &&
      ((model.poses.newest?.flags[selection.primary] ?? 0) & RobotFlag.stopped) !== 0
    );
  }

  private lease(open: boolean): void {
    this.leasing = open;
    this.requestUpdate();
  }

  private choose(tool: Tool): void {
    this.lease(false);
    this.dispatchEvent(new CustomEvent('tool', {detail: this.tool === tool ? 'select' : tool}));
  }

  private halt(): void {
    const {selection, model, link} = this.context;
    const slots = selection.slots.filter((slot) => model.stops(slot));
    link.send({type: 'halt', do: this.stopped && model.may('release') ? 'release' : 'stop', slots});
  }

  override render(): TemplateResult {
    const {model, selection} = this.context;
    const slot = selection.primary;
    if (slot === null)
      return html`<p role="status">
        ${icon('pointer', 18)}<span
          >Tap a robot: goal, path, drive, stop it, lease.<small
            >A finger held on it opens its menu.</small
          ></span
        >
      </p>`;
    const drive = model.drives.get(slot);
    const path = model.whyNotTaken(slot, 'path');
    const release = this.stopped && model.may('release');
    return html`<div
        class="buttons"
        role="toolbar"
        aria-label="Orders for ${model.robots[slot]?.name}">
        ${renderButton(
          'Goal',
          'target',
          model.whyNotTaken(slot, 'goal'),
          this.tool === 'goal',
          () => this.choose('goal'),
        )}
        ${renderButton('Path', 'route', path, this.tool === 'path', () => this.choose('path'))}
        ${renderButton('Drive', 'joystick', model.whyNotTaken(slot, 'drive'), this.driving, () => {
          this.lease(false);
          this.dispatchEvent(new CustomEvent('drive'));
        })}
        ${renderButton(
          release ? 'Release it' : 'Stop it',
          release ? 'play' : 'octagonX',
          model.live ? model.whyNotStopped(slot) : 'This is a recording.',
          null,
          () => this.halt(),
          'stop',
        )}
        ${renderButton(
          'Lease',
          'hand',
          '',
          this.leasing,
          () => this.lease(!this.leasing),
          drive?.yours === true ? 'mine' : '',
        )}
      </div>
      ${this.leasing
        ? html`<div class="card">
            <rave-lease .context=${this.context} .robot=${slot}></rave-lease>
          </div>`
        : nothing}`;
  }

  static override styles = [
    controls,
    css`
      :host {
        position: relative;
        display: block;
        flex: none;
        padding: 7px 10px;
        background: var(--bg-1);
        border-top: 1px solid var(--line-2);
      }
      .buttons {
        display: flex;
        gap: 6px;
      }
      .buttons button {
        display: flex;
        flex: 1;
        flex-direction: column;
        align-items: center;
        justify-content: center;
        gap: 4px;
        min-width: 0;
        height: 58px;
        border: 1px solid var(--line-3);
        border-radius: var(--r-4);
        background: var(--bg-2);
        color: var(--text-1);
        font-size: 12.5px;
        font-weight: var(--fw-medium);
        white-space: nowrap;
      }
      .buttons button[aria-pressed='true'] {
        background: var(--intent-fill);
        border-color: var(--intent-fill);
        color: #fff;
      }
      .buttons .stop {
        border-color: var(--danger);
        color: var(--danger);
      }
      .buttons .mine {
        border-color: var(--intent);
        color: var(--intent);
      }
      p {
        display: flex;
        align-items: center;
        gap: 12px;
        height: 58px;
        margin: 0;
        padding: 0 6px;
        color: var(--text-2);
      }
      p svg {
        color: var(--intent);
      }
      small {
        display: block;
        color: var(--text-3);
        font-size: 12.5px;
      }
      .card {
        position: absolute;
        left: 10px;
        right: 10px;
        bottom: calc(100% + 8px);
        z-index: 6;
        border-radius: var(--r-3);
        background: var(--bg-1);
        box-shadow: var(--shadow-pop);
      }
    `,
  ];
}

function renderButton(
  label: string,
  glyph: IconName,
  why: string,
  pressed: boolean | null,
  act: () => void,
  look = '',
): TemplateResult {
  return html` <button
    class=${look}
    aria-pressed=${pressed ?? nothing}
    ?disabled=${why !== ''}
    title=${why}
    @click=${act}>
    ${icon(glyph, 20)}<span>${label}</span>
  </button>`;
}

customElements.define('rave-robot-bar', RobotBar);
