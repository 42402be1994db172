// SPDX-License-Identifier: Apache-2.0
// A browser is killed, or stands still, while its stick drives, and so is the server of a relay: by
// the recording of its host the robot stands 300 ms after the last word; on a direct line in real
// time and in lock-step, and through the server. Seven random moments a round; RAVE_KILL_ROUNDS
// asks for about as many moments as it says. node stick_kills_test.mjs RAVE SCENARIO FOLDER
import assert from 'node:assert/strict';
import {execFileSync, spawn} from 'node:child_process';
import {once} from 'node:events';
import {mkdirSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import {dirname, join, resolve} from 'node:path';
import {knowsHosts, launchServed, startServer} from './browser.mjs';
import {app, check, report, until} from './checks.mjs';
import {holdStick, newest} from './commander.mjs';
import {kStands_ms, stoodAfterWord} from './stood.mjs';

const [rave, scenario, folder] = process.argv.slice(2);
const kDrives_ms = 500;
/** As long as it must be seen to stand. */
const kAfter_ms = 2200;

rmSync(folder, {recursive: true, force: true});
mkdirSync(folder, {recursive: true});
const key = join(folder, 'line');
execFileSync(rave, ['keys', 'line', key]);

/** The same scenario, changed. */
function changed(name, change) {
  const text = readFileSync(scenario, 'utf8').replaceAll(
    /file: (?!\/)/g,
    `file: ${dirname(resolve(scenario))}/`,
  );
  const file = join(folder, `${name}.yaml`);
  writeFileSync(file, change(text));
  return file;
}
const relayed = changed('relayed', (text) => `${text}gui: {relay: true}\n`);
const inLockStep = changed('lock-step', (text) =>
  text.replaceAll(/^(clock|max_missed_pct|world_period_s):.*\n/gm, ''),
);

/** A run of its own: manager, two hosts, and a server. */
async function startRun({name, file, direct, pace = []}) {
  const bus = ['--run', `stick-${name}-${process.pid}`];
  const quiet = ['--quiet', '--no-picture'];
  const start = (words) =>
    spawn(rave, [...words, ...quiet, ...bus], {stdio: ['ignore', 'ignore', 'inherit']});
  const recordings = {left: join(folder, `${name}-one`), right: join(folder, `${name}-two`)};
  const line = direct ? ['--web', '127.0.0.1:0', '--web-key', `${key}.pub`] : [];
  const children = [
    start(['env', file, '--no-record', '--output', join(folder, `${name}-env`), ...pace]),
    start(['robot', file, '--host', 'one', '--output', recordings.left, ...line]),
    start(['robot', file, '--host', 'two', '--output', recordings.right, ...line]),
  ];
  const gui = await startServer(rave, [
    'gui',
    file,
    ...(direct ? ['--line-key', key] : []),
    ...bus,
  ]);
  if (direct) await knowsHosts(gui.link, 2);
  return {
    gui,
    recordings,
    end: async () => {
      const hosts = children.slice(1);
      const ended = hosts.map((host) => once(host, 'exit'));
      for (const host of hosts) host.kill('SIGINT');
      await Promise.all(ended);
    },
    kill: () => [...children, gui.child].forEach((child) => child.kill('SIGKILL')),
  };
}

/** Drives a robot from a browser of its own until `lose` takes away what carries its words. */
async function driveAndLose(run, robot, direct, lose) {
  const served = await launchServed();
  try {
    const context = await served.browser.newContext({
      viewport: {width: 1400, height: 900},
      storageState: run.signedIn,
    });
    const page = await context.newPage();
    // The link signs in once; the next browser has the cookie of the first.
    await page.goto(run.signedIn === undefined ? run.gui.link : new URL('/', run.gui.link).href);
    run.signedIn = await context.storageState();
    await until(page, `${newest} != null && ${newest}.time_s > 1`, 60000);
    const from_s = await page.evaluate(`${newest}.time_s`);
    if (direct) await until(page, `${app}.link.direct.open.length === 2`, 60000);
    await holdStick(page, robot);
    await new Promise((done) => setTimeout(done, kDrives_ms * (1 + Math.random())));
    lose(served);
    await new Promise((done) => setTimeout(done, kAfter_ms));
    return from_s;
  } finally {
    served.signal('SIGKILL');
  }
}

const browser = (signal) => (served) => served.signal(signal);
const server = (run) => run.gui.child.kill('SIGKILL');
const kWays = [
  {robot: 'left', what: 'a browser that is killed', lose: () => browser('SIGKILL')},
  {robot: 'right', what: 'a browser that stands still', lose: () => browser('SIGSTOP')},
];
const kRuns = [
  {name: 'direct', file: scenario, direct: true, ways: kWays},
  {name: 'lock-step', file: inLockStep, direct: true, pace: ['--pace', 'realtime'], ways: kWays},
  {
    name: 'relay',
    file: relayed,
    direct: false,
    ways: [
      ...kWays,
      {robot: 'left', what: 'a server that is killed', lose: (run) => () => server(run)},
    ],
  },
];

/** A run of one kind: its stick is lost in each way, and its recordings say when the robot
 * stood. */
async function tryWays(setting) {
  const {name, direct, ways} = setting;
  const run = await startRun(setting);
  try {
    const from_s = [];
    for (const {robot, what, lose} of ways) {
      await check(`${name}: the stick drives ${robot}, and loses ${what}`, async () =>
        from_s.push(await driveAndLose(run, robot, direct, lose(run))),
      );
    }
    await run.end();
    for (const [i, {robot, what}] of ways.entries()) {
      await check(
        `${name}: ${robot} stood within ${kStands_ms} ms of the last word of ${what}`,
        async () => {
          // Somebody may have driven the same robot later.
          const later = ways.findIndex((way, k) => k > i && way.robot === robot);
          const stood_ms = stoodAfterWord(rave, run.recordings[robot], robot, {
            until_s: later < 0 ? Infinity : from_s[later],
          });
          console.log(`# ${stood_ms} ms`);
          assert.ok(stood_ms <= kStands_ms, `${stood_ms} ms`);
        },
      );
    }
  } finally {
    run.kill();
  }
}

const moments = kRuns.reduce((sum, {ways}) => sum + ways.length, 0);
const rounds = Math.max(1, Math.ceil(Number(process.env.RAVE_KILL_ROUNDS ?? 5) / moments));
for (let round = 1; round <= rounds; ++round) {
  for (const setting of kRuns) await tryWays({...setting, name: `${setting.name}-${round}`});
}
report();
process.exit(0);
