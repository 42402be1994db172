// SPDX-License-Identifier: Apache-2.0
// A run that a page watches from its begin to its end, and in which nobody does anything.
import assert from 'node:assert/strict';
import {app, until} from './checks.mjs';

/**
 * Watches the live run behind `link` until it is its replay. The run begins paused or in real time, so that the page is there
 * long before its end, and is faster once poses and ranges of a robot have come; pace is no part of a run.
 */
export async function watchUntouched(page, link, duration_s) {
  await page.goto(link);
  await until(page, `${app}?.model?.rosterCame && ${app}.model.time !== null`);
  await page.evaluate(() => {
    const {link, model} = document.querySelector('rave-app');
    const seen = (globalThis.watched = {frames: 0, readings: 0, first_s: NaN, last_s: NaN});
    const known = new Set();
    model.pictureChanged.on(() => {
      if (model.hello.run.source !== 'live' || model.poses.newest === null) return;
      const {time_s} = model.poses.newest;
      ++seen.frames;
      if (Number.isNaN(seen.first_s)) seen.first_s = time_s;
      seen.last_s = time_s;
      const stamp_s = model.readings.of(
        0,
        model.robots[0].sensors.findIndex(({kind}) => kind === 'ranges'),
      )?.stamp_s;
      if (stamp_s !== undefined && !known.has(stamp_s)) known.add(stamp_s);
      seen.readings = known.size;
    });
    document.querySelector('rave-app').selection.set([0]);
    if (model.time?.state === 'paused') link.send({type: 'transport', do: 'play'});
  });
  await until(page, 'globalThis.watched.frames > 10 && globalThis.watched.readings > 10');
  await page.evaluate(() =>
    document.querySelector('rave-app').link.send({type: 'transport', do: 'pace', value: 8}),
  );
  await until(page, `${app}.model.hello.run.source === 'replay'`);
  const watched = await page.evaluate('globalThis.watched');
  assert.ok(
    watched.first_s < 0.5 * duration_s && watched.last_s > 0.8 * duration_s,
    `watched from ${watched.first_s} s to ${watched.last_s} s`,
  );
  assert.ok(watched.frames > 20 && watched.readings > 20, JSON.stringify(watched));
  return watched;
}
