// SPDX-License-Identifier: Apache-2.0
import {css, html, nothing, type TemplateResult} from 'lit';
import {foldSame} from '../panels/log/same_events';
import type {Event} from '../protocol/messages';
import {clockText} from '../ui/clock';
import {icon} from '../ui/icons';
import {LiveElement} from '../ui/live_element';
import {nowOf} from '../model/moment';
import {controls} from '../ui/styles';

const kShown = 8;

/** Warnings and alerts that have not been looked at yet. */
export class Bell extends LiveElement {
  private open = false;
  /** The number of alerts that have been looked at. */
  private seen = 0;
  private count = -1;
  private readonly outside = (event: globalThis.Event) => {
    if (this.open && !event.composedPath().includes(this)) this.toggle();
  };

  protected override listen(): (() => void)[] {
    const {model} = this.context;
    document.addEventListener('pointerdown', this.outside);
    return [
      model.runChanged.on(() => {
        this.seen = 0;
        this.requestUpdate();
      }),
      ...this.renderAfter(model.eventsChanged),
      model.pictureChanged.on(() => {
        // A replay tells only what has happened up to its moment.
        if (model.live || this.alerts().length === this.count) return;
        this.requestUpdate();
      }),
      () => document.removeEventListener('pointerdown', this.outside),
    ];
  }

  private alerts(): Event[] {
    const {model} = this.context;
    const now_s = model.live ? Infinity : nowOf(model);
    return foldSame(
      model.events.filter((event) => event.level !== 'info' && event.t <= now_s),
      model.robots.map((robot) => robot.name),
    );
  }

  private toggle(): void {
    this.open = !this.open;
    this.seen = this.alerts().length;
    this.requestUpdate();
  }

  private go(event: Event): void {
    this.context.selection.set(event.slots.slice(0, 2));
    this.context.seek(event.t);
    this.context.show('log');
    this.toggle();
  }

  override render(): TemplateResult {
    const alerts = this.alerts();
    this.count = alerts.length;
    const fresh = Math.max(0, alerts.length - this.seen);
    return html`<button
        class="icon-button"
        title="Alerts"
        aria-label=${fresh > 0 ? `Alerts, ${fresh} new` : 'Alerts'}
        aria-expanded=${this.open}
        @click=${() => this.toggle()}>
        ${icon('bell')}${fresh > 0 ? html`<i>${fresh > 99 ? '99+' : fresh}</i>` : nothing}
      </button>
      ${this.open
        ? html`<div
            class="pop"
            role="dialog"
            aria-label="Alerts"
            @keydown=${(event: KeyboardEvent) => {
              if (event.key === 'Escape') this.toggle();
            }}>
            ${alerts.length === 0 ? html`<p>No warnings, no faults.</p>` : nothing}
            ${alerts
              .slice(-kShown)
              .reverse()
              .map(
                (event) =>
                  html`<button class=${event.level} @click=${() => this.go(event)}>
                    <time>${clockText(event.t)}</time>${icon(
                      event.level === 'alert' ? 'circleX' : 'triangleAlert',
                      14,
                    )}<span>${event.text}</span> ${event.count > 1
                      ? html`<em>×${event.count}</em>`
                      : nothing}
                  </button>`,
              )}
            ${alerts.length > kShown
              ? html`<p>${alerts.length - kShown} more in the log.</p>`
              : nothing}
          </div>`
        : nothing}`;
  }

  static override styles = [
    controls,
    css`
      :host {
        position: relative;
        display: inline-block;
      }
      .icon-button {
        position: relative;
      }
      .icon-button i {
        position: absolute;
        right: -2px;
        top: -2px;
        min-width: 15px;
        height: 15px;
        padding: 0 4px;
        border-radius: 8px;
        background: var(--warn);
        color: var(--bg-1);
        font: 600 10px/15px var(--font-ui);
      }
      .pop {
        position: absolute;
        right: 0;
        top: 36px;
        z-index: 15;
        width: min(360px, 92vw);
        padding: 6px;
        background: var(--bg-2);
        border: 1px solid var(--line-2);
        border-radius: var(--r-4);
        box-shadow: var(--shadow-pop);
      }
      .pop button {
        display: grid;
        grid-template-columns: 52px 16px 1fr auto;
        gap: 6px;
        width: 100%;
        padding: 6px 8px;
        border-radius: var(--r-3);
        text-align: left;
        font-size: var(--fs-12);
      }
      .pop button:hover {
        background: var(--bg-3);
      }
      .pop time {
        text-align: right;
        color: var(--text-3);
      }
      .warn svg {
        color: var(--warn);
      }
      .alert svg {
        color: var(--danger);
      }
      em {
        font-style: normal;
        color: var(--text-2);
        font-size: var(--fs-11);
      }
      p {
        margin: 8px;
        color: var(--text-3);
        font-size: var(--fs-12);
      }
    `,
  ];
}

customElements.define('rave-bell', Bell);
