// SPDX-License-Identifier: Apache-2.0
// True poses beside and in place of reported ones: node truth_test.mjs RAVE SCENARIO FOLDER
import assert from 'node:assert/strict';
import {mkdirSync, rmSync} from 'node:fs';
import {join} from 'node:path';
import {launch, startServer} from './browser.mjs';
import {app, check, report, showFailures, until} from './checks.mjs';

const [rave, scenario, folder] = process.argv.slice(2);
const truth = `${app}.model.truth.newest`;
const kTruth = 2;
/** Poses are sent in tenths of a millimetre. */
const kSent_m = 2e-4;
rmSync(folder, {recursive: true, force: true});
mkdirSync(folder, {recursive: true});
const record = join(folder, 'run');
const tag = ['--run', `truth-${process.pid}`];
const browser = await launch();

/** A page, and how many frames of true poses it got. */
async function open(link) {
  const page = await (await browser.newContext({viewport: {width: 1400, height: 900}})).newPage();
  showFailures(page, join(folder, 'failed.png'));
  const seen = {page, truths: 0};
  page.on('websocket', (socket) =>
    socket.on('framereceived', ({payload}) => {
      if (typeof payload !== 'string' && payload[0] === 1 && (payload[1] & kTruth) !== 0)
        ++seen.truths;
    }),
  );
  await page.goto(link);
  await until(page, `${app}?.model?.poses?.newest !== null`);
  return seen;
}

async function choose(page, poses) {
  if ((await page.getByLabel('Poses', {exact: true}).count()) === 0)
    await page.getByRole('button', {name: 'Layers'}).click();
  await page.getByLabel('Poses', {exact: true}).selectOption(poses);
}

/** Distances between true and reported poses of the newest frames, metres. */
const gaps = (page) =>
  page.evaluate(() => {
    const {truth, poses} = document.querySelector('rave-app').model;
    return [...truth.newest.x].map((x, i) =>
      Math.hypot(x - poses.newest.x[i], truth.newest.y[i] - poses.newest.y[i]),
    );
  });

/** Both robots are off by more than they would be by chance of rounding, and by less than the noise
 * allows. */
async function differ(page) {
  await until(page, `${truth} !== null && ${truth}.flags.every((flags) => flags === 1)`);
  const largest = [0, 0];
  for (let i = 0; i < 20; ++i) {
    (await gaps(page)).forEach((gap, robot) => (largest[robot] = Math.max(largest[robot], gap)));
    await page.waitForTimeout(60);
  }
  for (const gap of largest) assert.ok(gap > 0.05 && gap < 2, `${largest}`);
}

const servers = [];
/** Starts a server that does not outlive this test. */
async function serve(...words) {
  const server = await startServer(rave, words);
  servers.push(server);
  return server;
}

let moment = null;
try {
  const live = await serve('run', scenario, '--gui', '--quiet', '--no-picture', '--output', record);
  const seen = await open(live.link);
  const {page} = seen;

  await check('nobody is sent true poses who does not look at them', async () => {
    await page.waitForTimeout(500);
    assert.equal(await page.evaluate(`${truth}`), null);
    assert.equal(seen.truths, 0);
  });

  await check('beside reported ones they stand where the robots are', async () => {
    await choose(page, 'both');
    await differ(page);
    await page.screenshot({path: join(folder, 'both.png')});
    moment = await page.evaluate(() => {
      const {time_s, x, y, yaw} = document.querySelector('rave-app').model.truth.newest;
      return {time_s, x: [...x], y: [...y], yaw: [...yaw]};
    });
  });

  await check('in place of reported ones robots are drawn there', async () => {
    await choose(page, 'true');
    await page.waitForTimeout(200);
    await page.evaluate(() =>
      document.querySelector('rave-app').link.send({type: 'transport', do: 'pause'}),
    );
    await until(page, `${app}.model.time.state === 'paused'`);
    await page.waitForTimeout(300);
    const off = await page.evaluate(() => {
      const world = document.querySelector('rave-world');
      const {model} = document.querySelector('rave-app');
      world.paint();
      return [...model.truth.newest.x].map((x, i) =>
        Math.hypot(world.placed.x[i] - x, world.placed.y[i] - model.truth.newest.y[i]),
      );
    });
    for (const gap of off) assert.ok(gap < kSent_m, `${off}`);
    await page.screenshot({path: join(folder, 'true.png')});
  });

  await check('who sees with the eyes of an observer gets none, and no choice', async () => {
    await page.evaluate(() =>
      document.querySelector('rave-app').link.send({type: 'see_as', role: 'observer'}),
    );
    await until(page, `!${app}.model.may('true_pose')`);
    assert.equal(await page.getByLabel('Poses', {exact: true}).count(), 0);
    assert.equal(await page.evaluate(`${truth}`), null);
  });
  await live.end();
  await page.close();

  await check('a replay has them as they were', async () => {
    const replay = await serve('gui', record);
    const {page: other} = await open(replay.link);
    await other.evaluate((t) => {
      const {link} = document.querySelector('rave-app');
      link.send({type: 'transport', do: 'pause'});
      link.send({type: 'transport', do: 'seek', value: t});
    }, moment.time_s);
    await choose(other, 'both');
    await until(other, `${truth} !== null && Math.abs(${truth}.time_s - ${moment.time_s}) < 1e-6`);
    const now = await other.evaluate(`({x: [...${truth}.x], y: [...${truth}.y]})`);
    now.x.forEach((x, i) =>
      assert.ok(
        Math.hypot(x - moment.x[i], now.y[i] - moment.y[i]) < kSent_m,
        `robot ${i} at ${moment.time_s} s`,
      ),
    );
    await other.close();
    await replay.end();
  });

  await check('of two processes they come over the bus', async () => {
    const shared = await serve(
      'run',
      scenario,
      '--gui',
      '--processes',
      '2',
      '--quiet',
      '--no-picture',
      '--no-record',
      '--output',
      join(folder, 'shared'),
      ...tag,
    );
    const {page: other} = await open(shared.link);
    await choose(other, 'both');
    await differ(other);
    await other.close();
    await shared.end();
  });
  report();
} finally {
  for (const server of servers) server.child.kill('SIGTERM');
  await browser.close();
}
