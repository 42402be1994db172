// SPDX-License-Identifier: Apache-2.0
// Binary frames of the stream. docs/reference/gui-frames.md describes their layout.

/** Bits of a robot's flags in a pose frame. */
export const RobotFlag = {
  known: 1,
  stale: 2,
  stopped: 4,
  unarmed: 8,
  real: 16,
  touching: 32,
  poseLost: 64,
} as const;

/** Readings of virtual sensors that are tried come with numbers from here on. */
export const kFirstProbe = 0xf000;

/** In the place of a sensor's index: velocities that a robot was told. Asked forward and left, then
 * what its actuators got. */
export const kCommandsOf = 0xefff;

/** Where all robots of the roster are at one moment. Metres, radians, metres per second. */
export interface PoseFrame {
  sequence: number;
  past: boolean;
  truth: boolean;
  time_s: number;
  step: number;
  x: Float64Array;
  y: Float64Array;
  yaw: Float32Array;
  speed: Float32Array;
  flags: Uint16Array;
}

/** One reading of one sensor; `values` has `rows` times `fields` numbers. */
export interface Reading {
  slot: number;
  sensor: number;
  part: number;
  /** Of a time before the moment of a replay, for plots over time. */
  past: boolean;
  stamp_s: number;
  time_s: number;
  rows: number;
  fields: number;
  values: Float32Array;
}

/** How sure robots are of their reported poses; robots that are not in it have not said. */
export interface Variances {
  time_s: number;
  bySlot: Map<number, Variance>;
}

/** Of each of x and y in m², of the heading in rad². */
export interface Variance {
  xy_m2: number;
  yaw_rad2: number;
}

/** A piece of a map, which takes the place of an earlier one of the same place. */
export interface MapTile {
  /** Of the robot whose local map it is; null: of the global map `name`. */
  slot: number | null;
  name: string;
  /** Time of the run of the newest reading in it. */
  stamp_s: number;
  /** Of the whole map: lower left corner, size of a cell in metres, cells along both sides. */
  frame: {x0: number; y0: number; resolution_m: number; columns: number; rows: number};
  /** Which tile of the map it is, and how many cells it has along both sides. */
  column: number;
  row: number;
  width: number;
  height: number;
  /** Row by row from below, in percent, 255: unknown. */
  cells: Uint8Array;
}

export type Frame = PoseFrame | Reading | Variances | MapTile;

const kPoseHeader = 48;
const kPoseBytes = 14;
const kReadingHeader = 32;
const kVarianceHeader = 16;
const kVarianceBytes = 12;
const kTileHeader = 64;
const kMostTileCells = 64;
const kNoSlot = 0xffffffff;

/** Decodes a binary frame. Throws RangeError with the reason if the frame is not as described. */
export function decodeFrame(buffer: ArrayBuffer): Frame {
  if (buffer.byteLength < 1) throw new RangeError('empty frame');
  const view = new DataView(buffer);
  switch (view.getUint8(0)) {
    case 1:
      return decodePoses(buffer, view);
    case 2:
      return decodeReading(buffer, view);
    case 3:
      return decodeVariances(buffer, view);
    case 4:
      return decodeTile(buffer, view);
    default:
      throw new RangeError(`frame of unknown kind ${view.getUint8(0)}`);
  }
}

export function isPoseFrame(frame: Frame): frame is PoseFrame {
  return 'flags' in frame;
}

export function isVariances(frame: Frame): frame is Variances {
  return 'bySlot' in frame;
}

export function isMapTile(frame: Frame): frame is MapTile {
  return 'cells' in frame;
}

function decodePoses(buffer: ArrayBuffer, view: DataView): PoseFrame {
  if (buffer.byteLength < kPoseHeader) throw new RangeError('pose frame without a whole header');
  const n = view.getUint32(20, true);
  if (buffer.byteLength !== kPoseHeader + kPoseBytes * n) {
    throw new RangeError(`pose frame of ${n} robots has ${buffer.byteLength} bytes`);
  }
  const flags = view.getUint8(1);
  const [x0, y0, q] = [
    view.getFloat64(24, true),
    view.getFloat64(32, true),
    view.getFloat32(40, true),
  ];
  const columns = new Int32Array(buffer, kPoseHeader, 2 * n);
  const turns = new Uint16Array(buffer, kPoseHeader + 8 * n, n);
  const speeds = new Int16Array(buffer, kPoseHeader + 10 * n, n);
  const x = new Float64Array(n);
  const y = new Float64Array(n);
  const yaw = new Float32Array(n);
  const speed = new Float32Array(n);
  for (let i = 0; i < n; ++i) {
    x[i] = x0 + q * columns[i];
    y[i] = y0 + q * columns[n + i];
    yaw[i] = (turns[i] * 2 * Math.PI) / 65536;
    speed[i] = speeds[i] / 1000;
  }
  return {
    sequence: view.getUint32(4, true),
    past: (flags & 1) !== 0,
    truth: (flags & 2) !== 0,
    time_s: view.getFloat64(8, true),
    step: view.getUint32(16, true),
    x,
    y,
    yaw,
    speed,
    flags: new Uint16Array(buffer, kPoseHeader + 12 * n, n),
  };
}

function decodeReading(buffer: ArrayBuffer, view: DataView): Reading {
  if (buffer.byteLength < kReadingHeader) throw new RangeError('reading without a whole header');
  const rows = view.getUint32(24, true);
  const fields = view.getUint32(28, true);
  if (buffer.byteLength !== kReadingHeader + 4 * rows * fields) {
    throw new RangeError(`reading of ${rows} x ${fields} values has ${buffer.byteLength} bytes`);
  }
  return {
    part: view.getUint8(1) & 0x7f,
    past: (view.getUint8(1) & 0x80) !== 0,
    sensor: view.getUint16(2, true),
    slot: view.getUint32(4, true),
    stamp_s: view.getFloat64(8, true),
    time_s: view.getFloat64(16, true),
    rows,
    fields,
    values: new Float32Array(buffer, kReadingHeader, rows * fields),
  };
}

function decodeVariances(buffer: ArrayBuffer, view: DataView): Variances {
  if (buffer.byteLength < kVarianceHeader) throw new RangeError('variances without a whole header');
  const n = view.getUint32(4, true);
  if (buffer.byteLength !== kVarianceHeader + kVarianceBytes * n) {
    throw new RangeError(`variances of ${n} robots have ${buffer.byteLength} bytes`);
  }
  const bySlot = new Map<number, Variance>();
  for (let at = kVarianceHeader; at < buffer.byteLength; at += kVarianceBytes) {
    bySlot.set(view.getUint32(at, true), {
      xy_m2: view.getFloat32(at + 4, true),
      yaw_rad2: view.getFloat32(at + 8, true),
    });
  }
  return {time_s: view.getFloat64(8, true), bySlot};
}

function decodeTile(buffer: ArrayBuffer, view: DataView): MapTile {
  if (buffer.byteLength < kTileHeader) throw new RangeError('tile without a whole header');
  const slot = view.getUint32(4, true);
  const letters = view.getUint16(2, true);
  const [width, height] = [view.getUint32(56, true), view.getUint32(60, true)];
  if (
    width > kMostTileCells ||
    height > kMostTileCells ||
    buffer.byteLength !== kTileHeader + width * height + letters
  ) {
    throw new RangeError(`tile of ${width} x ${height} cells has ${buffer.byteLength} bytes`);
  }
  return {
    slot: slot === kNoSlot ? null : slot,
    name: new TextDecoder().decode(new Uint8Array(buffer, kTileHeader + width * height, letters)),
    stamp_s: view.getFloat64(8, true),
    frame: {
      x0: view.getFloat64(16, true),
      y0: view.getFloat64(24, true),
      resolution_m: view.getFloat64(32, true),
      columns: view.getUint32(40, true),
      rows: view.getUint32(44, true),
    },
    column: view.getUint32(48, true),
    row: view.getUint32(52, true),
    width,
    height,
    cells: new Uint8Array(buffer, kTileHeader, width * height),
  };
}
