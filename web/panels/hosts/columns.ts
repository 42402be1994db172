// SPDX-License-Identifier: Apache-2.0
import type {Host} from '../../protocol/messages';
import {shortTime} from './rates';

/** A column of figures. */
export interface Column {
  heading: string;
  title: string;
  /** The width of the panel from which it is shown, pixels: a class of the panel's style sheet. */
  from: 0 | 560 | 680 | 820 | 980 | 1140;
  text(host: Host): string;
  tone?(host: Host): 'care' | 'zero' | '';
}

/** More missed deadlines deserve a look, percent; as in `rave top`. */
const kMostMissed_pct = 5;

const time = (seconds: number | null | undefined) =>
  seconds === null || seconds === undefined ? '' : shortTime(seconds);
const count = (value: number | undefined): 'care' | 'zero' => ((value ?? 0) > 0 ? 'care' : 'zero');

/** Sign, offset and its bound in the unit of the larger one. */
export function clockText(offset_s: number | undefined, bound_s: number | undefined): string {
  if (offset_s === undefined || bound_s === undefined) return '';
  const size = Math.max(Math.abs(offset_s), bound_s);
  const [unit, factor] = size >= 1 ? ['s', 1] : size >= 1e-3 ? ['ms', 1e3] : ['µs', 1e6];
  const [offset, bound] = [Math.abs(offset_s), bound_s].map((of) => (of * factor).toFixed(2));
  return `${offset_s < 0 ? '−' : '+'}${offset}±${bound} ${unit}`;
}

/** The share of missed deadlines, and what took the time. */
export function missedText(host: Host): string {
  if (host.missed_pct === undefined) return '';
  const share = host.missed_pct.toFixed(host.missed_pct < 10 ? 1 : 0);
  return `${share} %${host.late_phase ? ` ${host.late_phase}` : ''}`;
}

/** The columns of `rave top` behind its steps, in its order. */
export const kColumns: readonly Column[] = [
  {
    heading: 'Age',
    title: 'Age of the newest pose; in lock-step, of the step',
    from: 680,
    text: (host) => time(host.age_s),
  },
  {
    heading: 'Delay',
    title: 'From the host to here, by the clocks of both machines',
    from: 0,
    text: (host) => time(host.delay_s),
  },
  {
    heading: 'Trip',
    title: 'To the manager and back',
    from: 1140,
    text: (host) => time(host.trip_s),
  },
  {
    heading: 'Clock',
    title: 'Clock of the manager minus that of the host',
    from: 980,
    text: (host) => clockText(host.clock_s, host.clock_bound_s),
  },
  {
    heading: 'CPU',
    title: 'Share of one core',
    from: 0,
    text: (host) => (host.cpu === null ? '' : `${Math.round(100 * host.cpu)} %`),
  },
  {
    heading: 'Lost',
    title: 'Lost messages',
    from: 0,
    text: (host) => `${host.lost}`,
    tone: (host) => count(host.lost),
  },
  {
    heading: 'Refused',
    title: 'Samples that it refused',
    from: 980,
    text: (host) => `${host.refused ?? ''}`,
    tone: (host) => count(host.refused),
  },
  {
    heading: 'Late',
    title: 'Missed deadlines, and the phase that takes the time',
    from: 560,
    text: missedText,
    tone: (host) => ((host.missed_pct ?? 0) > kMostMissed_pct ? 'care' : ''),
  },
  {
    heading: 'Memory',
    title: 'Resident memory',
    from: 820,
    text: (host) => (host.memory_mb === undefined ? '' : `${Math.round(host.memory_mb)} MB`),
  },
  {
    heading: 'PID',
    title: 'Number of the process on its machine',
    from: 1140,
    text: (host) => `${host.pid ?? ''}`,
  },
];

/** Whether a host has all words of the filter in its name, machine, state or phase. */
export function matches(host: Host, filter: string): boolean {
  const all = `${host.name} ${host.machine} ${host.state} ${host.late_phase ?? ''}`.toLowerCase();
  return filter
    .toLowerCase()
    .split(/\s+/)
    .every((word) => all.includes(word));
}
