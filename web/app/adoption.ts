// SPDX-License-Identifier: Apache-2.0
// Elements that move to another window keep their styles. A style sheet that was made by a script
// belongs to one document: browsers take it from an element that goes to another one, and refuse it
// there. Imported first, since a class is asked for its adoptedCallback only when it is defined.
import {ReactiveElement, adoptStyles, type CSSResultOrNative} from 'lit';

type Sheets = Map<CSSResultOrNative, CSSStyleSheet>;
type Dressed = {
  shadowRoot: ShadowRoot | null;
  ownerDocument: Document;
  constructor: typeof ReactiveElement;
};

/** One copy of each sheet for each window, however many elements share it. */
const copies = new WeakMap<Document, Sheets>();

function copyOf(
  style: CSSResultOrNative,
  view: Window & typeof globalThis,
  known: Sheets,
): CSSStyleSheet {
  let sheet = known.get(style);
  if (sheet === undefined) {
    sheet = new view.CSSStyleSheet();
    sheet.replaceSync(
      'cssText' in style
        ? style.cssText
        : [...style.cssRules].map((rule) => rule.cssText).join('\n'),
    );
    known.set(style, sheet);
  }
  return sheet;
}

function dress(root: ShadowRoot, styles: readonly CSSResultOrNative[]): void {
  const view = root.ownerDocument.defaultView;
  if (view === null || root.ownerDocument === document) return adoptStyles(root, [...styles]);
  let known = copies.get(root.ownerDocument);
  if (known === undefined) copies.set(root.ownerDocument, (known = new Map()));
  const sheets = known;
  root.adoptedStyleSheets = styles.map((style) =>
    copyOf(style, view as Window & typeof globalThis, sheets),
  );
}

const prototype = ReactiveElement.prototype as unknown as {
  createRenderRoot(): ShadowRoot;
  adoptedCallback(): void;
};
prototype.createRenderRoot = function (this: HTMLElement): ShadowRoot {
  const type = (this as unknown as Dressed).constructor;
  const root = this.shadowRoot ?? this.attachShadow(type.shadowRootOptions);
  dress(root, type.elementStyles);
  return root;
};
prototype.adoptedCallback = function (this: HTMLElement): void {
  if (this.shadowRoot !== null)
    dress(this.shadowRoot, (this as unknown as Dressed).constructor.elementStyles);
};
