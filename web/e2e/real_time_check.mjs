// SPDX-License-Identifier: Apache-2.0
import {execFileSync} from 'node:child_process';
import {mkdirSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';
import {knowsHosts, startServer} from './browser.mjs';
import {app, check, until} from './checks.mjs';

const newest = `${app}.model.poses.newest`;
const kStopped = 4;
const stopped = `[...${newest}.flags].filter((flags) => flags & ${kStopped}).length`;

/** A run of several processes by the wall clock. */
export async function checkRealTime({rave, scenario, folder, context, servers, say}) {
  await check('two processes in real time: readings, stops and obstacles of each', async () => {
    const room = join(scenario, '..', `.live-${process.pid}`);
    mkdirSync(room);
    try {
      const text = readFileSync(join(scenario, 'scenario.yaml'), 'utf8').replace(
        /^duration_s:.*$/m,
        'duration_s: 60\nclock: real_time\nmax_missed_pct: 100\nhosts:\n  - {name: left, robots: [bird]}\n  - {name: right, robots: [tenth]}',
      );
      writeFileSync(join(room, 'scenario.yaml'), text);
      const live = await startServer(rave, [
        'run',
        room,
        '--gui',
        '--processes',
        '2',
        '--quiet',
        '--no-picture',
        '--no-record',
        '--output',
        join(folder, 'live'),
        '--run',
        `live-${process.pid}`,
      ]);
      servers.push(live);
      await knowsHosts(live.link, 2);
      const real = await context.newPage();
      await real.goto(live.link);
      await until(
        real,
        `${app}?.model?.hello?.run.clock === 'real_time' && ${newest} != null && [...${newest}.flags].every((flags) => flags & 1)`,
      );
      await command(real, {rave, live, say});
      await live.end();
    } finally {
      rmSync(room, {recursive: true, force: true});
    }
  });
}

/** Reads, stops and releases robots of each process, and adds an obstacle for all. */
async function command(real, {rave, live, say}) {
  for (const slot of [0, 9]) {
    const name = await real.evaluate(`${app}.model.robots[${slot}].name`);
    await real.locator('rave-robots .row', {hasText: name}).first().click();
    await until(
      real,
      `(() => { const a = ${app}; if (a.selection.primary !== ${slot}) return false;
          const laser = a.model.robots[${slot}].sensors.findIndex((sensor) => sensor.kind === 'ranges');
          return a.model.readings.of(${slot}, laser)?.rows > 1; })()`,
    );
  }
  await say(real, {type: 'halt', do: 'stop', slots: []});
  await until(real, `${stopped} === ${app}.model.robots.length`);
  await say(real, {type: 'halt', do: 'release', slots: [9]});
  await until(real, `${stopped} === ${app}.model.robots.length - 1`);
  execFileSync(
    rave,
    [
      'edit',
      String(live.child.pid),
      'add',
      'box',
      '--name',
      'parcel',
      '--at',
      '9,9',
      '--size',
      '0.3x0.3',
    ],
    {stdio: ['ignore', 'ignore', 'inherit']},
  );
  await until(real, `[...${app}.model.bodies.values()].some((body) => body.name === 'parcel')`);
  await until(
    real,
    `${app}.model.events.filter((event) => event.kind === 'obstacle added').length === 1`,
  );
  await until(real, `${app}.model.time.state === 'running' && ${app}.model.time.speed > 0`);
}
