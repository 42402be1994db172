// SPDX-License-Identifier: Apache-2.0
// A browser is killed, or stands still, while its stick drives: by the recording of its host the robot stands 300 ms
// after the last word, on a direct line and through the server.
// node stick_kills_test.mjs RAVE SCENARIO FOLDER
import assert from 'node:assert/strict';
import {execFileSync, spawn} from 'node:child_process';
import {once} from 'node:events';
import {mkdirSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import {dirname, join} from 'node:path';
import {knowsHosts, launchServed, startServer} from './browser.mjs';
import {app, check, report, until} from './checks.mjs';
import {choose, newest, slotOf, speed} from './commander.mjs';
import {kStands_ms, stoodAfterWord} from './stood.mjs';

const [rave, scenario, folder] = process.argv.slice(2);
const kDrives_ms = 500;
/** As long as it must be seen to stand. */
const kAfter_ms = 2200;

rmSync(folder, {recursive: true, force: true});
mkdirSync(folder, {recursive: true});
const key = join(folder, 'line');
execFileSync(rave, ['keys', 'line', key]);

/** The same scenario, with orders through the server. */
function relayed() {
  const text = readFileSync(scenario, 'utf8').replaceAll(/file: (?!\/)/g, `file: ${dirname(scenario)}/`);
  const file = join(folder, 'relayed.yaml');
  writeFileSync(file, `${text}gui: {relay: true}\n`);
  return file;
}

/** A run of its own: manager, two hosts, and a server. */
async function startRun(name, file, direct) {
  const bus = ['--run', `stick-${name}-${process.pid}`];
  const quiet = ['--quiet', '--no-picture'];
  const start = (words) => spawn(rave, [...words, ...quiet, ...bus], {stdio: ['ignore', 'ignore', 'inherit']});
  const recordings = {left: join(folder, `${name}-one`), right: join(folder, `${name}-two`)};
  const line = direct ? ['--web', '127.0.0.1:0', '--web-key', `${key}.pub`] : [];
  const children = [
    start(['env', file, '--no-record', '--output', join(folder, `${name}-env`)]),
    start(['robot', file, '--host', 'one', '--output', recordings.left, ...line]),
    start(['robot', file, '--host', 'two', '--output', recordings.right, ...line]),
  ];
  const gui = await startServer(rave, ['gui', file, ...(direct ? ['--line-key', key] : []), ...bus]);
  if (direct) await knowsHosts(gui.link, 2);
  return {
    gui, recordings,
    end: async () => {
      const hosts = children.slice(1);
      const ended = hosts.map((host) => once(host, 'exit'));
      for (const host of hosts) host.kill('SIGINT');
      await Promise.all(ended);
    },
    kill: () => [...children, gui.child].forEach((child) => child.kill('SIGKILL')),
  };
}

/** Holds the stick of a robot by a gamepad that is never quite still: a mouse moves when the browser draws, and that is
 * seldom on a machine without a graphics card. */
async function holdStick(page, robot) {
  const slot = await slotOf(page, robot);
  await choose(page, slot);
  await page.getByRole('radio', {name: 'Drive'}).click();
  await page.locator('rave-joystick .stick').waitFor();
  await page.evaluate(() => {
    navigator.getGamepads = () => [{id: 'Test pad', connected: true, axes: [0, -0.5 - 0.3 * ((performance.now() / 97) % 1)], buttons: []}];
  });
  await until(page, `${speed(slot)} > 0.05`);
}

/** Drives a robot from a browser of its own, whose processes get this signal. */
async function loseBrowser(run, robot, signal, direct) {
  const served = await launchServed();
  try {
    const context = await served.browser.newContext({viewport: {width: 1400, height: 900}, storageState: run.signedIn});
    const page = await context.newPage();
    // The link signs in once; the next browser has the cookie of the first.
    await page.goto(run.signedIn === undefined ? run.gui.link : new URL('/', run.gui.link).href);
    run.signedIn = await context.storageState();
    await until(page, `${newest} != null && ${newest}.time_s > 1`, 60000);
    if (direct) await until(page, `${app}.link.direct.open.length === 2`, 60000);
    await holdStick(page, robot);
    await new Promise((done) => setTimeout(done, kDrives_ms * (1 + Math.random())));
    served.signal(signal);
    await new Promise((done) => setTimeout(done, kAfter_ms));
  } finally {
    served.signal('SIGKILL');
  }
}

for (const [name, file, direct] of [['direct', scenario, true], ['relay', relayed(), false]]) {
  const run = await startRun(name, file, direct);
  try {
    const ways = [['left', 'SIGKILL', 'is killed'], ['right', 'SIGSTOP', 'stands still']];
    for (const [robot, signal, what] of ways) {
      await check(`${name}: a browser ${what} while its stick drives ${robot}`, () => loseBrowser(run, robot, signal, direct));
    }
    await run.end();
    for (const [robot, , what] of ways) {
      await check(`${name}: ${robot} stood within ${kStands_ms} ms of the last word of a browser that ${what}`, async () => {
        const stood_ms = stoodAfterWord(rave, run.recordings[robot], robot);
        console.log(`# ${stood_ms} ms`);
        assert.ok(stood_ms <= kStands_ms, `${stood_ms} ms`);
      });
    }
  } finally {
    run.kill();
  }
}
report();
process.exit(0);
