// SPDX-License-Identifier: Apache-2.0
// Two hosts and a GUI Server, without an environment manager: the page commands all the same.
// node alone_test.mjs RAVE SCENARIO FOLDER
import assert from 'node:assert/strict';
import {execFileSync, spawn} from 'node:child_process';
import {mkdirSync, rmSync} from 'node:fs';
import {join} from 'node:path';
import {knowsHosts, launch, startServer} from './browser.mjs';
import {app, check, report, showFailures, until} from './checks.mjs';
import {driveByMouse, newest, placeOf, sendByClick, slotOf} from './commander.mjs';
import {clickAt} from './hands.mjs';

const [rave, scenario, folder] = process.argv.slice(2);
const kStale = 2;
/** `staleness_s` of the robots is 0.5 s; the rest is for the ways to the server and the page. In
 * time of the run, however late a busy browser draws it. */
const kStale_s = 2;
rmSync(folder, {recursive: true, force: true});
mkdirSync(folder, {recursive: true});
const bus = ['--run', `alone-${process.pid}`];
const key = join(folder, 'line');
execFileSync(rave, ['keys', 'line', key]);
/** A host, at a port for pages that the system chooses or that it had before. */
const startHost = (host, port = 0) =>
  spawn(
    rave,
    [
      'robot',
      scenario,
      '--host',
      host,
      '--web',
      `127.0.0.1:${port}`,
      '--web-key',
      `${key}.pub`,
      '--quiet',
      '--no-picture',
      '--replace',
      '--output',
      join(folder, host),
      ...bus,
    ],
    {stdio: ['ignore', 'ignore', 'inherit']},
  );
const children = ['left', 'right'].map((host) => startHost(host));
const gui = async (...words) => {
  const server = await startServer(rave, ['gui', scenario, ...words, ...bus]);
  children.push(server.child);
  return server;
};
const browser = await launch();
try {
  const page = await (await browser.newContext({viewport: {width: 1400, height: 900}})).newPage();
  showFailures(page, join(folder, 'failure.png'));
  const open = async (server) => {
    await page.goto(server.link);
    await until(
      page,
      `${newest} != null && ${newest}.time_s > 0.5 && [...${newest}.flags].every((flags) => flags & 1)`,
      60000,
    );
    await page.waitForTimeout(500);
  };

  await check(
    'without a line and without leave to relay, the server refuses an order with a sentence',
    async () => {
      const server = await gui();
      await open(server);
      const slot = await slotOf(page, 'anna');
      await page.evaluate((what) => document.querySelector('rave-app').selection.set([what]), slot);
      const before = await placeOf(page, slot);
      await page.keyboard.press('g');
      await clickAt(page, -1, 1);
      const card = page.locator('rave-world .beside.refused');
      await card.waitFor();
      assert.match(
        await card.innerText(),
        /Orders need a direct line to the host of the robot, and there is none; with `gui: \{relay: true\}` in the scenario the server forwards them\./,
      );
      await page.screenshot({path: join(folder, 'no-relay.png')});
      assert.deepEqual(await placeOf(page, slot), before);
      // A stop needs no leave.
      await page.evaluate(() =>
        document.querySelector('rave-app').link.send({type: 'halt', do: 'stop', slots: []}),
      );
      await until(page, `[...${newest}.flags].every((flags) => flags & 4)`);
      await page.evaluate(() =>
        document.querySelector('rave-app').link.send({type: 'halt', do: 'release', slots: []}),
      );
      await until(page, `[...${newest}.flags].every((flags) => !(flags & 4))`);
      await server.end();
    },
  );

  await check('goals by click arrive, at both hosts', async () => {
    const server = await gui('--line-key', key);
    await knowsHosts(server.link, 2);
    await open(server);
    await until(page, `${app}.link.direct.open.length === 2`, 60000);
    // A row of the Hosts panel comes with the state of its host, which may be later than the line.
    await until(
      page,
      `['left', 'right'].every((host) => ${app}.model.hosts.some(({name}) => name === host))`,
    );
    await sendByClick(page, 'anna', -1, 1);
    await sendByClick(page, 'ben', 1, -1);
  });

  await check('the stick drives, and letting go stops', () => driveByMouse(page, 'anna'));

  await check(
    'STOP holds a robot that is under way, ends its order, and the release lets it take another one',
    async () => {
      const ben = await slotOf(page, 'ben');
      const answer = await page.evaluate(
        (slot) => document.querySelector('rave-app').commands.goal([slot], [[1, 1.5]]),
        ben,
      );
      assert.equal(answer.good, true, answer.text);
      await until(page, `${newest}.speed[${ben}] > 0.05`);
      await page.getByRole('button', {name: /^STOP/}).first().click();
      await until(
        page,
        `[...${newest}.flags].every((flags, slot) => flags & 4 && ${newest}.speed[slot] === 0)`,
      );
      await page.screenshot({path: join(folder, 'stopped.png')});
      await page.evaluate(() =>
        document.querySelector('rave-app').link.send({type: 'halt', do: 'release', slots: []}),
      );
      await until(page, `[...${newest}.flags].every((flags) => !(flags & 4))`);
      await sendByClick(page, 'ben', 1, 0);
    },
  );

  await check(
    'a robot whose host is gone is stale on the page, in the picture and in its row',
    async () => {
      const [anna, ben] = [await slotOf(page, 'anna'), await slotOf(page, 'ben')];
      const row = page.locator('rave-robots .row', {hasText: 'ben'});
      await page.evaluate(`${app}.showPanel('robots')`);
      await row.waitFor();
      assert.doesNotMatch(await row.innerText(), /stale/);
      await page.evaluate(
        ([slot, stale]) => {
          const {model} = document.querySelector('rave-app');
          model.pictureChanged.on(() => {
            const {flags, time_s} = model.poses.newest;
            if ((flags[slot] & stale) !== 0) globalThis.stale_s ??= time_s;
          });
        },
        [ben, kStale],
      );
      children[1].kill('SIGKILL');
      const killed_s = await page.evaluate(`${newest}.time_s`);
      await until(page, 'globalThis.stale_s !== undefined');
      const after_s = (await page.evaluate('globalThis.stale_s')) - killed_s;
      console.log(`# stale ${after_s.toFixed(2)} s after the last picture before`);
      assert.ok(after_s < kStale_s, `${after_s} s`);
      assert.equal(
        await page.evaluate(`${newest}.flags[${anna}] & ${kStale}`),
        0,
        'the robot of the other host is not',
      );
      await row.getByText('pose stale').waitFor();
      // Nothing that is old is drawn as new: the body loses its fill.
      await until(page, `document.querySelector('rave-world').placed.flags[${ben}] & ${kStale}`);
      await page.screenshot({path: join(folder, 'stale.png')});
    },
  );

  await check('it takes no goal, and the page says so', async () => {
    const ben = await slotOf(page, 'ben');
    await until(page, `${app}.link.direct.open.length === 1`);
    const answer = await page.evaluate(
      (slot) => document.querySelector('rave-app').commands.goal([slot], [[1, 1]]),
      ben,
    );
    assert.equal(answer.good, false);
    const card = page.locator('rave-world .beside.refused');
    await card.waitFor();
    assert.match(
      (await card.innerText()).replaceAll('\n', ' '),
      /Orders need a direct line to the host of the robot, and there is none/,
    );
    await page.screenshot({path: join(folder, 'gone.png')});
  });

  const opened = `${app}.link.direct.open.map(({ticket}) => ticket.host).sort().join()`;
  await check(
    'a host that comes back at its address has its line again, without a reload',
    async () => {
      const port = await page.evaluate(
        `new URL(${app}.link.direct.lines.get('left').ticket.url).port`,
      );
      await page.evaluate('window.mark = 1');
      children[0].kill('SIGKILL');
      await until(page, `!${opened}.includes('left')`);
      children.push(startHost('left', port));
      await until(page, `${opened} === 'left'`, 60000);
      assert.equal(await page.evaluate('window.mark'), 1);
    },
  );

  await check(
    'one that comes back elsewhere needs a reload, says the page, and has its line after it',
    async () => {
      children.push(startHost('right'));
      const reload = page.locator('rave-way').getByRole('button', {name: 'Reload to reach right'});
      await reload.waitFor({timeout: 60000});
      assert.equal(await page.evaluate(opened), 'left');
      await page.screenshot({path: join(folder, 'elsewhere.png')});
      await reload.click();
      await until(page, `${app}?.link?.direct?.open.length === 2`, 60000);
      assert.equal(await reload.count(), 0);
    },
  );
  report();
} finally {
  await browser.close();
  for (const child of children) child.kill('SIGKILL');
}
process.exit(0);
