// SPDX-License-Identifier: Apache-2.0
import {html, type TemplateResult} from 'lit';
import {bigClock} from '../ui/clock';
import {LiveElement} from '../ui/live_element';
import {nowOf} from '../model/moment';

const kRefresh_ms = 100;

/** The time of the run, where the run bar does not show it. */
export class RunClock extends LiveElement {
  protected override listen(): (() => void)[] {
    return [this.every(kRefresh_ms, () => this.requestUpdate())];
  }

  override render(): TemplateResult {
    return html`${bigClock(nowOf(this.context.model))}`;
  }
}

customElements.define('rave-clock', RunClock);
