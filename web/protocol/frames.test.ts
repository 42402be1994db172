// SPDX-License-Identifier: Apache-2.0
import {readFileSync} from 'node:fs';
import {join} from 'node:path';
import {describe, expect, it} from 'vitest';
import {
  decodeFrame,
  isMapTile,
  isPoseFrame,
  isVariances,
  type MapTile,
  type PoseFrame,
  type Reading,
  type Variances,
} from './frames';

/** Frames that the server made, with what they mean: tests/data of the server writes them. */
interface Conformance {
  poses: {
    hex: string;
    sequence: number;
    time_s: number;
    step: number;
    past: boolean;
    x: number[];
    y: number[];
    yaw: number[];
    speed: number[];
    flags: number[];
  }[];
  readings: {
    hex: string;
    slot: number;
    sensor: number;
    part: number;
    past: boolean;
    stamp_s: number;
    rows: number;
    fields: number;
    values: (number | null)[];
  }[];
  tiles: {
    hex: string;
    name: string;
    slot: number;
    stamp_s: number;
    origin: [number, number];
    resolution_m: number;
    size: [number, number];
    column: number;
    row: number;
    width: number;
    height: number;
    cells: number[];
  }[];
  variances: {hex: string; time_s: number; robots: [number, number, number][]}[];
}

const kData = JSON.parse(
  readFileSync(join(process.cwd(), '../schemas/gui/frames.json'), 'utf8'),
) as Conformance;

function bytesOf(hex: string): ArrayBuffer {
  return new Uint8Array((hex.match(/../g) ?? []).map((byte) => parseInt(byte, 16))).buffer;
}

describe('pose frames', () => {
  it('read what the server wrote', () => {
    expect(kData.poses.length).toBeGreaterThan(1);
    for (const known of kData.poses) {
      const frame = decodeFrame(bytesOf(known.hex)) as PoseFrame;
      expect(isPoseFrame(frame)).toBe(true);
      expect([frame.sequence, frame.time_s, frame.step, frame.past]).toEqual([
        known.sequence,
        known.time_s,
        known.step,
        known.past,
      ]);
      expect([...frame.flags]).toEqual(known.flags);
      known.x.forEach((x, i) => {
        expect(frame.x[i]).toBeCloseTo(x, 3);
        expect(frame.y[i]).toBeCloseTo(known.y[i], 3);
        expect(Math.cos(frame.yaw[i] - known.yaw[i])).toBeGreaterThan(1 - 1e-8);
        expect(frame.speed[i]).toBeCloseTo(known.speed[i], 3);
      });
    }
  });

  it('are refused if they are cut, at any byte', () => {
    const whole = bytesOf(kData.poses[0].hex);
    for (let size = 0; size < whole.byteLength; ++size) {
      expect(() => decodeFrame(whole.slice(0, size))).toThrow(RangeError);
    }
  });
});

describe('readings', () => {
  it('read what the server wrote', () => {
    expect(kData.readings.length).toBeGreaterThan(1);
    for (const known of kData.readings) {
      const reading = decodeFrame(bytesOf(known.hex)) as Reading;
      expect([
        reading.slot,
        reading.sensor,
        reading.part,
        reading.past,
        reading.stamp_s,
        reading.rows,
        reading.fields,
      ]).toEqual([
        known.slot,
        known.sensor,
        known.part,
        known.past,
        known.stamp_s,
        known.rows,
        known.fields,
      ]);
      known.values.forEach((value, i) => {
        if (value === null) expect(reading.values[i]).toBe(Infinity);
        else expect(reading.values[i]).toBeCloseTo(value, 5);
      });
    }
  });
});

describe('variances', () => {
  it('read what the server wrote', () => {
    expect(kData.variances.length).toBeGreaterThan(1);
    for (const known of kData.variances) {
      const frame = decodeFrame(bytesOf(known.hex)) as Variances;
      expect(isVariances(frame)).toBe(true);
      expect(frame.time_s).toBe(known.time_s);
      expect(
        [...frame.bySlot].map(([slot, variance]) => [slot, variance.xy_m2, variance.yaw_rad2]),
      ).toEqual(known.robots);
    }
  });

  it('are refused if they are cut, at any byte', () => {
    const whole = bytesOf(kData.variances[0].hex);
    for (let size = 0; size < whole.byteLength; ++size) {
      expect(() => decodeFrame(whole.slice(0, size))).toThrow(RangeError);
    }
  });
});

describe('tiles of maps', () => {
  it('read what the server wrote', () => {
    expect(kData.tiles.length).toBeGreaterThan(1);
    for (const known of kData.tiles) {
      const tile = decodeFrame(bytesOf(known.hex)) as MapTile;
      expect(isMapTile(tile)).toBe(true);
      expect(tile.slot).toBe(known.slot === 0xffffffff ? null : known.slot);
      expect([tile.name, tile.stamp_s, tile.column, tile.row, tile.width, tile.height]).toEqual([
        known.name,
        known.stamp_s,
        known.column,
        known.row,
        known.width,
        known.height,
      ]);
      expect(tile.frame).toEqual({
        x0: known.origin[0],
        y0: known.origin[1],
        resolution_m: known.resolution_m,
        columns: known.size[0],
        rows: known.size[1],
      });
      expect([...tile.cells]).toEqual(known.cells);
    }
  });

  it('are refused if they are cut, at any byte, or larger than a tile', () => {
    const whole = bytesOf(kData.tiles[1].hex);
    for (let size = 0; size < whole.byteLength; ++size) {
      expect(() => decodeFrame(whole.slice(0, size))).toThrow(RangeError);
    }
    const large = new ArrayBuffer(64 + 65);
    new DataView(large).setUint8(0, 4);
    new DataView(large).setUint32(56, 65, true);
    new DataView(large).setUint32(60, 1, true);
    expect(() => decodeFrame(large)).toThrow(RangeError);
  });
});
