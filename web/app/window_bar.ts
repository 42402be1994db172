// SPDX-License-Identifier: Apache-2.0
import {css, html, nothing, type TemplateResult} from 'lit';
import {bigClock} from '../ui/clock';
import {icon} from '../ui/icons';
import {LiveElement} from '../ui/live_element';
import {nowOf} from '../model/moment';
import './stop_button';
import {controls} from '../ui/styles';

const kRefresh_ms = 100;

/** Below the panels of a window of its own: the run, its clock, whether the link holds, and
 * STOP. */
export class WindowBar extends LiveElement {
  protected override listen(): (() => void)[] {
    return [this.every(kRefresh_ms, () => this.requestUpdate())];
  }

  override render(): TemplateResult {
    const {model, link} = this.context;
    const lost = link.state === 'lost';
    const gone_s = ((performance.now() - link.lostAt_ms) / 1000).toFixed(1);
    return html`<b>${model.hello?.run.name ?? ''}</b
      ><span class="clock">${bigClock(nowOf(model))}</span>
      ${lost
        ? html`<span class="lost" role="alert"
            >${icon('wifiOff', 16)} Link lost ${gone_s} s ago</span
          >`
        : nothing}
      <i></i>${model.live ? html`<rave-stop .context=${this.context}></rave-stop>` : nothing}`;
  }

  static override styles = [
    controls,
    css`
      :host {
        position: fixed;
        inset: auto 0 0 0;
        display: flex;
        align-items: center;
        gap: 14px;
        height: var(--h-window-bar);
        padding: 0 10px 0 16px;
        background: var(--bg-1);
        border-top: 1px solid var(--line-1);
      }
      b {
        white-space: nowrap;
        overflow: hidden;
        text-overflow: ellipsis;
      }
      i {
        flex: 1;
      }
      .clock {
        font-size: var(--fs-15);
      }
      .lost {
        display: flex;
        align-items: center;
        gap: 6px;
        color: var(--danger);
        white-space: nowrap;
      }
    `,
  ];
}

customElements.define('rave-window-bar', WindowBar);
