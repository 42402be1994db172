// SPDX-License-Identifier: Apache-2.0
import {expect, it} from 'vitest';
import {Windows} from './windows';

/** As much of a window as is listened to. */
function view(): {window: Window; show(state: string): void} {
  const document = Object.assign(new EventTarget(), {visibilityState: 'visible'});
  return {
    window: Object.assign(new EventTarget(), {document}) as unknown as Window,
    show(state) {
      document.visibilityState = state;
      document.dispatchEvent(new Event('visibilitychange'));
    },
  };
}

it('is seen as long as one window is', () => {
  const [page, other] = [view(), view()];
  const windows = new Windows(page.window);
  const out = windows.add(other.window);
  page.show('hidden');
  expect(windows.visible).toBe(other.window);
  out();
  expect(windows.visible).toBeUndefined();
  page.show('visible');
  expect(windows.visible).toBe(page.window);
});

it('tells of each window that a person leaves, until it is taken out', () => {
  const [page, other] = [view(), view()];
  const windows = new Windows(page.window);
  const out = windows.add(other.window);
  let left = 0;
  windows.left.on(() => ++left);
  page.window.dispatchEvent(new Event('blur'));
  other.show('hidden');
  other.window.dispatchEvent(new Event('pagehide'));
  expect(left).toBe(3);
  out();
  expect(left).toBe(4);
  other.window.dispatchEvent(new Event('blur'));
  expect(left).toBe(4);
});
