// SPDX-License-Identifier: Apache-2.0
import {expect, it} from 'vitest';
import {PictureAge} from './picture_age';

const kNow_ms = 1_790_000_000_123;

function frame(taken_ms: number, flags = 0): ArrayBuffer {
  const buffer = new ArrayBuffer(48);
  const view = new DataView(buffer);
  view.setUint8(0, 1);
  view.setUint8(1, flags);
  view.setUint32(44, taken_ms === 0 ? 0 : Math.floor(taken_ms * 1000) % 2 ** 32, true);
  return buffer;
}

it('on one machine the age is that of the state', () => {
  const age = new PictureAge(true);
  age.take(frame(kNow_ms - 12), kNow_ms);
  expect(age.newest_ms).toBeCloseTo(12);
});

it('between two machines it is counted from the fastest picture', () => {
  const age = new PictureAge(false);
  // The clock of the server is an hour ahead.
  const server_ms = kNow_ms + (3_600_000 % 2_000_000);
  age.take(frame(server_ms - 20), kNow_ms);
  age.take(frame(server_ms - 200), kNow_ms);
  expect(age.newest_ms).toBeCloseTo(180);
});

it('past poses, true ones and recordings have no age', () => {
  const age = new PictureAge(true);
  age.take(frame(kNow_ms - 12, 1), kNow_ms);
  expect(age.newest_ms).toBeNull();
  age.take(frame(0), kNow_ms);
  expect(age.newest_ms).toBeNull();
});
