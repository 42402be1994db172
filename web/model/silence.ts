// SPDX-License-Identifier: Apache-2.0

/** What has come in but was not taken yet, since the page was busy or its timers were held back, is
 * taken within so long. */
const kChance_ms = 500;

/** Notices that a line says nothing any more: TCP does not tell when a network is gone or the other
 * side stands still. */
export class SilenceWatch {
  /** performance.now() of the last message. */
  heardAt_ms = 0;

  private limit_ms = 0;
  private timer: ReturnType<typeof setTimeout> | undefined;
  private messages = 0;

  constructor(private readonly silent: () => void) {}

  /** A message came, or is waited for from now on. Without another one for `limit_ms` the line is
   * silent. */
  heard(limit_ms: number): void {
    this.heardAt_ms = performance.now();
    ++this.messages;
    if (this.timer !== undefined && limit_ms === this.limit_ms) return;
    this.limit_ms = limit_ms;
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.look(), limit_ms);
  }

  end(): void {
    clearTimeout(this.timer);
    this.timer = undefined;
  }

  /** A timer that comes late proves nothing: only the messages count, those first that are waiting
   * to be taken. */
  private look(): void {
    const rest_ms = this.heardAt_ms + this.limit_ms - performance.now();
    if (rest_ms > 0) {
      this.timer = setTimeout(() => this.look(), rest_ms);
      return;
    }
    const before = this.messages;
    this.timer = setTimeout(() => {
      if (this.messages !== before) return this.look();
      this.end();
      this.silent();
    }, kChance_ms);
  }
}
