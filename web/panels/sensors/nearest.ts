// SPDX-License-Identifier: Apache-2.0
import type {Reading} from '../../protocol/frames';
import type {Sensor} from '../../protocol/messages';

/** The ray with the shortest range; null where nothing came back within reach. */
export function nearestRay(sensor: Sensor, reading: Reading): number | null {
  let nearest: number | null = null;
  for (let ray = 0; ray < reading.rows; ++ray) {
    if (
      reading.values[ray] <
      (nearest === null ? (sensor.range?.[1] ?? Infinity) : reading.values[nearest])
    )
      nearest = ray;
  }
  return nearest;
}
