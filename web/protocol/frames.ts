// SPDX-License-Identifier: Apache-2.0
// Binary frames of the stream. docs/explanation/gui-protocol.md describes their layout.

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

/** Where all robots of the roster are at one moment. Metres, radians, metres per second. */
export interface PoseFrame {
  sequence: number;
  revision: number;
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

const kPoseHeader = 48;
const kPoseBytes = 14;
const kReadingHeader = 32;
const kVarianceHeader = 16;
const kVarianceBytes = 12;

/** Decodes a binary frame. Throws RangeError with the reason if the frame is not as described. */
export function decodeFrame(buffer: ArrayBuffer): PoseFrame | Reading | Variances {
  if (buffer.byteLength < 1) throw new RangeError('empty frame');
  const view = new DataView(buffer);
  switch (view.getUint8(0)) {
    case 1:
      return decodePoses(buffer, view);
    case 2:
      return decodeReading(buffer, view);
    case 3:
      return decodeVariances(buffer, view);
    default:
      throw new RangeError(`frame of unknown kind ${view.getUint8(0)}`);
  }
}

export function isPoseFrame(frame: PoseFrame | Reading | Variances): frame is PoseFrame {
  return 'flags' in frame;
}

export function isVariances(frame: PoseFrame | Reading | Variances): frame is Variances {
  return 'bySlot' in frame;
}

function decodePoses(buffer: ArrayBuffer, view: DataView): PoseFrame {
  if (buffer.byteLength < kPoseHeader) throw new RangeError('pose frame without a whole header');
  const n = view.getUint32(20, true);
  if (buffer.byteLength !== kPoseHeader + kPoseBytes * n) {
    throw new RangeError(`pose frame of ${n} robots has ${buffer.byteLength} bytes`);
  }
  const flags = view.getUint8(1);
  const [x0, y0, q] = [view.getFloat64(24, true), view.getFloat64(32, true), view.getFloat32(40, true)];
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
    revision: view.getUint16(2, true),
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
    part: view.getUint8(1),
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
    bySlot.set(view.getUint32(at, true), {xy_m2: view.getFloat32(at + 4, true), yaw_rad2: view.getFloat32(at + 8, true)});
  }
  return {time_s: view.getFloat64(8, true), bySlot};
}
