// SPDX-License-Identifier: Apache-2.0
import {userKey} from './kept_keys';
import {Signal} from '../model/signal';

/** What panels keep in the browser: apart for each user and each layout, as the arrangement of the
 * panels is. */
export class Kept {
  private user = '';
  private layout = '';
  /** The user or the layout of the page changed: read() may return other values from now on. */
  readonly changed = new Signal();

  /** `layout`: empty where there are no layouts, as on a phone. */
  belongTo(user: string, layout: string): void {
    if (user === this.user && layout === this.layout) return;
    [this.user, this.layout] = [user, layout];
    this.changed.emit();
  }

  /** What was written under this name; null: nothing, or nothing that can be read. */
  read(what: string): unknown {
    try {
      return JSON.parse(localStorage.getItem(this.key(what)) ?? 'null');
    } catch {
      return null;
    }
  }

  /** Keeps a value of JSON. Until the user is known nothing is kept: it would belong to no user. */
  write(what: string, value: unknown): void {
    if (this.user !== '') localStorage.setItem(this.key(what), JSON.stringify(value));
  }

  private key(what: string): string {
    return `${userKey(what, this.user)}${this.layout === '' ? '' : `.${this.layout}`}`;
  }
}
