// SPDX-License-Identifier: Apache-2.0
// When a robot stood whose driver was gone, by the recording of its host.
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';

/** Within this a robot stands after the last word of its driver. */
export const kStands_ms = 300;
/** For so long it must have stood; the lease of who drove ends after 3 s, and its program goes
 * on. */
const kQuiet_s = 1.5;

/** What the recording says of a robot in each step: its speed is what reached the driver of its
 * wheels. */
function stepsOf(rave, recording, robot) {
  const text = execFileSync(rave, ['export', recording, 'poses', '--robot', robot], {
    encoding: 'utf8',
    maxBuffer: 1 << 28,
  });
  const [head, ...rows] = text
    .trim()
    .split('\n')
    .map((line) => line.split(','));
  const column = (name) => {
    assert.ok(head.includes(name), `${name} of ${head.join()}`);
    return head.indexOf(name);
  };
  const [time, vx, vy, wz] = ['time_s', 'vx_mps', 'vy_mps', 'wz_radps'].map(column);
  return rows
    .filter((row) => row[vx] !== '')
    .map((row) => ({
      t_s: Number(row[time]),
      v_mps: Math.hypot(Number(row[vx]), Number(row[vy])),
      w_radps: Number(row[wz]),
    }));
}

const stands = (step) => step.v_mps === 0 && step.w_radps === 0;

/** Milliseconds from the last word that a driver said faster than `above_mps`, before the moment
 * `until_s` of the run, until the robot stood, and stood on. The driver must say another velocity
 * each time: then a new speed is a new word. */
export function stoodAfterWord(rave, recording, robot, {above_mps = 0, until_s = Infinity} = {}) {
  const steps = stepsOf(rave, recording, robot).filter((step) => step.t_s < until_s);
  let last = -1;
  for (let i = 1; i < steps.length; ++i) {
    const [before, now] = [steps[i - 1], steps[i]];
    // Numerical noise of a speed over ground is no new word.
    if (now.v_mps > above_mps && Math.abs(now.v_mps - before.v_mps) > 1e-6) last = i;
  }
  assert.ok(last > 10, `${robot} was driven`);
  const stood = steps.findIndex((step, i) => i > last && stands(step));
  assert.ok(stood > 0, `${robot} stood at last`);
  const after = steps.slice(stood).filter((step) => step.t_s < steps[stood].t_s + kQuiet_s);
  assert.ok(after.at(-1).t_s - after[0].t_s > kQuiet_s / 2, 'it was recorded for a while');
  assert.ok(after.every(stands), `${robot} moves without its driver`);
  return Math.round(1000 * (steps[stood].t_s - steps[last].t_s));
}
