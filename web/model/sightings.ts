// SPDX-License-Identifier: Apache-2.0
import type {Reading} from '../protocol/frames';
import type {Sensor} from '../protocol/messages';

/** Where a row has the number of this name, such as `range_m`; -1: the sensor has none. */
export function columnOf(sensor: Sensor, name: string): number {
  return sensor.fields.findIndex((field) => field.name === name);
}

/** A row of a reading of a camera. */
export interface Sighting {
  code: number;
  range_m: number;
  bearing_rad: number;
}

export function sightingsOf(sensor: Sensor, reading: Reading | null): Sighting[] {
  const [code, range, bearing] = ['code', 'range_m', 'bearing_rad'].map((name) =>
    columnOf(sensor, name),
  );
  if (reading === null || Math.min(code, range, bearing) < 0) return [];
  return Array.from({length: reading.rows}, (_, row) => {
    const at = row * reading.fields;
    return {
      code: reading.values[at + code],
      range_m: reading.values[at + range],
      bearing_rad: reading.values[at + bearing],
    };
  });
}
