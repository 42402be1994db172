// SPDX-License-Identifier: Apache-2.0
import {LitElement} from 'lit';
import type {Signal} from '../model/signal';
import type {PanelContext} from '../panel_api';

type End = () => void;

/** An element that shows something of the run. It listens while it is in the page and leaves
 * nothing behind when it goes. */
export abstract class LiveElement extends LitElement {
  declare context: PanelContext;
  private ends: readonly End[] = [];

  /** Called when the element comes into the page. Returns what ends the listening. */
  protected abstract listen(): readonly End[];

  /** Renders anew after each of these. */
  protected renderAfter(...signals: readonly Signal[]): End[] {
    return signals.map((signal) => signal.on(() => this.requestUpdate()));
  }

  protected every(period_ms: number, act: () => void): End {
    const timer = window.setInterval(act, period_ms);
    return () => clearInterval(timer);
  }

  override connectedCallback(): void {
    super.connectedCallback();
    // The dock takes panels out while they are hidden: what came meanwhile is to be shown.
    this.requestUpdate();
    this.ends = this.listen();
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    for (const end of this.ends) end();
    this.ends = [];
  }
}
