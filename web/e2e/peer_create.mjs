// SPDX-License-Identifier: Apache-2.0
// The Create as a process with wheels, a laser and a motion capture.
import {spawn} from 'node:child_process';
import {createSocket} from 'node:dgram';
import {writeFileSync} from 'node:fs';
import {join} from 'node:path';
import {createInterface} from 'node:readline';

export const freePort = () =>
  new Promise((resolve) => {
    const probe = createSocket('udp4');
    probe.bind(0, '127.0.0.1', () => {
      const {port} = probe.address();
      probe.close(() => resolve(port));
    });
  });

/** Starts it in a room of 4 x 3 m, at a place of that; it is asked by lines of text. */
export async function startPeer(peer, folder, port, {x_m, y_m, yaw_rad}) {
  writeFileSync(join(folder, 'room'), '2 1.5 0 4 3\n');
  const child = spawn(
    peer,
    [
      '--link',
      join(folder, 'base'),
      '--laser-link',
      join(folder, 'laser'),
      '--mocap-port',
      String(port),
      '--mocap-body',
      'create',
      '--room',
      join(folder, 'room'),
      '--pose',
      `${x_m},${y_m},${yaw_rad}`,
      '--mocap-noise-m',
      '0.001',
      '--slip',
      '0.01,0.015',
    ],
    {stdio: ['pipe', 'pipe', 'inherit']},
  );
  const lines = createInterface({input: child.stdout})[Symbol.asyncIterator]();
  const waitFor = async (beginning) => {
    for (;;) {
      const {value, done} = await lines.next();
      if (done) throw new Error('the Create has ended');
      if (value.startsWith(beginning)) return value.slice(beginning.length);
    }
  };
  await waitFor('ready');
  const state = async () => {
    child.stdin.write('state\n');
    const text = await waitFor('state ');
    await waitFor('ok state');
    return JSON.parse(text);
  };
  const tell = async (order) => {
    child.stdin.write(`${order}\n`);
    await waitFor(`ok ${order.split(' ')[0]}`);
  };
  return {child, state, tell};
}
