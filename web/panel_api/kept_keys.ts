// SPDX-License-Identifier: Apache-2.0

/** Under which name the browser keeps something of a user. Several people may use one browser, and
 * each finds their own. */
export function userKey(what: string, user: string): string {
  return `rave.${what}.${user}`;
}

/** Each named layout is kept for each user and class of widths; without a layout: which of them was
 * the last. */
export function layoutKey({user, width_px}: {user: string; width_px: number}, layout = ''): string {
  const width = width_px >= 1280 ? 'wide' : width_px >= 900 ? 'middle' : 'narrow';
  return `${userKey('layout', user)}.${width}${layout === '' ? '' : `.${layout}`}`;
}
