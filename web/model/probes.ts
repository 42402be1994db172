// SPDX-License-Identifier: Apache-2.0
import type {
  Catalogue,
  ProbeMade,
  Probes as ProbesMessage,
  ProbeRequest,
  Sensor,
  VirtualSensor,
} from '../protocol/messages';
import {kFirstProbe} from '../protocol/frames';
import {Signal} from './signal';

/** Virtual sensors that are tried: which there are, and those that this page tries at present. */
export class Probes {
  /** Null: not asked for yet. */
  drivers: readonly VirtualSensor[] | null = null;
  readonly changed = new Signal();
  /** Number of the newest request; answers to older ones count no more. */
  private request = 0;
  private readonly requests = new Map<object, ProbeRequest>();
  private made: readonly ProbeMade[] = [];

  takeCatalogue(message: Catalogue): void {
    this.drivers = message.drivers;
    this.changed.emit();
  }

  take(message: ProbesMessage): void {
    if (message.request !== this.request) return;
    this.made = message.probes;
    this.changed.emit();
  }

  /** What `owner` tries from now on; null: nothing. False: that is what it tries already. */
  ask(owner: object, request: ProbeRequest | null): boolean {
    const before = this.requests.get(owner);
    if (request === null) this.requests.delete(owner);
    else this.requests.set(owner, request);
    return JSON.stringify(before ?? null) !== JSON.stringify(request);
  }

  /** All of the page, under a new number. */
  next(): {request: number; probes: ProbeRequest[]} {
    this.made = [];
    return {request: ++this.request, probes: [...this.requests.values()].slice(0, 4)};
  }

  /** What became of the request of `owner`; null: not known yet. */
  of(owner: object): ProbeMade | null {
    return this.made[this.placeOf(owner)] ?? null;
  }

  /** The number of a sensor with which the readings for `owner` come. */
  indexOf(owner: object): number {
    return kFirstProbe + this.placeOf(owner);
  }

  /** The sensor behind a number; undefined: it is none of a probe. */
  sensor(index: number): Sensor | undefined {
    return this.made[index - kFirstProbe]?.sensor;
  }

  private placeOf(owner: object): number {
    return [...this.requests.keys()].indexOf(owner);
  }

  /** Another run, or the same with other rights: the server has forgotten them. */
  clear(): void {
    this.drivers = null;
    this.made = [];
    this.changed.emit();
  }
}
