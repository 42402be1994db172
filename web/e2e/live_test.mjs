// SPDX-License-Identifier: Apache-2.0
// A person watches a run, holds it and stops robots: node live_test.mjs RAVE SCENARIO FOLDER
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {mkdirSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';
import {launch, startServer} from './browser.mjs';
import {app, check, report, until, untilHere} from './checks.mjs';
import {watchUntouched} from './untouched.mjs';

const [rave, scenario, folder] = process.argv.slice(2);
const newest = `${app}.model.poses.newest`;
const kStopped = 4;

/** Says something to the server as the page does. */
const say = (page, message) =>
  page.evaluate((what) => document.querySelector('rave-app').link.send(what), message);
const stopped = `[...${newest}.flags].filter((flags) => flags & ${kStopped}).length`;
const hash = (run) => JSON.parse(readFileSync(join(run, 'result.json'))).hash;

rmSync(folder, {recursive: true, force: true});
mkdirSync(folder, {recursive: true});
const kShort_s = 20;
const short = ['--quiet', '--no-picture', '--duration', String(kShort_s)];
const alone = join(folder, 'alone');
try {
  execFileSync(rave, ['run', scenario, ...short, '--pace', 'max', '--output', alone], {
    stdio: 'ignore',
  });
} catch (error) {
  assert.equal(error.status, 1); // So short a run compares too little.
}
const browser = await launch();
const servers = [];
try {
  const context = await browser.newContext({viewport: {width: 1400, height: 900}});
  const page = await context.newPage();
  const errors = [];
  const said = [];
  page.on('pageerror', (error) => errors.push(String(error)));
  let frames = 0;
  page.on('websocket', (socket) => {
    socket.on('framereceived', ({payload}) => {
      if (typeof payload === 'string') said.push(JSON.parse(payload));
      else ++frames;
    });
    socket.on(
      'framesent',
      ({payload}) => typeof payload === 'string' && said.push(JSON.parse(payload)),
    );
  });
  const run = join(folder, 'watched');
  const live = await startServer(rave, [
    'run',
    scenario,
    '--gui',
    '--quiet',
    '--no-picture',
    '--duration',
    '120',
    '--output',
    run,
  ]);
  servers.push(live);

  await check('the run is alive on the page', async () => {
    await page.goto(live.link);
    await until(page, `${app}?.model?.robots?.length === 16 && ${newest} !== null`);
    assert.equal(await page.evaluate(`${app}.model.hello.run.source`), 'live');
    const before = await page.evaluate(`${newest}.time_s`);
    await until(page, `${newest}.time_s > ${before} + 1`);
    assert.ok((await page.evaluate(`${app}.model.bodies.size`)) > 10);
    await until(
      page,
      `${app}.model.time.pace === 1 && ${app}.model.time.speed > 0 && ${app}.model.time.speed < 1.5`,
    );
  });

  await check('the log begins with the begin of the run', async () => {
    assert.match(
      (await page.locator('rave-log .row').last().innerText()).replace(/\s+/g, ' '),
      /^00\.00 Run begins: 5 real and 11 simulated robots, seed \d+$/,
    );
    assert.equal(await page.locator('rave-log .row', {hasText: 'Run begins'}).count(), 1);
  });

  await check('the person at the page is nobody else in the lists of people', async () => {
    await page.evaluate(`${app}.context.show('chat')`);
    await page.locator('rave-chat').getByRole('radio', {name: 'Super-users'}).waitFor();
    await until(page, `${app}.model.people.some(({name}) => name === 'the operator')`);
    assert.equal(
      await page
        .locator('rave-chat')
        .getByRole('radio', {name: /operator/})
        .count(),
      0,
    );
    assert.equal(await page.locator('rave-top-bar .people').count(), 0);
    for (const id of ['log', 'world']) await page.evaluate(`${app}.context.show('${id}')`);
  });

  await check('the page can be installed as an app', async () => {
    const client = await context.newCDPSession(page);
    const {installabilityErrors} = await client.send('Page.getInstallabilityErrors');
    // Every context of a test is one that keeps nothing.
    assert.deepEqual(
      installabilityErrors.filter(({errorId}) => errorId !== 'in-incognito'),
      [],
    );
    const {errors: wrong, data} = await client.send('Page.getAppManifest');
    assert.deepEqual(wrong, []);
    assert.equal(JSON.parse(data).display, 'standalone');
    await client.detach();
  });

  await check('it is held, and steps one by one', async () => {
    await say(page, {type: 'transport', do: 'pause'});
    await until(page, `${app}.model.time.state === 'paused'`);
    // A page on a busy machine draws what is on its way first; the time comes once a second.
    const times = () => said.filter((message) => message.type === 'time');
    const before = times().length;
    while (times().length < before + 2) await page.waitForTimeout(50);
    const step = times().at(-1).step;
    await until(page, `${newest}.step === ${step}`);
    await say(page, {type: 'transport', do: 'step', value: 1});
    await until(page, `${newest}.step === ${step} + 1`);
  });

  await check(
    'while it is held and nobody does anything, the page gets the time and no frames',
    async () => {
      const times = () => said.filter((message) => message.type === 'time').length;
      const next = async (count) => {
        for (const to = times() + count; times() < to; ) await page.waitForTimeout(50);
      };
      // What was on its way comes before the next time.
      await next(2);
      const before = frames;
      await next(3);
      assert.equal(frames, before);
    },
  );

  await check('this process is the host of a run of one process', async () => {
    await until(page, `${app}.model.hosts.length === 1`);
    const host = await page.evaluate(`${app}.model.hosts[0]`);
    assert.deepEqual(
      [host.name, host.state, host.real, host.simulated, host.pid],
      ['mixed-reality', 'here', 5, 11, live.child.pid],
    );
    assert.ok(host.memory_mb > 1 && host.cpu >= 0 && host.machine !== '', JSON.stringify(host));
  });

  const scanIsThere = `(() => { const a = ${app}; const slot = a.selection.primary;
      const laser = a.model.robots[slot]?.sensors.findIndex((sensor) => sensor.kind === 'ranges');
      return a.model.readings.of(slot, laser)?.rows === 121; })()`;
  await check('readings of a robot that is looked at while the run is held', async () => {
    await page.locator('rave-robots .row', {hasText: 'real-3'}).click();
    await until(page, scanIsThere);
  });

  await check('it goes on, faster', async () => {
    await say(page, {type: 'transport', do: 'pace', value: 4});
    await say(page, {type: 'transport', do: 'play'});
    await until(page, `${app}.model.time.state === 'running' && ${app}.model.time.pace === 4`);
    // How much faster is a matter of the machine.
    const from_s = await page.evaluate(`${newest}.time_s`);
    await until(page, `${newest}.time_s > ${from_s} + 2`);
    await say(page, {type: 'transport', do: 'pace', value: 1});
  });

  await check('all robots stop, and are released', async () => {
    await say(page, {type: 'halt', do: 'stop', slots: []});
    await until(page, `${stopped} === 16`);
    await say(page, {type: 'halt', do: 'release', slots: []});
    await until(page, `${stopped} === 0`);
    assert.ok(
      said.some((message) => message.type === 'answer' && message.to === 'stop' && message.good),
    );
    await until(page, `${app}.model.events.some((event) => event.kind === 'stopped')`);
  });

  await check('one robot stops', async () => {
    const slot = await page.evaluate(
      `${app}.model.robots.findIndex((robot) => robot.name === 'hunter')`,
    );
    await say(page, {type: 'halt', do: 'stop', slots: [slot]});
    await until(page, `${stopped} === 1 && (${newest}.flags[${slot}] & ${kStopped}) !== 0`);
    await say(page, {type: 'halt', do: 'release', slots: [slot]});
  });

  await check('an obstacle that somebody adds stands on the page, moves and goes', async () => {
    const edit = (...words) =>
      execFileSync(rave, ['edit', String(live.child.pid), ...words], {
        stdio: ['ignore', 'ignore', 'inherit'],
      });
    const parcel = `[...${app}.model.bodies.values()].find((body) => body.name === 'parcel')`;
    edit('add', 'box', '--name', 'parcel', '--at', '9,9', '--size', '0.3x0.3');
    await until(page, `${parcel}?.kind === 'virtual' && ${parcel}.pose[0] === 9`);
    edit('move', 'parcel', '--at', '8,9');
    await until(page, `${parcel}?.pose[0] === 8`);
    edit('remove', 'parcel');
    await until(page, `${parcel} === undefined`);
  });

  await check('a seek is refused with the reason', async () => {
    await say(page, {type: 'transport', do: 'seek', value: 1});
    const refused = () =>
      said.find((message) => message.type === 'answer' && message.to === 'transport');
    await untilHere(page, refused, 'an answer');
    assert.equal(refused()?.good, false);
    assert.match(refused().text, /when the run has ended/);
  });

  await check('a second page sees the same, and a page that leaves holds nobody up', async () => {
    const second = await context.newPage();
    await second.goto(new URL(live.link).origin);
    await until(second, `${newest} != null`);
    const there = await page.evaluate(`${newest}.time_s`);
    await until(second, `${newest}.time_s >= ${there}`);
    await second.close();
    const before = await page.evaluate(`${newest}.time_s`);
    await until(page, `${newest}.time_s > ${before} + 0.5`);
  });

  await check('the run that is over turns into its own replay, without a reload', async () => {
    await say(page, {type: 'transport', do: 'pace', value: 0});
    await until(page, `${app}.model.hello.run.source === 'replay'`);
    await until(page, `${newest} !== null && ${app}.model.may('seek')`);
    assert.match(await page.evaluate(`${app}.model.hello.run.hash`), /^[0-9a-f]{16}$/);
    await say(page, {type: 'transport', do: 'pause'});
    await say(page, {type: 'transport', do: 'seek', value: 12.5});
    await until(page, `Math.abs(${newest}?.time_s - 12.5) < 0.011`);
    // What was looked at still is, though nobody has clicked.
    await until(page, scanIsThere);
    await live.end();
  });

  await check('a run that is watched has the hash of one that is not', async () => {
    const other = join(folder, 'same');
    const same = await startServer(rave, [
      'run',
      scenario,
      '--gui',
      ...short,
      '--pace',
      'realtime',
      '--paused',
      '--output',
      other,
    ]);
    servers.push(same);
    console.log(
      'watched',
      JSON.stringify(await watchUntouched(await context.newPage(), same.link, kShort_s)),
    );
    await same.end();
    assert.match(hash(alone), /^[0-9a-f]{16}$/);
    assert.equal(hash(other), hash(alone));
  });

  await check('every message is as the schema describes it', async () => {
    const file = join(folder, 'messages.json');
    writeFileSync(file, JSON.stringify(said));
    execFileSync('python3', [new URL('check_messages.py', import.meta.url).pathname, file], {
      stdio: 'inherit',
    });
    for (const kind of ['scene_change', 'answer', 'halt'])
      assert.ok(
        said.some((message) => message.type === kind),
        kind,
      );
    assert.deepEqual(errors, []);
  });
} finally {
  await browser.close();
  for (const server of servers) server.child.kill('SIGKILL');
}
report();
process.exit(0);
