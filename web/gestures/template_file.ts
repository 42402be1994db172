// SPDX-License-Identifier: Apache-2.0
import {kPoints} from './motion';
import type {Template} from './recogniser';

/** Most templates of a file: twenty for each of twenty gestures. */
const kMostTemplates = 400;
/** Characters; larger files are not looked into. */
const kMostText = 2_000_000;
/** Coordinates of an evened motion stay far below this. */
const kLargest = 100;

/** Either the templates, or what is wrong: where, what was expected, and what was found. */
export type TemplateFile = {templates: Template[]} | {error: string};

/** Templates as text, four decimals. */
export function writeTemplates(templates: readonly Template[]): string {
  return JSON.stringify({
    rave_gestures: 1,
    templates: templates.map(({gesture, points}) => ({
      gesture,
      points: points.map((point) => point.map((value) => Number(value.toFixed(4)))),
    })),
  });
}

/** Reads what `writeTemplates` wrote, strictly: unknown keys, gestures that are none of
 * `gestures`, and points that no motion has are refused. Never throws. */
export function readTemplates(text: string, gestures: readonly string[]): TemplateFile {
  if (text.length > kMostText)
    return {error: `the file has ${text.length} characters; expected at most ${kMostText}`};
  let file: unknown;
  try {
    file = JSON.parse(text);
  } catch (error) {
    // The browser quotes the place.
    return {error: `the file is no JSON: ${(error as Error).message.slice(0, 200)}`};
  }
  const wrong =
    keysOf(file, ['rave_gestures', 'templates'], 'the file') ||
    versionOf(file as Record<string, unknown>);
  if (wrong !== '') return {error: wrong};
  const {templates} = file as {templates: unknown};
  if (!Array.isArray(templates) || templates.length > kMostTemplates)
    return {error: `templates: expected a list of at most ${kMostTemplates}`};
  for (const [i, template] of templates.entries()) {
    const error = templateOf(template, gestures, `templates[${i}]`);
    if (error !== '') return {error};
  }
  return {templates: templates as Template[]};
}

function templateOf(template: unknown, gestures: readonly string[], where: string): string {
  const wrong = keysOf(template, ['gesture', 'points'], where);
  if (wrong !== '') return wrong;
  const {gesture, points} = template as {gesture: unknown; points: unknown};
  if (typeof gesture !== 'string' || !gestures.includes(gesture)) {
    const near = typeof gesture === 'string' ? nearest(gesture, gestures) : '';
    return (
      `${where}.gesture: expected one of ${gestures.join(', ')}, ` +
      `found ${shown(gesture)}${near}`
    );
  }
  if (!Array.isArray(points) || points.length !== kPoints)
    return `${where}.points: expected ${kPoints} points`;
  const axes = Array.isArray(points[0]) ? points[0].length : 0;
  if (axes !== 2 && axes !== 3) return `${where}.points[0]: expected 2 or 3 numbers`;
  for (const [i, point] of points.entries()) {
    if (!Array.isArray(point) || point.length !== axes)
      return `${where}.points[${i}]: expected ${axes} numbers, as the first point has`;
    for (const [axis, value] of point.entries())
      if (typeof value !== 'number' || !(Math.abs(value) <= kLargest))
        return (
          `${where}.points[${i}][${axis}]: expected a number from ${-kLargest} to ${kLargest}, ` +
          `found ${shown(value)}`
        );
  }
  return '';
}

function keysOf(value: unknown, keys: readonly string[], where: string): string {
  if (typeof value !== 'object' || value === null || Array.isArray(value))
    return `${where}: expected an object with ${keys.join(' and ')}, found ${shown(value)}`;
  for (const key of Object.keys(value))
    if (!keys.includes(key))
      return (
        `${where}: unknown key ${shown(key)}; ` +
        `expected ${keys.join(' and ')}${nearest(key, keys)}`
      );
  const missing = keys.find((key) => !Object.hasOwn(value, key));
  return missing === undefined ? '' : `${where}: ${missing} is missing`;
}

function versionOf(file: Record<string, unknown>): string {
  return file['rave_gestures'] === 1
    ? ''
    : `rave_gestures: expected 1, found ${shown(file['rave_gestures'])}`;
}

function shown(value: unknown): string {
  const text = JSON.stringify(value) ?? String(value);
  return text.length > 40 ? `${text.slice(0, 40)}...` : text;
}

/** `; did you mean NAME?`, or nothing where no name is near. */
function nearest(word: string, names: readonly string[]): string {
  if (word.length > 40) return '';
  const ranked = names.map((name) => ({name, edits: editsOf(word, name)}));
  ranked.sort((a, b) => a.edits - b.edits);
  return ranked.length > 0 && ranked[0].edits <= 2 ? `; did you mean ${ranked[0].name}?` : '';
}

/** The distance of V. Levenshtein, 1966. */
function editsOf(a: string, b: string): number {
  let row = Array.from({length: b.length + 1}, (_, j) => j);
  for (let i = 1; i <= a.length; ++i) {
    const next = [i];
    for (let j = 1; j <= b.length; ++j)
      next.push(
        Math.min(row[j] + 1, next[j - 1] + 1, row[j - 1] + (a[i - 1] === b[j - 1] ? 0 : 1)),
      );
    row = next;
  }
  return row[b.length];
}
