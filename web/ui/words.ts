// SPDX-License-Identifier: Apache-2.0
// How numbers, names and dates are said in the bars of the page.

export function sizeText(bytes: number): string {
  if (bytes < 1000) return `${bytes} B`;
  if (bytes < 1e6) return `${(bytes / 1e3).toFixed(0)} kB`;
  return bytes < 1e9 ? `${(bytes / 1e6).toFixed(1)} MB` : `${(bytes / 1e9).toFixed(2)} GB`;
}

/** ISO 8601 as `today 12:03` or `3 Aug 2026 12:03`. */
export function startedText(started: string): string {
  const date = new Date(started);
  if (Number.isNaN(date.getTime())) return started;
  const today = new Date().toDateString() === date.toDateString();
  const day = today
    ? 'today'
    : date.toLocaleDateString('en-GB', {day: 'numeric', month: 'short', year: 'numeric'});
  const [hours, minutes] = [date.getHours(), date.getMinutes()].map((part) =>
    String(part).padStart(2, '0'),
  );
  return `${day} ${hours}:${minutes}`;
}

/** `anna`, `anna and ben`, `anna, ben and 4 others`. */
export function namesText(names: readonly string[], most = 4): string {
  const rest = names.length > most ? names.length - most + 1 : 0;
  const said = rest > 0 ? [...names.slice(0, most - 1), `${rest} others`] : names;
  return said.length < 2
    ? (said[0] ?? '')
    : `${said.slice(0, -1).join(', ')} and ${said[said.length - 1]}`;
}

export function initials(name: string): string {
  const words = name.split(/[\s._-]+/).filter(Boolean);
  return (words.length > 1 ? words[0][0] + words[1][0] : name.slice(0, 2)).toUpperCase();
}

const kPersonHues = 8;

/** Token of the hue of a person, by the name alone: it is the same on all pages. */
export function personHue(name: string): string {
  // FNV-1a.
  let hash = 2166136261;
  for (let i = 0; i < name.length; ++i) hash = Math.imul(hash ^ name.charCodeAt(i), 16777619);
  return `person-${((hash >>> 0) % kPersonHues) + 1}`;
}

/** Style of the face of another person. */
export function faceStyle(name: string): string {
  return `--person-fill:var(--${personHue(name)})`;
}

export function roleText(role: string): string {
  return {observer: 'Observer', commander: 'Commander', super_user: 'Super-User'}[role] ?? role;
}
