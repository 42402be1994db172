// SPDX-License-Identifier: Apache-2.0
// The main path in Firefox, also as wide as a tablet and a phone, driven through WebDriver BiDi:
// node firefox_test.mjs RAVE SCENARIO FOLDER
import assert from 'node:assert/strict';
import {existsSync, mkdirSync, rmSync} from 'node:fs';
import {join} from 'node:path';
import {launchFirefox, startServer, whereFirefox} from './browser.mjs';
import {app, check, report, showFailures, until} from './checks.mjs';

const [rave, scenario, folder] = process.argv.slice(2);
if (!existsSync(whereFirefox)) {
  console.log(
    `SKIPPED: there is no ${whereFirefox}; install the package firefox-esr, or name another Firefox in RAVE_FIREFOX.`,
  );
  process.exit(77);
}
rmSync(folder, {recursive: true, force: true});
mkdirSync(folder, {recursive: true});
const newest = `${app}.model.poses.newest`;
const kStopped = 4;
const stopped = `[...${newest}.flags].filter((flags) => flags & ${kStopped}).length`;
const gui = await startServer(rave, [
  'run',
  scenario,
  '--gui',
  '--quiet',
  '--no-picture',
  '--duration',
  '60',
  '--pace',
  '0.5x',
  '--output',
  join(folder, 'run'),
]);
const {origin} = new URL(gui.link);
const browser = await launchFirefox();
try {
  const context = await browser.newContext({viewport: {width: 1400, height: 900}});
  const page = await context.newPage();
  showFailures(page, join(folder, 'failed.png'));
  const errors = [];
  page.on('pageerror', (error) => errors.push(String(error)));
  page.on('console', (message) => message.type() === 'error' && errors.push(message.text()));

  await check('the link opens the run', async () => {
    await page.goto(gui.link);
    await until(page, `${app}?.model?.robots?.length === 16 && ${newest} !== null`);
    assert.match(await page.evaluate('navigator.userAgent'), /Firefox/);
    assert.equal(await page.evaluate(`${app}.model.hello.run.source`), 'live');
  });

  await check('the World View shows robots that move', async () => {
    const first = await page.evaluate(
      `({time_s: ${newest}.time_s, x: [...${newest}.x], painted: document.querySelector('rave-world').painted})`,
    );
    await until(
      page,
      `${newest}.time_s > ${first.time_s} + 1 && document.querySelector('rave-world').painted > ${first.painted} + 10`,
    );
    const x = await page.evaluate(`[...${newest}.x]`);
    assert.ok(
      x.filter((value, slot) => Math.abs(value - first.x[slot]) > 0.02).length > 5,
      'robots that moved',
    );
    const colours = await page.evaluate(() => {
      const canvas = document.querySelector('rave-world').renderRoot.querySelector('canvas');
      const {data} = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
      return new Set(new Uint32Array(data.buffer)).size;
    });
    assert.ok(colours > 50, `${colours} colours`);
  });

  await check('a click on a row selects, and its laser is read', async () => {
    await page.locator('rave-robots .row', {hasText: 'real-3'}).click();
    await until(
      page,
      `(() => { const a = ${app}; const slot = a.selection.primary;
      const laser = a.model.robots[slot]?.sensors.findIndex((sensor) => sensor.kind === 'ranges');
      return a.model.readings.of(slot, laser)?.rows === 121; })()`,
    );
    await page.locator('rave-sensors').getByText('121 rays').waitFor();
  });

  await check('a click in the World View selects the robot that is there', async () => {
    const stand = {type: 'halt', do: 'stop', slots: []};
    await page.evaluate((what) => document.querySelector('rave-app').link.send(what), stand);
    await until(page, `${stopped} === 16`);
    await page.waitForTimeout(500);
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
    await page.screenshot({path: join(folder, 'live.png')});
    await page.evaluate((what) => document.querySelector('rave-app').link.send(what), {
      ...stand,
      do: 'release',
    });
    await until(page, `${stopped} === 0`);
  });

  /** STOP at a page, and the button that is held to release. */
  const stopsAndReleases = async (there) => {
    await there.getByTitle('Stop all robots').click();
    await until(there, `${stopped} === 16`);
    const box = await there.getByRole('button', {name: /Hold to release/}).boundingBox();
    await there.mouse.move(box.x + 30, box.y + 30);
    await there.mouse.down();
    await until(there, `${stopped} === 0`);
    await there.mouse.up();
  };
  await check('STOP stops all robots; a button that is held releases them', () =>
    stopsAndReleases(page),
  );

  for (const [name, width, height] of [
    ['tablet', 820, 1180],
    ['phone', 390, 844],
  ]) {
    await check(
      `as wide as a ${name}: robots move, one is chosen and read, STOP and release`,
      async () => {
        const narrow = await browser.newContext({
          viewport: {width, height},
          storageState: await context.storageState(),
        });
        const there = await narrow.newPage();
        showFailures(there, join(folder, `failed-${name}.png`));
        there.on('pageerror', (error) => errors.push(String(error)));
        there.on('console', (message) => message.type() === 'error' && errors.push(message.text()));
        await there.goto(origin);
        await until(there, `${app}?.model?.robots?.length === 16 && ${newest} !== null`);
        assert.equal(await there.evaluate('innerWidth'), width);
        const first = await there.evaluate(
          `({time_s: ${newest}.time_s, painted: ${app}.world.painted})`,
        );
        await until(
          there,
          `${newest}.time_s > ${first.time_s} + 1 && ${app}.world.painted > ${first.painted} + 10`,
        );
        if (name === 'phone')
          await there.locator('nav').getByRole('button', {name: 'Robots'}).click();
        else await there.evaluate(`${app}.showPanel('robots')`);
        await there.locator('rave-robots .row', {hasText: 'real-3'}).click();
        if (name === 'phone') {
          await there.locator('nav').getByRole('button', {name: 'World'}).click();
          await there.locator('rave-sheet').getByText('real-3').waitFor();
          await there.locator('rave-sheet').getByRole('button', {name: 'Sensors'}).click();
          await there.locator('rave-sheet rave-sensors').getByText('121 rays').waitFor();
        } else {
          await there.evaluate(`${app}.showPanel('sensors')`);
          await there.locator('rave-sensors').getByText('121 rays').waitFor();
        }
        await stopsAndReleases(there);
        const wide = await there.evaluate(() => document.documentElement.scrollWidth);
        assert.ok(wide <= width, `${wide} px`);
        await there.screenshot({path: join(folder, `${name}.png`)});
        await narrow.close();
        showFailures(page, join(folder, 'failed.png'));
      },
    );
  }

  await check('a panel moves to a window of its own, and comes back', async () => {
    const group = page.locator('.dv-groupview', {has: page.locator('rave-world')});
    const [other] = await Promise.all([
      context.waitForEvent('page'),
      group.getByLabel('Open in a new window').click(),
    ]);
    await other.locator('rave-world').waitFor();
    const painted = await other.evaluate(`document.querySelector('rave-world').painted`);
    await until(other, `document.querySelector('rave-world').painted > ${painted} + 10`);
    assert.equal(
      await other.evaluate(
        `getComputedStyle(document.querySelector('rave-world').renderRoot.querySelector('.bar')).display`,
      ),
      'flex',
    );
    await Promise.all([
      other.waitForEvent('close'),
      other
        .getByLabel('Back into the page')
        .click()
        .catch(() => {}),
    ]);
    await page.locator('rave-world').waitFor();
  });

  await check('the run that is over is its own replay', async () => {
    await page.evaluate((what) => document.querySelector('rave-app').link.send(what), {
      type: 'transport',
      do: 'pace',
      value: 0,
    });
    await until(
      page,
      `${app}.model.hello.run.source === 'replay' && ${app}.model.may('seek')`,
      60000,
    );
    await page.getByLabel('Pause').or(page.getByLabel('Play')).first().waitFor();
    await page.keyboard.press('Control+k');
    await page.keyboard.type('12.5');
    await page.keyboard.press('Enter');
    await page.evaluate((what) => document.querySelector('rave-app').link.send(what), {
      type: 'transport',
      do: 'pause',
    });
    await until(
      page,
      `${newest}?.time_s > 12.4 && ${app}.model.time.state === 'paused' && ${newest}.step === ${app}.model.time.step`,
    );
    const step = await page.evaluate(`${newest}.step`);
    await page.keyboard.press('.');
    await until(page, `${newest}.step === ${step} + 1`);
    await page.screenshot({path: join(folder, 'replay.png')});
  });

  await check('nothing was complained of', () => assert.deepEqual(errors, []) ?? Promise.resolve());
} finally {
  await browser.close();
  gui.child.kill('SIGKILL');
}
report();
process.exit(0);
