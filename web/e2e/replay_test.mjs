// SPDX-License-Identifier: Apache-2.0
// A person looks at a recording: node replay_test.mjs RAVE SCENARIO FOLDER
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {mkdirSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import http from 'node:http';
import {join} from 'node:path';
import WebSocket from 'ws';
import {launch, startServer} from './browser.mjs';
import {standsStill} from './commander.mjs';
import {checkOwnReplays} from './own_replay_checks.mjs';
import {app, check, report, showFailures, until, watch} from './checks.mjs';

const [rave, scenario, folder] = process.argv.slice(2);
function get(url, headers = {}) {
  return new Promise((resolve, reject) => {
    http
      .get(url, {headers}, (response) => {
        let body = '';
        response.on('data', (data) => (body += data));
        response.on('end', () =>
          resolve({status: response.statusCode, headers: response.headers, body}),
        );
      })
      .on('error', reject);
  });
}

/** Opens a panel as a person does who knows its name. */
async function openPanel(page, title) {
  await page.keyboard.press('Control+k');
  await page.keyboard.type(title);
  await page
    .getByRole('option', {name: new RegExp(`^${title}`)})
    .first()
    .click();
}

rmSync(folder, {recursive: true, force: true});
mkdirSync(folder, {recursive: true});
const run = join(folder, 'run');
execFileSync(rave, ['run', scenario, '--pace', 'max', '--quiet', '--no-picture', '--output', run], {
  stdio: ['ignore', 'ignore', 'inherit'],
});
const gui = await startServer(rave, ['gui', run, '--foxglove']);
const origin = new URL(gui.link).origin;
const browser = await launch();
try {
  const context = await browser.newContext({viewport: {width: 1400, height: 900}});
  const page = await context.newPage();
  showFailures(page, join(folder, 'failed.png'));
  const {errors, foreign} = watch(page, origin);
  const said = [];
  page.on('websocket', (socket) => {
    socket.on(
      'framereceived',
      ({payload}) => typeof payload === 'string' && said.push(JSON.parse(payload)),
    );
    socket.on(
      'framesent',
      ({payload}) => typeof payload === 'string' && said.push(JSON.parse(payload)),
    );
  });

  await check('a stranger gets the page and no run', async () => {
    const other = await (await browser.newContext()).newPage();
    await other.goto(origin);
    await other.getByText('You are not signed in').waitFor();
    await other.getByText('If you have an account on this server, sign in.').waitFor();
    await other.screenshot({path: join(folder, 'stranger.png')});
    await other.close();
  });

  await check('the link signs in, once', async () => {
    await page.goto(gui.link);
    await until(page, `${app}?.model?.robots?.length === 16`);
    const again = await get(gui.link);
    assert.equal(again.status, 403);
    assert.match(again.body, /already used/);
  });

  await check('robots, bodies and events of the recording are there', async () => {
    await until(page, `${app}.model.poses.newest !== null`);
    const seen = await page.evaluate(() => {
      const {model} = document.querySelector('rave-app');
      return {
        name: model.hello.run.name,
        hash: model.hello.run.hash,
        real: model.robots.filter((robot) => robot.kind === 'real').length,
        kinds: [...new Set([...model.bodies.values()].map((body) => body.kind))].sort(),
        known: [...model.poses.newest.flags].filter((flags) => flags & 1).length,
      };
    });
    assert.equal(seen.name, 'mixed-reality');
    assert.match(seen.hash, /^[0-9a-f]{16}$/);
    assert.equal(seen.real, 5);
    assert.deepEqual(seen.kinds, ['landmark', 'virtual']);
    assert.equal(seen.known, 16);
  });

  await check('it plays: time goes on, and pauses', async () => {
    const before = await page.evaluate(`${app}.model.poses.newest.time_s`);
    await until(page, `${app}.model.poses.newest.time_s > ${before} + 0.5`);
    await page.keyboard.press('k');
    await until(page, `${app}.model.time.state === 'paused'`);
  });

  await check('a seek shows the moment, with the trails before it', async () => {
    await page.keyboard.press('Control+k');
    await page.keyboard.type('12.5');
    await page.keyboard.press('Enter');
    await until(page, `Math.abs(${app}.model.poses.newest?.time_s - 12.5) < 0.011`);
    // They come behind it.
    await until(page, `${app}.model.poses.past.length > 55`);
  });

  await check('a step on is one step', async () => {
    const step = await page.evaluate(`${app}.model.poses.newest.step`);
    await page.keyboard.press('.');
    await until(page, `${app}.model.poses.newest.step === ${step} + 1`);
  });

  await check('a click on a row selects, and the sensor of that robot is read', async () => {
    await page.locator('rave-robots .row', {hasText: 'real-3'}).click();
    await until(page, `${app}.selection.primary !== null`);
    await until(
      page,
      `(() => { const a = ${app}; const slot = a.selection.primary;
      const laser = a.model.robots[slot].sensors.findIndex((sensor) => sensor.kind === 'ranges');
      return a.model.readings.of(slot, laser)?.rows === 121; })()`,
    );
    await page.locator('rave-sensors').getByText('121 rays').waitFor();
    // In a paused replay, too, its course is what it read in the seconds before.
    await until(
      page,
      `(() => { const a = ${app}; const slot = a.selection.primary;
      const laser = a.model.robots[slot].sensors.findIndex((sensor) => sensor.kind === 'ranges');
      const course = a.model.readings.course(slot, laser);
      const times = course.map(({time_s}) => time_s);
      return course.length > 40 && times.every((time_s, i) => i === 0 || time_s > times[i - 1]) &&
        times.at(-1) - times[0] > 10 && times.at(-1) <= a.model.poses.newest.time_s + 0.01; })()`,
    );
  });

  await check('a click in the World View selects the robot that is there', async () => {
    await page.keyboard.press('Escape');
    await page.keyboard.press('f');
    await standsStill(page, `document.querySelector('rave-world').viewpoint()`);
    const at = await page.evaluate(() => {
      const world = document.querySelector('rave-world');
      const box = world.renderRoot.querySelector('.canvas').getBoundingClientRect();
      const slot = document
        .querySelector('rave-app')
        .model.robots.findIndex((robot) => robot.name === 'hunter');
      const [x, y] = world.screenOf(slot);
      return {x: box.left + x, y: box.top + y, slot};
    });
    await page.mouse.click(at.x, at.y);
    await until(page, `${app}.selection.primary === ${at.slot}`);
  });

  await check('the link to this moment brings time, robot and camera', async () => {
    await page.mouse.move(700, 450);
    const unzoomed = await page.evaluate(`document.querySelector('rave-world').viewpoint()`);
    await page.mouse.wheel(0, -400);
    await until(page, `document.querySelector('rave-world').viewpoint() !== '${unzoomed}'`);
    await standsStill(page, `document.querySelector('rave-world').viewpoint()`);
    await page.getByText('Link to this moment').click();
    const view = await page.evaluate(`document.querySelector('rave-world').viewpoint()`);
    const other = await context.newPage();
    await other.goto(page.url());
    await until(
      other,
      `${app}?.selection.primary === ${app}?.model.robots.findIndex((robot) => robot.name === 'hunter')`,
    );
    await until(other, `document.querySelector('rave-world').viewpoint() === '${view}'`);
    await other.close();
  });

  await check('a click in the log goes to the moment of the event', async () => {
    await page.locator('rave-log .row').filter({hasNotText: 'Run begins'}).last().click();
    const t = await page.evaluate(`${app}.model.events[0].t`);
    await until(page, `Math.abs(${app}.model.poses.newest?.time_s - ${t}) < 0.02`);
    await page.getByPlaceholder('source, text').fill('no such thing');
    await until(
      page,
      `document.querySelector('rave-log').renderRoot.querySelectorAll('.row').length === 0`,
    );
    await page.getByPlaceholder('source, text').fill('');
  });

  await check('the log begins with the begin of the run, and a click goes there', async () => {
    const first = page.locator('rave-log .row').last();
    assert.match(
      (await first.innerText()).replace(/\s+/g, ' '),
      /^00\.00 Run begins: 5 real and 11 simulated robots, seed \d+$/,
    );
    await first.click();
    await until(page, `${app}.model.poses.newest?.time_s < 0.02`);
    await page.getByPlaceholder('source, text').fill('run begins');
    await until(
      page,
      `document.querySelector('rave-log').renderRoot.querySelectorAll('.row').length === 1`,
    );
    await page.getByPlaceholder('source, text').fill('');
  });

  await check('the recording is downloaded as it is', async () => {
    const [download] = await Promise.all([
      page.waitForEvent('download'),
      page.getByLabel('Download the recording').click(),
    ]);
    assert.equal(download.suggestedFilename(), 'mixed-reality.mcap');
    const file = join(folder, 'downloaded.mcap');
    await download.saveAs(file);
    assert.ok(readFileSync(file).equals(readFileSync(join(run, 'run.mcap'))), 'the bytes differ');
  });

  await check('a recording cannot be stopped, and the page says so', async () => {
    await page.getByText('View only').waitFor();
  });

  await check('the sheet for Foxglove has an address that serves', async () => {
    await page.getByLabel('Watch in Foxglove').click();
    const sheet = page.locator('rave-foxglove');
    await sheet.getByText(/^ws:/).waitFor();
    const address = (await sheet.getByText(/^ws:/).innerText()).trim();
    await page.screenshot({path: join(folder, 'foxglove.png')});
    const first = await new Promise((resolve, reject) => {
      const socket = new WebSocket(address, ['foxglove.sdk.v1', 'foxglove.websocket.v1']);
      socket.onmessage = ({data}) => {
        // What follows until the server has closed is binary, too.
        socket.onmessage = null;
        socket.close();
        resolve(JSON.parse(data));
      };
      socket.onerror = () => reject(new Error(`nothing serves at ${address}`));
    });
    assert.equal(first.op, 'serverInfo');
    await page.keyboard.press('Escape');
    await sheet.waitFor({state: 'detached'});
    await page.keyboard.press('Control+k');
    await page.keyboard.type('foxglove');
    await page.getByRole('option', {name: /Watch in Foxglove/}).click();
    await sheet.getByText(/^ws:/).waitFor();
    await sheet.getByLabel('Close').click();
  });

  await check('light and dark', async () => {
    const before = await page.evaluate('document.documentElement.dataset.theme');
    await page.getByLabel('Light or dark').click();
    assert.notEqual(await page.evaluate('document.documentElement.dataset.theme'), before);
  });

  await check('a killed server comes back to the page by itself', async () => {
    const port = new URL(origin).port;
    await gui.end();
    await page
      .getByText(/Link lost/)
      .first()
      .waitFor();
    const next = await startServer(rave, ['gui', run, '--port', port]);
    // Sessions end with the server that began them; the page says that it needs another link.
    await page.getByText('You are not signed in').waitFor();
    await page.goto(next.link);
    await until(page, `${app}?.model?.robots?.length === 16`);
    assert.equal(await next.end(), 0);
  });

  await check('how sure a robot was of its pose is in its recording, at any moment', async () => {
    const guesses = join(folder, 'guesses');
    const odometry = new URL('../../tests/cli/data/played.yaml', import.meta.url).pathname;
    execFileSync(
      rave,
      ['run', odometry, '--pace', 'max', '--quiet', '--no-picture', '--output', guesses],
      {stdio: ['ignore', 'ignore', 'inherit']},
    );
    const other = await startServer(rave, ['gui', guesses]);
    const replay = await (
      await browser.newContext({viewport: {width: 1400, height: 900}})
    ).newPage();
    await replay.goto(other.link);
    await until(replay, `${app}?.model?.poses?.newest != null`);
    assert.equal(await replay.getByLabel('Watch in Foxglove').count(), 0, 'it serves no Foxglove');
    const slot = await replay.evaluate(
      `${app}.model.robots.findIndex((robot) => robot.name === 'anna')`,
    );
    await replay.evaluate((anna) => {
      const there = document.querySelector('rave-app');
      there.selection.set([anna]);
      there.link.send({type: 'transport', do: 'pause'});
    }, slot);
    const varianceAt = async (time_s) => {
      await replay.evaluate((value) => {
        const there = document.querySelector('rave-app');
        globalThis.variancesBefore = there.model.variances;
        there.link.send({type: 'transport', do: 'seek', value});
      }, time_s);
      await until(replay, `Math.abs(${app}.model.poses.newest.time_s - ${time_s}) < 0.011`);
      await until(
        replay,
        `${app}.model.variances !== globalThis.variancesBefore && ${app}.model.variances.has(${slot})`,
      );
      return replay.evaluate(`${app}.model.variances.get(${slot})?.xy_m2 ?? 0`);
    };
    const [late, early, later] = [await varianceAt(3), await varianceAt(1), await varianceAt(3.8)];
    // Odometry is the less sure the farther it went.
    assert.ok(early > 0 && early < late && late < later, `${early} ${late} ${later}`);
    await replay.screenshot({path: join(folder, 'variance.png')});
    // A reading has the numbers here that it has in an export.
    const sensors = await replay.evaluate(`${app}.model.robots[${slot}].sensors`);
    for (const {name, fields} of sensors.filter(({kind}) => kind !== 'ranges')) {
      const csv = execFileSync(rave, [
        'export',
        guesses,
        'readings',
        '--robot',
        'anna',
        '--sensor',
        name,
      ]).toString();
      assert.equal(
        csv.split('\n')[0],
        ['time_s', 'stamp_s', ...fields.map((field) => field.name)].join(','),
      );
    }
    await other.end();
  });

  await check('every message is as the schema describes it', async () => {
    const kinds = new Set(said.map((message) => message.type));
    for (const kind of ['hello', 'scene', 'roster', 'time', 'events', 'look', 'ack', 'transport'])
      assert.ok(kinds.has(kind), kind);
    const file = join(folder, 'messages.json');
    writeFileSync(file, JSON.stringify(said));
    execFileSync('python3', [new URL('check_messages.py', import.meta.url).pathname, file], {
      stdio: 'inherit',
    });
  });

  await check('nothing was asked of another origin, and nothing was complained of', async () => {
    assert.deepEqual(foreign, []);
    // The link that was lost is told by the browser as well.
    assert.deepEqual(
      errors.filter(
        (text) => !/WebSocket|ERR_CONNECTION_REFUSED|Failed to load resource/.test(text),
      ),
      [],
    );
  });

  await checkOwnReplays({rave, folder, browser, openPanel});
} finally {
  await browser.close();
  gui.child.kill('SIGKILL');
}
report();
process.exit(0);
