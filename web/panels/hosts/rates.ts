// SPDX-License-Identifier: Apache-2.0
import type {Host} from '../../protocol/messages';

const kKept = 40;

/** The steps per second of each host in the last messages, for its small plot. */
export class Rates {
  private readonly kept = new Map<string, number[]>();

  add(hosts: readonly Host[]): void {
    for (const host of hosts) {
      const rates = this.kept.get(host.name) ?? [];
      rates.push(host.steps_per_s);
      if (rates.length > kKept) rates.shift();
      this.kept.set(host.name, rates);
    }
  }

  /** Points of a polyline in a box of `width` by `height`; newest at the right. */
  points(name: string, width: number, height: number): string {
    const rates = this.kept.get(name) ?? [];
    const top = Math.max(...rates, 1);
    return rates
      .map((rate, i) => [
        width * (1 - (rates.length - 1 - i) / (kKept - 1)),
        1 + (height - 2) * (1 - rate / top),
      ])
      .map(([x, y]) => `${x.toFixed(1)},${y.toFixed(1)}`)
      .join(' ');
  }
}

/** Seconds as `278 µs`, `4.1 ms`, `2.9 s`. */
export function shortTime(seconds: number): string {
  if (seconds < 1e-3) return `${Math.round(seconds * 1e6)} µs`;
  if (seconds < 1) return `${Number((seconds * 1e3).toPrecision(2))} ms`;
  return `${seconds.toFixed(1)} s`;
}
