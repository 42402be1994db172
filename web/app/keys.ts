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
  const key = event.key === ' ' ? 'Space' : event.key.length === 1 ? event.key.toUpperCase() : event.key;
  return (event.ctrlKey ? 'Ctrl ' : '') + (event.shiftKey && key.startsWith('Arrow') ? 'Shift ' : '') + key;
}

/** Calls the action of a key, but never while text is typed; Space on a control presses that. */
export function bindKeys(actions: () => readonly KeyAction[]): void {
  document.addEventListener('keydown', (event) => {
    const target = event.composedPath()[0] as HTMLElement;
    const typing = target.matches?.('input:not([type=checkbox]), textarea, select, [contenteditable]');
    if (event.defaultPrevented || event.altKey || event.metaKey || (typing && event.key !== 'Escape')) return;
    const name = nameOf(event);
    if (name === 'Space' && target.matches?.('button, a, input, [role=button], [role=option], [role=slider]')) return;
    const action = actions().find((known) => known.keys.includes(name));
    if (action === undefined) return;
    event.preventDefault();
    action.act(event);
  });
  document.addEventListener('keyup', (event) => {
    // Shift may be lifted first: what is held ends all the same.
    const name = nameOf(event).replace('Shift ', '');
    actions().find((known) => known.end && known.keys.some((key) => key.replace('Shift ', '') === name))?.end?.();
  });
}
