// SPDX-License-Identifier: Apache-2.0
// Panels in windows of their own, as on two monitors: node windows_test.mjs RAVE SCENARIO FOLDER
import assert from 'node:assert/strict';
import {mkdirSync, rmSync} from 'node:fs';
import {join} from 'node:path';
import {launch, startServer} from './browser.mjs';
import {app, check, report, showFailures, until, watch} from './checks.mjs';

const [rave, scenario, folder] = process.argv.slice(2);
rmSync(folder, {recursive: true, force: true});
mkdirSync(folder, {recursive: true});
const gui = await startServer(rave, [
  'run',
  scenario,
  '--gui',
  '--quiet',
  '--output',
  join(folder, 'run'),
]);
const origin = new URL(gui.link).origin;
const browser = await launch();

/** Presses the button above a panel of the page, and gives the window that opens. */
async function moveOut(page, panel) {
  const group = page.locator('.dv-groupview', {has: page.locator(panel)});
  const [other] = await Promise.all([
    page.waitForEvent('popup'),
    group.getByLabel('Open in a new window').click(),
  ]);
  await other.locator(panel).waitFor();
  await other.locator('rave-window-bar').waitFor();
  return other;
}
const close = (other) =>
  Promise.all([
    other.waitForEvent('close'),
    other.evaluate(() => setTimeout(() => window.close())).catch(() => {}),
  ]);
/** How much of a canvas has been painted on, as the number of its colours. */
const colours = (other, selector) =>
  other.evaluate((name) => {
    const canvas = document.querySelector(name).renderRoot.querySelector('canvas');
    const {data} = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
    return new Set(new Uint32Array(data.buffer)).size;
  }, selector);

try {
  const context = await browser.newContext({
    viewport: {width: 1400, height: 900},
    colorScheme: 'dark',
  });
  const page = await context.newPage();
  showFailures(page, join(folder, 'failed.png'));
  const seen = [watch(page, origin)];
  context.on('page', (other) => seen.push(watch(other, origin)));
  await page.goto(gui.link);
  await until(page, `${app}?.model?.robots?.length === 16 && ${app}.model.poses.newest !== null`);
  await page.locator('rave-robots .row', {hasText: 'real-3'}).click();

  await check(
    'each named layout keeps its arrangement, for each user; one entry makes it as it was',
    async () => {
      const tab = (title) => page.locator('.dv-tab', {hasText: title});
      const groupOf = (title) => page.locator('.dv-groupview', {has: tab(title)});
      await tab('Log').dragTo(tab('Robots'));
      await groupOf('Log').locator('.dv-tab', {hasText: 'Robots'}).waitFor();
      await page.getByRole('radio', {name: 'Analyse'}).click();
      assert.equal(await groupOf('Log').locator('.dv-tab', {hasText: 'Robots'}).count(), 0);
      await page.getByRole('radio', {name: 'Watch'}).click();
      await groupOf('Log').locator('.dv-tab', {hasText: 'Robots'}).waitFor();
      const user = await page.evaluate(`${app}.model.user`);
      const keys = await page.evaluate(() =>
        Object.keys(localStorage)
          .filter((key) => key.startsWith('rave.layout.'))
          .sort(),
      );
      assert.deepEqual(
        keys,
        ['', '.Analyse', '.Watch'].map((name) => `rave.layout.${user}.wide${name}`),
      );
      // Somebody else at the same browser has their own.
      const become = (name) =>
        page.evaluate((other) => {
          const rave = document.querySelector('rave-app');
          rave.model.hello.user.name = other;
          rave.requestUpdate();
        }, name);
      await become('somebody');
      await groupOf('Log').locator('.dv-tab', {hasText: 'Robots'}).waitFor({state: 'detached'});
      await become(user);
      await groupOf('Log').locator('.dv-tab', {hasText: 'Robots'}).waitFor();
      await page.getByRole('button', {name: 'Reset layout'}).click();
      assert.equal(await groupOf('Log').locator('.dv-tab', {hasText: 'Robots'}).count(), 0);
      await page.locator('rave-robots .row', {hasText: 'real-3'}).click();
    },
  );

  await check(
    'each user has the layers of the World View that they chose, in each layout',
    async () => {
      const user = await page.evaluate(`${app}.model.user`);
      const layers = (what) =>
        page
          .evaluate(
            `(({grid, names}) => [grid, names].join())(document.querySelector('rave-world').layers)`,
          )
          .then((now) => assert.equal(now, what));
      const become = async (name) => {
        await page.evaluate((other) => {
          const rave = document.querySelector('rave-app');
          rave.model.hello.user.name = other;
          rave.requestUpdate();
        }, name);
        await page.waitForTimeout(200);
      };
      const press = async (name) => {
        await page.getByRole('button', {name: 'Layers'}).click();
        await page.locator('rave-world .menu').getByRole('switch', {name}).click();
        await page.getByRole('button', {name: 'Layers'}).click();
      };
      await press('Grid');
      await layers('false,true');
      await page.getByRole('radio', {name: 'Analyse'}).click();
      await layers('true,true');
      await page.getByRole('radio', {name: 'Watch'}).click();
      await layers('false,true');
      await become('somebody');
      await layers('true,true');
      await press('Names');
      await become(user);
      await layers('false,true');
      await page.reload();
      await until(
        page,
        `${app}?.model?.poses?.newest != null && document.querySelector('rave-world') !== null`,
      );
      await layers('false,true');
      await become('somebody');
      await layers('true,false');
      await become(user);
      await press('Grid');
      await page.locator('rave-robots .row', {hasText: 'real-3'}).click();
    },
  );

  let world;
  await check('the World View moves to a window of its own and goes on there', async () => {
    world = await moveOut(page, 'rave-world');
    assert.equal(await page.locator('rave-world').count(), 0);
    assert.equal(new URL(world.url()).pathname, '/assets/popout.html');
    assert.equal(await world.title(), 'World View · mixed-reality');
    const painted = await world.evaluate(`document.querySelector('rave-world').painted`);
    await until(world, `document.querySelector('rave-world').painted > ${painted} + 20`);
    assert.ok((await colours(world, 'rave-world')) > 20);
  });

  await check('it is dressed as the page: theme, fonts, styles of elements', async () => {
    const look = (where) =>
      where.evaluate(() => ({
        theme: document.documentElement.dataset.theme,
        background: getComputedStyle(document.body).backgroundColor,
        font: getComputedStyle(document.querySelector('.dv-tab')).fontFamily,
      }));
    assert.deepEqual(await look(world), await look(page));
    assert.equal(
      await world.evaluate(
        `document.querySelector('rave-world').renderRoot.adoptedStyleSheets.length > 0`,
      ),
      true,
    );
    assert.equal(
      await world.evaluate(
        `getComputedStyle(document.querySelector('rave-world').renderRoot.querySelector('.bar')).display`,
      ),
      'flex',
    );
    await page.getByLabel('Light or dark').click();
    assert.deepEqual(await look(world), await look(page));
    await world.screenshot({path: join(folder, 'world-light.png')});
    await page.getByLabel('Light or dark').click();
    await world.screenshot({path: join(folder, 'world-dark.png')});
  });

  await check('it grows with its window', async () => {
    await world.setViewportSize({width: 1000, height: 700});
    await until(
      world,
      `(() => { const canvas = document.querySelector('rave-world').renderRoot.querySelector('canvas');
      return Math.abs(canvas.clientWidth - 1000) < 4 && Math.abs(canvas.width - 1000 * devicePixelRatio) < 4; })()`,
    );
  });

  await check('a click there selects for all windows', async () => {
    const at = await world.evaluate(() => {
      const panel = document.querySelector('rave-world');
      const box = panel.renderRoot.querySelector('.canvas').getBoundingClientRect();
      const slot = panel.context.model.robots.findIndex((robot) => robot.name === 'real-1');
      const [x, y] = panel.screenOf(slot);
      return {x: box.left + x, y: box.top + y, slot};
    });
    await world.mouse.click(at.x, at.y);
    await until(page, `${app}.selection.primary === ${at.slot}`);
  });

  await check('the keys of the page work there', async () => {
    const following = `${app}.selection.following`;
    await world.keyboard.press('c');
    await until(page, following);
    await world.keyboard.press('t');
    await until(world, `document.querySelector('rave-world').mode === '3d'`);
    await world.keyboard.press('t');
    await until(world, `document.querySelector('rave-world').mode === 'top'`);
  });

  await check('a hidden page does not stop a window that is seen', async () => {
    await page.evaluate(
      `Object.defineProperty(document, 'visibilityState', {value: 'hidden', configurable: true}); document.dispatchEvent(new Event('visibilitychange'))`,
    );
    const step = await page.evaluate(`${app}.model.poses.newest.step`);
    await until(page, `${app}.model.poses.newest.step > ${step} + 30`);
    await page.evaluate(
      `delete document.visibilityState; document.dispatchEvent(new Event('visibilitychange'))`,
    );
  });

  await check('STOP is in every window', async () => {
    await world.locator('rave-window-bar').getByTitle('Stop all robots').click();
    await world.locator('rave-window-bar').getByText('Hold to release').first().waitFor();
    await page.locator('rave-run-bar').getByText('Hold to release').first().waitFor();
    const button = world
      .locator('rave-window-bar')
      .getByRole('button', {name: /Hold to release/})
      .first();
    const box = await button.boundingBox();
    await world.mouse.move(box.x + 20, box.y + 20);
    await world.mouse.down();
    await world.waitForTimeout(900);
    await world.mouse.up();
    await page.locator('rave-run-bar').getByText('STOP', {exact: true}).waitFor();
  });

  let sensors;
  await check('a second window, with a panel of several tabs', async () => {
    sensors = await moveOut(page, 'rave-sensors');
    await sensors.locator('rave-sensors').getByText(/rays/).first().waitFor();
    assert.equal(await page.locator('.dv-tab', {hasText: 'Sensor Display'}).count(), 0);
    await page.keyboard.press('3');
    await sensors.waitForTimeout(100);
    assert.equal(await page.locator('rave-sensors').count(), 0, 'it was not opened a second time');
    await sensors.screenshot({path: join(folder, 'sensors-dark.png')});
  });

  await check('a window that is closed returns its panel', async () => {
    await close(world);
    await page.locator('rave-world').waitFor();
    const painted = await page.evaluate(`document.querySelector('rave-world').painted`);
    await until(page, `document.querySelector('rave-world').painted > ${painted} + 10`);
    assert.equal(
      await page.evaluate(
        `getComputedStyle(document.querySelector('rave-world').renderRoot.querySelector('.bar')).display`,
      ),
      'flex',
    );
  });

  await check('so does the button of the window', async () => {
    world = await moveOut(page, 'rave-world');
    await Promise.all([
      world.waitForEvent('close'),
      world
        .getByLabel('Back into the page')
        .click()
        .catch(() => {}),
    ]);
    await page.locator('rave-world').waitFor();
  });

  await check(
    'after a reload all panels are in the page, and a press opens the window again',
    async () => {
      await Promise.all([sensors.waitForEvent('close'), page.reload()]);
      await until(page, `${app}?.model?.robots?.length === 16`);
      await page.locator('.dv-tab', {hasText: 'Sensor Display'}).waitFor();
      const [again] = await Promise.all([
        page.waitForEvent('popup'),
        page.getByText('Open Sensor Display').click(),
      ]);
      await again.locator('rave-sensors').waitFor();
      assert.equal(await page.getByText('Open Sensor Display').count(), 0);
      assert.equal(await page.locator('rave-sensors').count(), 0);
      sensors = again;
    },
  );

  await check('another layout takes the windows back', async () => {
    await Promise.all([
      sensors.waitForEvent('close'),
      page.evaluate(`${app}.dock.reset('Analyse')`),
    ]);
    await page.locator('rave-sensors').waitFor();
    await page.reload();
    await until(page, `${app}?.model?.robots?.length === 16`);
    assert.equal(await page.getByText('Open Sensor Display').count(), 0);
  });

  await check('nothing was asked of another origin, and nothing was complained of', async () => {
    assert.deepEqual(
      seen.flatMap(({foreign}) => foreign),
      [],
    );
    assert.deepEqual(
      seen.flatMap(({errors}) => errors),
      [],
    );
  });
} finally {
  await browser.close();
  gui.child.kill('SIGKILL');
}
report();
process.exit(0);
