// SPDX-License-Identifier: Apache-2.0

/** Seconds of a run as `05.20`, `1:07.04` or `1:02:03`. */
export function clockText(time_s: number): string {
  const sign = time_s < 0 ? '−' : '';
  const total = Math.abs(time_s);
  const seconds = (total % 60).toFixed(2).padStart(5, '0');
  const minutes = Math.floor(total / 60) % 60;
  const hours = Math.floor(total / 3600);
  if (hours > 0)
    return `${sign}${hours}:${String(minutes).padStart(2, '0')}:${seconds.slice(0, 2)}`;
  return minutes > 0 ? `${sign}${minutes}:${seconds}` : `${sign}${seconds}`;
}

/** The same as the clock of the run bar shows it: `00:17.50` or `1:02:03`. */
export function bigClock(time_s: number): string {
  // In hundredths, so that no second has sixty of them.
  const hundredths = Math.round(100 * time_s);
  const two = (value: number) => String(Math.floor(value)).padStart(2, '0');
  const minutes = Math.floor(hundredths / 6000);
  const seconds = (hundredths % 6000) / 100;
  if (minutes >= 60) return `${Math.floor(minutes / 60)}:${two(minutes % 60)}:${two(seconds)}`;
  return `${two(minutes)}:${seconds.toFixed(2).padStart(5, '0')}`;
}

/** The same without hundredths: `00:17`, `1:02:03`. */
export function shortClock(time_s: number): string {
  return bigClock(time_s).replace(/\.\d+$/, '');
}

/** A tick of the timeline: `0`, `30 s`, `1:30`, `1:02:00`. */
export function tickClock(time_s: number): string {
  if (time_s === 0) return '0';
  if (time_s < 60) return `${Number(time_s.toFixed(1))} s`;
  const seconds = Math.round(time_s);
  if (seconds >= 3600) return bigClock(seconds);
  return `${Math.floor(seconds / 60)}:${String(seconds % 60).padStart(2, '0')}`;
}
