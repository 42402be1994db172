// SPDX-License-Identifier: Apache-2.0
import {kCommandsOf, type Reading} from '../protocol/frames';

/** How long the course of a sensor is kept, seconds of the run. */
export const kCourse_s = 15;
/** The same for the velocities that a robot is commanded. */
export const kToldCourse_s = 30;

/** Times of frames are rounded. */
const kMoment_s = 1e-3;

/** One point of the course of a sensor. */
export interface CoursePoint {
  time_s: number;
  rows: number;
  /** Of each row. */
  fields: number;
  values: Float32Array;
}

/** The newest reading of each sensor that a panel looks at, and its course: the readings of the
 * last seconds. */
export class Readings {
  private readonly newest = new Map<string, Reading>();
  private readonly courses = new Map<string, CoursePoint[]>();

  add(reading: Reading): void {
    const key = keyOf(reading.slot, reading.sensor, reading.part);
    let course = this.courses.get(key);
    if (course === undefined) this.courses.set(key, (course = []));
    if (reading.past) return addPast(course, reading);
    this.newest.set(key, reading);
    const last = course[course.length - 1];
    if (last !== undefined && reading.stamp_s < last.time_s) course.length = 0;
    if (last !== undefined && reading.stamp_s === last.time_s) return;
    course.push(pointOf(reading));
    const kept_s = reading.sensor === kCommandsOf ? kToldCourse_s : kCourse_s;
    while (course.length > 1 && reading.stamp_s - course[0].time_s > kept_s) course.shift();
  }

  of(slot: number, sensor: number, part = 0): Reading | null {
    return this.newest.get(keyOf(slot, sensor, part)) ?? null;
  }

  /** Visits the newest reading of each sensor, without halves of hybrids. */
  each(visit: (slot: number, sensor: number, reading: Reading) => void): void {
    for (const reading of this.newest.values())
      if (reading.part === 0) visit(reading.slot, reading.sensor, reading);
  }

  course(slot: number, sensor: number, part = 0): readonly CoursePoint[] {
    return this.courses.get(keyOf(slot, sensor, part)) ?? [];
  }

  /** Removes the readings of sensors from this number on. */
  forgetFrom(sensor: number): void {
    for (const [key, reading] of this.newest) {
      if (reading.sensor < sensor) continue;
      this.newest.delete(key);
      this.courses.delete(key);
    }
  }

  /** Removes readings later than this time of the run, as after a jump back; their courses begin
   * again. */
  forgetAfter(time_s: number): void {
    for (const [key, reading] of this.newest) {
      if (reading.stamp_s <= time_s + kMoment_s) continue;
      this.newest.delete(key);
      this.courses.delete(key);
    }
  }

  /** Removes all readings. */
  clear(): void {
    this.newest.clear();
    this.courses.clear();
  }
}

function pointOf({stamp_s, rows, fields, values}: Reading): CoursePoint {
  return {time_s: stamp_s, rows, fields, values};
}

/** Between those that are there. */
function addPast(course: CoursePoint[], reading: Reading): void {
  const next = course.findIndex(({time_s}) => time_s >= reading.stamp_s);
  if (next >= 0 && course[next].time_s > reading.stamp_s) course.splice(next, 0, pointOf(reading));
  // Later than what is there, it belongs to another moment, which the page has left meanwhile.
}

function keyOf(slot: number, sensor: number, part: number): string {
  return `${slot}/${sensor}/${part}`;
}
