// SPDX-License-Identifier: Apache-2.0

/** Cividis from dark to light in steps that are equal to the eye, with and without colour
 * vision. */
const kCividis = [
  '#00224e',
  '#123570',
  '#3b496c',
  '#575d6d',
  '#707173',
  '#8a8678',
  '#a59c74',
  '#c3b369',
  '#e1cc55',
  '#fee838',
];
/** The darkest part would be lost on a dark floor, the lightest on a light one. */
const kFrom = {dark: 0.3, light: 0};
const kTo = {dark: 1, light: 0.85};

/** Colour of a share from 0 to 1 as red, green, blue in bytes. */
export function rampBytes(share: number, theme: 'dark' | 'light'): [number, number, number] {
  const at =
    (kFrom[theme] + Math.min(Math.max(share, 0), 1) * (kTo[theme] - kFrom[theme])) *
    (kCividis.length - 1);
  const i = Math.min(Math.floor(at), kCividis.length - 2);
  const a = bytesOf(kCividis[i]);
  const b = bytesOf(kCividis[i + 1]);
  const mix = (k: number) => Math.round(a[k] + (at - i) * (b[k] - a[k]));
  return [mix(0), mix(1), mix(2)];
}

export function rampColour(share: number, theme: 'dark' | 'light'): string {
  return `#${rampBytes(share, theme)
    .map((byte) => byte.toString(16).padStart(2, '0'))
    .join('')}`;
}

/** `#rrggbb` as bytes. */
export function bytesOf(colour: string): [number, number, number] {
  const value = Number.parseInt(colour.slice(1), 16);
  return [(value >> 16) & 255, (value >> 8) & 255, value & 255];
}
