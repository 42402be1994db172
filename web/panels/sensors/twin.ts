// SPDX-License-Identifier: Apache-2.0
import type {Robot} from '../../protocol/messages';

/** The sensor that says what this camera should see, or the camera that it stands for; null without
 * one. */
export function twinOf(robot: Robot, index: number): number | null {
  const sensor = robot.sensors[index];
  if (sensor === undefined || sensor.kind !== 'sightings') return null;
  const other = robot.sensors.findIndex(
    (known, i) =>
      i !== index &&
      known.kind === 'sightings' &&
      (known.origin === 'virtual') !== (sensor.origin === 'virtual'),
  );
  return other < 0 ? null : other;
}
