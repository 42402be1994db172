// SPDX-License-Identifier: Apache-2.0
import type {CoursePoint} from '../../model/readings';
import {columnOf} from '../../model/sightings';
import type {Sensor} from '../../protocol/messages';

/** Something of a sensor that is drawn over time. */
export interface CourseField {
  label: string;
  unit: string;
  /** Its value in one reading; NaN: there is none. */
  of(point: CoursePoint): number;
}

const kDegrees = 180 / Math.PI;

/** What can be drawn of a sensor. `beam`: of a sensor with several the one that is looked at. */
export function courseFieldsOf(sensor: Sensor, beam = 0): CourseField[] {
  if (sensor.kind === 'ranges') {
    const nearest: CourseField = {
      label: 'nearest',
      unit: 'm',
      of: ({values}) =>
        returned(
          sensor,
          values.reduce((least, value) => Math.min(least, value), Infinity),
        ),
    };
    return (sensor.bearings?.length ?? 1) > 1
      ? [
          nearest,
          {label: 'beam', unit: 'm', of: ({values}) => returned(sensor, values[beam] ?? NaN)},
        ]
      : [nearest];
  }
  if (sensor.list) return ofTheNearest(sensor);
  return sensor.fields.map(({label, unit}, i) => ({
    label,
    unit,
    of: ({values}) => values[i] ?? NaN,
  }));
}

/** The farthest that a sensor can measure means that nothing came back. */
function returned(sensor: Sensor, value: number): number {
  return value < (sensor.range?.[1] ?? Infinity) ? value : NaN;
}

/** Each row is something that is seen: its number is left out, and how many there are is added. */
function ofTheNearest(sensor: Sensor): CourseField[] {
  const range = columnOf(sensor, 'range_m');
  const seen = sensor.fields.slice(1).map(({label, unit}, i): CourseField => {
    const degrees = unit === 'rad';
    return {
      label: i + 1 === range ? `nearest ${label}` : label,
      unit: degrees ? '°' : unit,
      of: (point) =>
        (point.values[nearestRow(point, range) * point.fields + i + 1] ?? NaN) *
        (degrees ? kDegrees : 1),
    };
  });
  return [...seen, {label: 'count', unit: '', of: ({rows}) => rows}];
}

function nearestRow({rows, fields, values}: CoursePoint, range: number): number {
  let nearest = 0;
  for (let row = 1; row < rows; ++row)
    if (values[row * fields + range] < values[nearest * fields + range]) nearest = row;
  return nearest;
}

/** The beam in words: `12° left`. */
export function beamText(bearing_rad: number): string {
  const degrees = Math.round(10 * bearing_rad * kDegrees) / 10;
  return degrees === 0 ? 'ahead' : `${Math.abs(degrees)}° ${degrees > 0 ? 'left' : 'right'}`;
}

/** Values of the lines of a field at one moment, and how long ago that was. */
export function pointedText(
  {values, ago_s}: {values: readonly (number | null)[]; ago_s: number},
  {unit}: CourseField,
): string {
  const texts = values.map((value) =>
    value === null ? 'nothing' : `${Number(value.toFixed(3))} ${unit}`.trim(),
  );
  return `${texts.join(' · ')}, ${ago_s.toFixed(1)} s ago`;
}
