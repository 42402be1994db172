// SPDX-License-Identifier: Apache-2.0
// The direct line: orders reach the hosts without the GUI Server.
// node direct_test.mjs RAVE SCENARIO FOLDER
import assert from 'node:assert/strict';
import {execFileSync, spawn} from 'node:child_process';
import {once} from 'node:events';
import {mkdirSync, readFileSync, rmSync} from 'node:fs';
import {join} from 'node:path';
import {knowsHosts, launch, startServer} from './browser.mjs';
import {app, check, report, showFailures, until, untilHere, watch} from './checks.mjs';
import {dropStick, holdDown, holdStick, near, sendByClick} from './commander.mjs';
import {kStands_ms, stoodAfterWord} from './stood.mjs';

const [rave, scenario, folder] = process.argv.slice(2);
const newest = `${app}.model.poses.newest`;
const lines = `${app}.link.direct`;
const chip =
  'document.querySelector("rave-app").renderRoot.querySelector("rave-top-bar").renderRoot.querySelector("rave-way").renderRoot.textContent.trim()';
const bus = ['--run', `direct-${process.pid}`];
const key = join(folder, 'line');

rmSync(folder, {recursive: true, force: true});
mkdirSync(folder, {recursive: true});
execFileSync(rave, ['keys', 'line', key]);
const hosts = [];
const servers = [];
const log = (host) => readFileSync(join(folder, host, 'console.log'), 'utf8');
const startHost = (host) =>
  hosts.push(
    spawn(
      rave,
      [
        'robot',
        scenario,
        '--host',
        host,
        '--web',
        '127.0.0.1:0',
        '--web-key',
        `${key}.pub`,
        '--quiet',
        '--no-picture',
        '--output',
        join(folder, host),
        '--replace',
        ...bus,
      ],
      {stdio: ['ignore', 'ignore', 'inherit']},
    ),
  );
const startGui = async (port) => {
  const gui = await startServer(rave, [
    'gui',
    scenario,
    '--line-key',
    key,
    ...(port ? ['--port', String(port)] : []),
    ...bus,
  ]);
  servers.push(gui);
  return gui;
};

hosts.push(
  spawn(
    rave,
    [
      'env',
      scenario,
      '--quiet',
      '--no-picture',
      '--no-record',
      '--output',
      join(folder, 'env'),
      ...bus,
    ],
    {stdio: ['ignore', 'ignore', 'inherit']},
  ),
);
for (const host of ['left', 'right']) startHost(host);
const browser = await launch();
try {
  const context = await browser.newContext({viewport: {width: 1400, height: 900}});
  const page = await context.newPage();
  showFailures(page, join(folder, 'failed.png'));
  let gui = await startGui();
  const {port} = new URL(gui.link);

  await check('hosts say where their lines are', async () => {
    for (const host of ['left', 'right'])
      await untilHere(page, () => /pages reach `.*` at ws:/.test(log(host)), host, 60000);
  });

  let seen = null;
  await check('the page has a line to each host, and says so with its latency', async () => {
    await knowsHosts(gui.link, 2);
    seen = watch(page, new URL(gui.link).origin);
    await page.goto(gui.link);
    await until(page, `${newest} != null && ${newest}.time_s > 1`, 60000);
    await until(page, `${lines}.open.length === 2`);
    await until(page, `/^Direct .* ms$/.test(${chip})`);
    assert.ok((await page.evaluate(`${lines}.latency_ms`)) < 1000);
    await page.screenshot({path: join(folder, 'direct.png')});
  });

  await check('goals and paths of a terminal arrive, at the host of each robot', async () => {
    const ask = (...words) =>
      execFileSync(rave, ['goal', ...words.map(String), ...bus], {encoding: 'utf8'});
    assert.match(ask('anna', 1, -1), /left/);
    assert.match(ask('ben', 1, 3.5, 1.8, 3), /right/);
    await near(page, 0, 1, -1, 0.3);
    await near(page, 1, 1.8, 3, 0.3);
    // An order of the terminal keeps nobody else from the robot.
    for (const robot of ['anna', 'ben']) ask(robot, '--cancel');
  });

  await check('goals and paths of the page arrive, at the host of each robot', async () => {
    await sendByClick(page, 'anna', 0.2, -0.5);
    await sendByClick(page, 'ben', 0.5, 3.5);
    const answer = await page.evaluate(() =>
      document.querySelector('rave-app').commands.path(
        [0],
        [
          [0.6, -0.8],
          [1.2, -0.6],
        ],
      ),
    );
    assert.equal(answer.good, true, answer.text);
    await near(page, 0, 1.2, -0.6, 0.3);
    const done = await page.evaluate(() =>
      document.querySelector('rave-app').commands.lease('give', [0, 1]),
    );
    assert.equal(done.good, true, done.text);
  });

  const drive = (robot, v) =>
    page.evaluate(
      ([name, speed]) =>
        document
          .querySelector('rave-app')
          .link.direct.order({kind: 'drive', robot: name, v: speed, w: 0, echo: true}),
      [robot, v],
    );
  const speed = (slot) => `${newest}.speed[${slot}]`;

  await check(
    'a drive by the line moves the robot, and so does the stick of the panel',
    async () => {
      const first = await drive('anna', 0.3);
      assert.equal(first.good, true, first.text);
      // A driver who falls silent must let the stick go first.
      await drive('anna', 0);
      const stick = page.locator('rave-joystick');
      await holdStick(page, 'anna', 0.26);
      await stick.getByText('dead-man held').waitFor();
      await stick.getByText('Direct line').waitFor();
    },
  );

  await check(
    'the server is killed while the stick drives: the robot goes on to obey',
    async () => {
      gui.child.kill('SIGKILL');
      await until(page, `${app}.link.state === 'lost'`);
      assert.equal(await page.evaluate(`${lines}.open.length`), 2);
      const answer = await drive('anna', 0.3);
      assert.equal(answer.good, true, answer.text);
      // The panel still holds the stick, and each of its words is answered.
      const loop = 'document.querySelector("rave-joystick").loop';
      const answered = `${loop}.delays_ms.filter((delay) => delay !== 0).length`;
      assert.equal(await page.evaluate(`${loop}.held`), 'pad');
      await page.evaluate(`${loop}.delays_ms = []`);
      await until(page, `${answered} > 20 && ${loop}.held === 'pad' && ${loop}.refusal === ''`);
      await page.screenshot({path: join(folder, 'server-gone.png')});
      await dropStick(page);
      await until(page, `${loop}.held === null`);
      assert.equal((await drive('anna', 0)).good, true, 'it obeys when the stick is let go');
    },
  );

  await check(
    'STOP without the server: button, bar and list say who is stopped; release as well',
    async () => {
      const bar = page.locator('.strip.lost');
      await page.getByRole('button', {name: /^STOP/}).click();
      await until(page, `[...${lines}.lines.values()].every((line) => line.stopped?.length === 1)`);
      const release = page.getByRole('button', {name: 'Hold to release 2 robots'});
      await release.getByText('2 robots, stopped by you', {exact: true}).waitFor();
      await bar.getByText('anna and ben are stopped.').waitFor();
      await page.locator('rave-robots').getByText('stopped', {exact: true}).nth(1).waitFor();
      await page.screenshot({path: join(folder, 'stopped-without-server.png')});
      await holdDown(page, release);
      await until(page, `[...${lines}.lines.values()].every((line) => line.stopped?.length === 0)`);
      await page.getByText('all 2 robots', {exact: true}).waitFor();
      await bar.getByText('are stopped.').waitFor({state: 'detached'});
    },
  );

  await check(
    'with a host out of reach, too, the page says whom STOP reaches and whom it does not',
    async () => {
      const gone = hosts[2];
      gone.kill('SIGKILL');
      await until(page, `${lines}.open.length === 1`);
      await page.getByText('only anna', {exact: true}).waitFor();
      await page
        .locator('.strip.lost')
        .getByText('ben is out of reach: stop it at its machine.')
        .waitFor();
      await page.getByRole('button', {name: /^STOP/}).click();
      const release = page.getByRole('button', {name: 'Hold to release anna'});
      await release.getByText('anna, stopped by you', {exact: true}).waitFor();
      await holdDown(page, release);
      await page.getByText('only anna', {exact: true}).waitFor();
      startHost('right');
    },
  );

  await check('the server comes back and so does the page, with its lines', async () => {
    gui = await startGui(port);
    await knowsHosts(gui.link, 2);
    // The link is of the server that is gone, whose sessions are gone with it.
    await page.goto(gui.link);
    await until(page, `${newest} != null && ${lines}.open.length === 2`, 60000);
  });

  await check('the robot stands when the page is gone', async () => {
    const other = await context.newPage();
    await other.goto(new URL('/', gui.link).href);
    await until(other, `${newest} != null && ${lines}.open.length === 2`, 60000);
    // Full stick is 0.4 m/s; faster than its program drives.
    await holdStick(other, 'ben', 0.21);
    await other.close({runBeforeUnload: false});
    await until(page, `Math.abs(${speed(1)}) < 0.01`);
    // Its program drives it again when the lease ends.
    await until(page, `Math.abs(${speed(1)}) > 0.1`);
  });

  await check(
    'nothing of the page was refused by its policy, and nobody else was asked',
    async () => {
      assert.deepEqual(
        seen.foreign.filter((url) => !url.startsWith('ws://127.0.0.1')),
        [],
      );
      assert.deepEqual(
        seen.errors.filter((error) => !/ERR_CONNECTION|WebSocket/.test(error)),
        [],
      );
    },
  );

  // What the page shows comes later than what the driver of the wheels gets, so the recording says
  // when that was.
  await check(`the robot stood ${kStands_ms} ms after the last word of the page`, async () => {
    const right = hosts.at(-1);
    const ended = once(right, 'exit');
    right.kill('SIGINT');
    await ended;
    const stood_ms = stoodAfterWord(rave, join(folder, 'right'), 'ben', {above_mps: 0.205});
    console.log(`# ${stood_ms} ms`);
    assert.ok(stood_ms <= kStands_ms, `${stood_ms} ms`);
  });
} finally {
  await browser.close();
  for (const server of servers) server.child.kill('SIGKILL');
  for (const host of hosts) host.kill('SIGKILL');
}
report();
process.exit(0);
