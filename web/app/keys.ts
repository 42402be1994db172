// SPDX-License-Identifier: Apache-2.0

/** What a key does, for the sheet that `?` shows. */
export interface KeyAction {
  keys: string[];
  what: string;
  act(event: KeyboardEvent): void;
  /** The key was lifted; only of keys that are held. */
  end?(): void;
}

function nameOf(event: KeyboardEvent): string {
  const key =
    event.key === ' ' ? 'Space' : event.key.length === 1 ? event.key.toUpperCase() : event.key;
  return (
    (event.ctrlKey ? 'Ctrl ' : '') +
    (event.shiftKey && key.startsWith('Arrow') ? 'Shift ' : '') +
    key
  );
}

/** `Shift 1`, whatever the layout of the keyboard writes then. */
function digitOf(event: KeyboardEvent): string {
  const digit = /^Digit(\d)$/.exec(event.code)?.[1];
  return event.shiftKey && digit !== undefined ? `Shift ${digit}` : '';
}

/** The keys of panels, in their order: 1 to 9, 0, Shift 1 to 9. */
export function panelKey(index: number): string[] {
  if (index < 10) return [String((index + 1) % 10)];
  return index < 19 ? [`Shift ${index - 9}`] : [];
}

/** Calls the action of a key, but never while text is typed; Space on a control presses that. */
export function bindKeys(actions: () => readonly KeyAction[], where: Document = document): void {
  where.addEventListener('keydown', (event) => {
    const target = event.composedPath()[0] as HTMLElement;
    const typing = target.matches?.(
      'input:not([type=checkbox]), textarea, select, [contenteditable]',
    );
    if (
      event.defaultPrevented ||
      event.altKey ||
      event.metaKey ||
      (typing && event.key !== 'Escape')
    )
      return;
    const name = nameOf(event);
    if (
      name === 'Space' &&
      target.matches?.('button, a, input, [role=button], [role=option], [role=slider]')
    )
      return;
    const all = actions();
    const digit = digitOf(event);
    const action =
      all.find((known) => known.keys.includes(name)) ??
      all.find((known) => known.keys.includes(digit));
    if (action === undefined) return;
    event.preventDefault();
    action.act(event);
  });
  where.addEventListener('keyup', (event) => {
    // Shift may be lifted first: what is held ends all the same.
    const name = nameOf(event).replace('Shift ', '');
    actions()
      .find((known) => known.end && known.keys.some((key) => key.replace('Shift ', '') === name))
      ?.end?.();
  });
}
