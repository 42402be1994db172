// SPDX-License-Identifier: Apache-2.0
import {css, html, nothing, type TemplateResult} from 'lit';
import type {PanelElement} from '../panel_api';
import type {LoadedComponent} from './component_loader';
import {icon} from '../ui/icons';
import {LiveElement} from '../ui/live_element';
import {controls} from '../ui/styles';

/** A component with this number of failures within a minute stays off. */
const kMostFailures = 3;
const kMinute_ms = 60_000;

/** A panel of a component, or a box that says why it is not there. Nothing else of the page is
 * affected. */
export class ComponentPanelFrame extends LiveElement {
  loaded!: LoadedComponent;
  panelId = '';
  private error = '';
  private inner: PanelElement | null = null;
  private failures: number[] = [];

  protected override listen(): (() => void)[] {
    const fail = (event: ErrorEvent | PromiseRejectionEvent) => this.caught(event);
    window.addEventListener('error', fail);
    window.addEventListener('unhandledrejection', fail);
    this.fill();
    return [
      this.loaded.changed.on(() => this.fill()),
      () => window.removeEventListener('error', fail),
      () => window.removeEventListener('unhandledrejection', fail),
    ];
  }

  /** An error of the page that comes from the module of this component. */
  private caught(event: ErrorEvent | PromiseRejectionEvent): void {
    const error: unknown = event instanceof ErrorEvent ? event.error : event.reason;
    const stack = error instanceof Error ? (error.stack ?? '') : '';
    const file = event instanceof ErrorEvent ? event.filename : '';
    if (!this.loaded.wrote(`${file} ${stack}`)) return;
    event.preventDefault();
    this.stop(error);
  }

  private stop(error: unknown): void {
    this.inner?.remove();
    this.inner = null;
    this.error =
      error instanceof Error
        ? `${error.name}: ${error.message}\n${
            (error.stack ?? '')
              .split('\n')
              .find((line) => this.loaded.wrote(line))
              ?.trim() ?? ''
          }`
        : String(error);
    this.failures = [
      ...this.failures.filter((at) => performance.now() - at < kMinute_ms),
      performance.now(),
    ];
    this.requestUpdate();
  }

  private fill(): void {
    this.inner?.remove();
    this.inner = null;
    this.error = this.loaded.error;
    const make = this.loaded.makers.get(this.panelId);
    if (this.error === '' && make !== undefined) {
      try {
        const element = make();
        element.context = this.context;
        element.style.height = '100%';
        this.inner = element;
        this.append(element);
      } catch (error) {
        this.stop(error);
      }
    }
    this.requestUpdate();
  }

  override render(): TemplateResult {
    if (this.error === '') return html`<slot></slot>`;
    const {name, version} = this.loaded;
    const off = this.failures.length >= kMostFailures;
    return html`<div class="box" role="alert">
      <h3>${icon('packageX', 18)} This panel stopped</h3>
      <p>
        ${name}${version === '' ? '' : ` ${version}`} threw an error. Nothing else is
        affected.${off ? ' It failed three times in a minute and stays off.' : ''}
      </p>
      <pre>${this.error}</pre>
      <div>
        ${off
          ? nothing
          : html`<button class="main" @click=${() => void this.loaded.load()}>
              ${icon('rotateCcw', 14)} Load again
            </button>`}
        <button
          @click=${() => void navigator.clipboard?.writeText(`${name} ${version}\n${this.error}`)}>
          Copy report
        </button>
      </div>
    </div>`;
  }

  static override styles = [
    controls,
    css`
      :host {
        display: block;
        height: 100%;
        background: var(--bg-1);
        overflow: auto;
      }
      .box {
        padding: 18px;
        font-size: var(--fs-13);
      }
      h3 {
        display: flex;
        align-items: center;
        gap: 8px;
        margin: 0 0 6px;
        color: var(--danger);
        font-size: var(--fs-13);
      }
      p {
        margin: 0 0 10px;
        color: var(--text-2);
      }
      pre {
        margin: 0 0 12px;
        padding: 10px;
        border-radius: var(--r-3);
        background: var(--bg-2);
        font: var(--fs-12) var(--font-code);
        white-space: pre-wrap;
        overflow-wrap: anywhere;
      }
      .box > div {
        display: flex;
        gap: 8px;
      }
      .box button {
        display: inline-flex;
        align-items: center;
        gap: 6px;
        height: var(--h-control);
        padding: 0 12px;
        border-radius: var(--r-3);
        background: var(--bg-3);
      }
    `,
  ];
}

customElements.define('rave-component', ComponentPanelFrame);
