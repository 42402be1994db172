// SPDX-License-Identifier: Apache-2.0

/** Calls those who listen. Listeners are called in the order in which they came. */
export class Signal<T = void> {
  private readonly listeners = new Set<(value: T) => void>();

  /** Returns the function that ends the listening. */
  on(listener: (value: T) => void): () => void {
    this.listeners.add(listener);
    return () => this.listeners.delete(listener);
  }

  emit(value: T): void {
    for (const listener of [...this.listeners]) listener(value);
  }
}
