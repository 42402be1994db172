// SPDX-License-Identifier: Apache-2.0
import type {PanelContext} from '../panel_api';
import './window_bar';
import type {WindowBar} from './window_bar';

/** A window that panels were moved to: dressed as the page is, with its keys and STOP. Ends with
 * the window. */
export class PanelWindow {
  private readonly ends: (() => void)[] = [];

  constructor(
    private readonly view: Window,
    private readonly context: PanelContext,
    bindKeys: (document: Document) => void,
  ) {
    const {document: there} = view;
    // The dock links the sheets of the page and copies their rules as well. These ask for fonts
    // beside the document, which is why that one is beside the sheets.
    for (const copy of there.head.querySelectorAll('style')) copy.remove();
    // Made here: the other window knows none of the elements of the page.
    const bar = document.createElement('rave-window-bar') as WindowBar;
    bar.context = context;
    there.body.append(bar);
    bindKeys(there);
    const {model, link, palette, windows} = context;
    this.ends.push(
      palette.changed.on(() => this.dress()),
      model.runChanged.on(() => this.dress()),
      link.changed.on(() => this.dress()),
      windows.add(view),
    );
    // A window that is killed or reloaded gives no other sign, and its panels are to come back.
    view.addEventListener('pagehide', () => {
      if (this.ends.length > 0) view.dispatchEvent(new Event('beforeunload'));
      this.end();
    });
    this.dress();
  }

  private dress(): void {
    const {documentElement: there, body} = this.view.document;
    Object.assign(there.dataset, document.documentElement.dataset);
    there.classList.add('panel-window');
    body.classList.toggle('old', this.context.link.state === 'lost');
    body.classList.toggle('live', this.context.model.live);
  }

  /** What the window is called where windows are listed. */
  entitle(panel: string): void {
    this.view.document.title = `${panel} · ${this.context.model.hello?.run.name ?? 'RAVE'}`;
  }

  get open(): boolean {
    return this.ends.length > 0;
  }

  private end(): void {
    for (const end of this.ends.splice(0)) end();
  }
}
