// SPDX-License-Identifier: Apache-2.0
import {css, html, nothing, type TemplateResult} from 'lit';
import {icon} from '../ui/icons';
import {LiveElement} from '../ui/live_element';
import './stop_button';
import {controls} from '../ui/styles';

/** At the bottom of a small screen: the last message and STOP, large enough for a pen. */
export class PenBar extends LiveElement {
  /** Messages up to this number were read. */
  private read = 0;

  protected override listen(): (() => void)[] {
    const {model} = this.context;
    return [
      ...this.renderAfter(model.linesChanged, model.rosterChanged),
      this.every(1000, () => this.requestUpdate()),
    ];
  }

  override render(): TemplateResult {
    const {model, show} = this.context;
    const line = model.lines[model.lines.length - 1];
    const fresh = line !== undefined && line.number > this.read && !line.yours;
    const ago_s =
      line === undefined ? 0 : Math.max(0, (model.poses.newest?.time_s ?? line.t) - line.t);
    return html`<div class="said">
        ${fresh
          ? html`<button class="text" title=${line.text} @click=${() => show('chat')}>
                ${icon('message', 18)}
                <span
                  ><b>${line.from.name}</b> <small>${Math.floor(ago_s)} s ago</small
                  ><br />${line.text}</span
                >
              </button>
              <button
                class="ok"
                @click=${() => {
                  this.read = line.number;
                  this.requestUpdate();
                }}>
                OK
              </button>`
          : nothing}
      </div>
      <rave-stop pen .context=${this.context}></rave-stop>`;
  }

  static override styles = [
    controls,
    css`
      :host {
        display: flex;
        gap: 8px;
        flex: none;
        padding: 2px 8px 8px;
        background: var(--bg-1);
      }
      .said {
        display: flex;
        align-items: center;
        flex: 1;
        min-width: 0;
        height: 64px;
        padding: 0 8px;
        border-radius: var(--r-4);
        background: var(--bg-2);
      }
      .text {
        display: flex;
        align-items: center;
        gap: 10px;
        flex: 1;
        min-width: 0;
        text-align: left;
        font-size: 12.5px;
      }
      .text span {
        min-width: 0;
        overflow: hidden;
        text-overflow: ellipsis;
        white-space: nowrap;
      }
      small {
        color: var(--text-3);
        font-size: 12.5px;
      }
      .ok {
        width: 48px;
        height: 44px;
        flex: none;
        border: 1px solid var(--line-3);
        border-radius: var(--r-4);
        font-weight: var(--fw-medium);
      }
      rave-stop {
        flex: none;
      }
    `,
  ];
}

customElements.define('rave-pen-bar', PenBar);
