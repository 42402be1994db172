// SPDX-License-Identifier: Apache-2.0
// What a commander does on the page, against a made-up run: node orders_test.mjs PAGE FOLDER
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {mkdirSync, readdirSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';
import {gzipSync} from 'node:zlib';
import {launch} from './browser.mjs';
import {app, check, report, showFailures, until, untilHere, watch} from './checks.mjs';
import {checkComponents} from './component_checks.mjs';
import {checkDriving} from './driving_checks.mjs';
import {FakeRun} from './fake_run.mjs';
import {serveFake} from './fake_server.mjs';
import {checkHand} from './hand_check.mjs';
import {clickAt, dragThrough, freePlace, placeOf, stubPad} from './hands.mjs';

const [pageFolder, folder] = process.argv.slice(2);
const kFirstLoad = 300_000;
const axe = readFileSync(new URL('../node_modules/axe-core/axe.min.js', import.meta.url), 'utf8');
rmSync(folder, {recursive: true, force: true});
mkdirSync(folder, {recursive: true});

const browser = await launch();
const server = await serveFake(pageFolder, new FakeRun(16, {real: 5}));
const heard = (type, kind) =>
  server.heard.filter(
    (message) =>
      message.type === type && (kind === undefined || message.kind === kind || message.do === kind),
  );
const last = (type, kind) => heard(type, kind).at(-1);
const choose = (page, ...slots) =>
  page.evaluate((what) => document.querySelector('rave-app').selection.set(what), slots);
const pending = (page) =>
  page.evaluate(`${app}.commands.pending.map(({kind, state, text}) => ({kind, state, text}))`);

async function opened(context) {
  const page = await context.newPage();
  await page.goto(server.origin);
  await until(page, `${app}?.model?.poses?.newest != null && ${app}.model.drives.size === 16`);
  await page.waitForTimeout(300);
  return page;
}

/** No serious finding of axe-core; it is injected past the page's policy. */
async function seriousOf(page) {
  await page.evaluate(axe);
  return page.evaluate(() =>
    window.axe
      .run(document, {resultTypes: ['violations']})
      .then(({violations}) =>
        violations
          .filter(({impact}) => impact === 'serious' || impact === 'critical')
          .map(({id, nodes}) => `${id}: ${nodes.map(({html}) => html.slice(0, 120)).join(' | ')}`),
      ),
  );
}

try {
  const context = await browser.newContext({viewport: {width: 1500, height: 950}});
  await stubPad(context);
  const page = await opened(context);
  const seen = watch(page, server.origin);
  showFailures(page, join(folder, 'failure.png'));

  await check('the page is small enough to come at once', async () => {
    const assets = readdirSync(join(pageFolder, 'assets')).filter((name) =>
      /^index.*\.(js|css)$/.test(name),
    );
    const bytes = assets.reduce(
      (sum, name) => sum + gzipSync(readFileSync(join(pageFolder, 'assets', name))).length,
      0,
    );
    assert.ok(assets.length >= 2 && bytes < kFirstLoad, `${bytes} bytes`);
  });

  await check('a click is a goal, which is drawn until the robot is there', async () => {
    await choose(page, 6);
    await page.keyboard.press('g');
    const [x, y] = await freePlace(page);
    await clickAt(page, x, y);
    await untilHere(page, () => heard('order', 'goal').length === 1, 'a goal');
    const {slots, points} = last('order', 'goal');
    assert.deepEqual(slots, [6]);
    assert.ok(Math.hypot(points[0][0] - x, points[0][1] - y) < 0.05);
    await until(page, `${app}.commands.pending[0]?.state === 'taken'`);
    server.run.drives.get(6).order = '';
    server.say(server.run.leases([6]));
    await until(page, `${app}.commands.pending.length === 0`);
  });

  await check('a team is sent to places of their own', async () => {
    await choose(page, 6, 10, 14);
    const [x, y] = await freePlace(page);
    await clickAt(page, x, y);
    await untilHere(page, () => last('order', 'goal')?.slots.length === 3, 'three goals');
    const {points} = last('order', 'goal');
    assert.equal(new Set(points.map(String)).size, 3);
    assert.ok(points.every(([px, py]) => Math.hypot(px - x, py - y) < 2));
  });

  await check('the team of the selected robot is stopped with one press', async () => {
    const halts = heard('halt').length;
    const {team} = server.run.robots[6];
    const members = server.run.robots.flatMap((robot, slot) => (robot.team === team ? [slot] : []));
    const button = page.locator('rave-robots').getByRole('button', {name: 'Stop team'});
    assert.equal(await button.count(), 1);
    await button.click();
    await untilHere(page, () => heard('halt').length === halts + 1, 'a stop');
    assert.deepEqual(last('halt'), {type: 'halt', do: 'stop', slots: members});
    await page.locator('rave-robots').getByRole('button', {name: 'Team stopped'}).waitFor();
    server.run.stopped.clear();
    await button.waitFor();
  });

  await check('a drag with the tool is a path, which Enter sends and Escape drops', async () => {
    await choose(page, 6);
    await page.keyboard.press('w');
    const line = [
      [-1, -1],
      [0, 0.5],
      [1, 0],
      [2, 1],
    ];
    await dragThrough(page, line);
    await until(
      page,
      `document.querySelector('rave-world').renderRoot.querySelector('.beside.draft') !== null`,
    );
    await page.keyboard.press('Escape');
    await page.keyboard.press('Enter');
    assert.equal(heard('order', 'path').length, 0);
    await dragThrough(page, line);
    await page.keyboard.press('Enter');
    await untilHere(page, () => heard('order', 'path').length === 1, 'a path');
    const {points} = last('order', 'path');
    assert.ok(points.length > 8 && points.length <= 400);
    await page.waitForTimeout(200);
    await page.screenshot({path: join(folder, 'path.png')});
    assert.ok(Math.hypot(points.at(-1)[0] - 2, points.at(-1)[1] - 1) < 0.15);
  });

  await check('a refusal stands beside the goal until it is dropped', async () => {
    server.run.drives.get(8).lease = 'Ben K';
    server.say(server.run.leases([8]));
    await choose(page, 8);
    await page.keyboard.press('g');
    const [x, y] = await freePlace(page);
    await clickAt(page, x, y);
    const card = page.locator('rave-world .beside.refused');
    await card.waitFor();
    assert.match(await card.innerText(), /`Ben K` drives walker-4/);
    await page.screenshot({path: join(folder, 'refused.png')});
    await card.getByRole('button', {name: 'Drop'}).click();
    assert.deepEqual(
      (await pending(page)).filter(({state}) => state === 'refused'),
      [],
    );
    await page.keyboard.press('Escape');
  });

  await check('a drag that begins at the selected robot draws its path', async () => {
    await page.keyboard.press('v');
    server.run.state = 'paused';
    await page.waitForTimeout(300);
    await choose(page, 6);
    const [x, y] = server.run.place(6);
    await dragThrough(page, [
      [x, y],
      [x + 0.5, y + 0.8],
      [x + 1, y + 1],
    ]);
    await until(page, `document.querySelector('rave-world').orders.desk.draft?.kind === 'path'`);
    await page.keyboard.press('Escape');
  });

  await check('boxes, discs and polygons are drawn, moved, turned and removed', async () => {
    await page.keyboard.press('o');
    const [x, y] = await freePlace(page, 0.9);
    await dragThrough(page, [
      [x - 0.3, y - 0.2],
      [x + 0.3, y + 0.2],
    ]);
    await untilHere(page, () => heard('edit', 'add').length === 1, 'a box');
    assert.equal(last('edit').polygon.length, 4);
    assert.ok(Math.hypot(last('edit').pose[0] - x, last('edit').pose[1] - y) < 0.05);
    // It is the run that puts it there.
    await until(
      page,
      `[...${app}.model.bodies.values()].some(({name}) => name === ${JSON.stringify(last('edit').name)})`,
    );
    await page.waitForTimeout(200);
    await page.keyboard.press('v');
    await clickAt(page, x, y);
    await page.getByRole('button', {name: 'Turn left'}).click();
    await untilHere(page, () => heard('edit', 'move').length === 1, 'a turn');
    assert.ok(Math.abs(last('edit').pose[2] - Math.PI / 12) < 1e-6);
    await page.waitForTimeout(150);
    await dragThrough(page, [
      [x, y],
      [x + 0.2, y + 0.3],
    ]);
    await untilHere(page, () => heard('edit', 'move').length === 2, 'a move');
    assert.ok(Math.hypot(last('edit').pose[0] - x - 0.2, last('edit').pose[1] - y - 0.3) < 0.05);
    await page.keyboard.press('Delete');
    await untilHere(page, () => heard('edit', 'remove').length === 1, 'it goes');
    await page.keyboard.press('o');
    await page.getByRole('radio', {name: 'disc'}).click();
    await dragThrough(page, [
      [x, y],
      [x + 0.3, y],
    ]);
    await untilHere(page, () => heard('edit', 'add').length === 2, 'a disc');
    assert.ok(Math.abs(last('edit').disc - 0.3) < 0.03);
    await page.getByRole('radio', {name: 'polygon'}).click();
    const [px, py] = await freePlace(page, 0.8);
    for (const [dx, dy] of [
      [0, 0],
      [0.4, 0],
      [0.4, 0.4],
      [0, 0],
    ])
      await clickAt(page, px + dx, py + dy);
    await untilHere(page, () => heard('edit', 'add').length === 3, 'a polygon');
    assert.equal(last('edit').polygon.length, 3);
    await page.keyboard.press('v');
  });

  await check('a robot is placed', async () => {
    await choose(page, 6);
    await page.keyboard.press('b');
    const [x, y] = await freePlace(page);
    await clickAt(page, x, y);
    await untilHere(page, () => heard('order', 'place').length === 1, 'it is placed');
    assert.deepEqual(last('order', 'place').slots, [6]);
    await page.keyboard.press('v');
    server.run.state = 'running';
  });

  await check(
    'the menu of a robot comes with the right button, and by keys it is left',
    async () => {
      await choose(page, 6);
      const [x, y] = await placeOf(page, ...(await freePlace(page)));
      await page.mouse.click(x, y, {button: 'right'});
      const ring = page.locator('rave-ring');
      await ring.getByRole('menuitem', {name: 'Goal'}).waitFor();
      assert.equal(await ring.getByRole('menuitem').count(), 6);
      await page.screenshot({path: join(folder, 'ring.png')});
      await page.keyboard.press('Escape');
      await until(
        page,
        `document.querySelector('rave-world').renderRoot.querySelector('rave-ring') === null`,
      );
      await page.mouse.click(x, y, {button: 'right'});
      await ring.getByRole('menuitem', {name: 'Stop'}).click();
      await untilHere(page, () => JSON.stringify(last('halt')?.slots) === '[6]', 'it stops');
      server.run.stopped.clear();
    },
  );

  const {stick, drive, stands} = await checkDriving(page, server, choose, folder);

  await check('whoever drives is shown, and is asked before it is taken', async () => {
    server.run.drives.get(10).lease = 'Ben K';
    server.say(server.run.leases([10]));
    await choose(page, 10);
    const lease = page.locator('rave-joystick rave-lease');
    await lease.getByText('Ben K drives').waitFor();
    const count = server.run.driven.length;
    await stick.click({force: true});
    assert.equal(server.run.driven.length, count);
    await lease.getByRole('button', {name: 'Ask'}).click();
    await untilHere(page, () => last('say')?.name === 'Ben K', 'a question in the chat');
    await lease.getByRole('button', {name: 'Take …'}).click();
    assert.equal(heard('lease').length, 0);
    await lease.getByRole('button', {name: 'Take it from Ben K'}).click();
    await lease.getByText('You hold the lease').waitFor();
    assert.equal(last('lease').do, 'force');
    await lease.getByRole('button', {name: 'Give back'}).click();
    await lease.getByText('No person drives').waitFor();
  });

  await check('a parameter of the robot is set within its range', async () => {
    await choose(page, 6);
    const slider = page.locator('rave-robot input[type=number]').first();
    await slider.fill('0.35');
    await slider.press('Enter');
    await untilHere(page, () => last('set')?.value === 0.35, 'it is set');
    assert.deepEqual(last('set'), {...last('set'), slots: [6], key: 'program.cruise_mps'});
  });

  await check('people and robots talk', async () => {
    const chat = page.locator('rave-chat');
    await chat.getByRole('radio', {name: 'walker-2'}).click();
    await chat.locator('textarea').fill('Where are you?');
    await chat.locator('textarea').press('Enter');
    await untilHere(
      page,
      () => last('say')?.to === 'robot' && last('say').slot === 6,
      'the robot is asked',
    );
    server.run.events.push({
      t: server.run.now_s + 1,
      until: server.run.now_s + 1,
      count: 1,
      kind: 'said',
      level: 'info',
      text: 'walker-2: said, in the corner',
      slots: [6],
    });
    server.say({
      type: 'events',
      reset: false,
      first: server.run.events.length - 1,
      events: [server.run.events.at(-1)],
    });
    await chat.getByText('in the corner', {exact: true}).waitFor();
    assert.match(await chat.locator('.lines').innerText(), /Where are you\?/);
    await page.screenshot({path: join(folder, 'chat.png')});
  });

  await checkComponents({page, browser, server, folder});

  await check('axe-core finds nothing serious', async () => {
    await page.getByRole('radio', {name: 'Drive'}).click();
    await page.waitForTimeout(300);
    assert.deepEqual(await seriousOf(page), []);
  });

  await check('a lost link ends the hold', async () => {
    await stick.focus();
    await page.keyboard.down('w');
    await untilHere(page, () => drive()?.[1] > 0.1, 'it goes');
    for (const socket of server.sockets.clients) socket.terminate();
    await until(page, `document.querySelector('rave-joystick').loop.held === null`, 2000);
    await page.keyboard.up('w');
    const foreign = seen.errors.filter(
      (text) => !/cells|gone\.js|WebSocket|Failed to load resource/.test(text),
    );
    assert.deepEqual(foreign, []);
    assert.deepEqual(seen.foreign, []);
    await page.close();
  });

  for (const [name, width, height] of [
    ['phone', 390, 844],
    ['pen', 480, 640],
  ])
    await checkHand({
      name,
      width,
      height,
      browser,
      server,
      folder,
      opened,
      choose,
      heard,
      drive,
      stands,
      seriousOf,
    });

  await check('who looks on has no tools and no stick', async () => {
    server.turnInto({may: ['readings', 'log'], role: 'observer'});
    const other = await browser.newContext({viewport: {width: 1500, height: 950}});
    const eve = await opened(other);
    assert.equal(await eve.locator('rave-world .tool').count(), 0);
    assert.equal(await eve.getByRole('radio', {name: 'Drive'}).count(), 0);
    await choose(eve, 6);
    await eve.keyboard.press('g');
    const orders = heard('order').length;
    const [x, y] = await freePlace(eve);
    await clickAt(eve, x, y);
    await eve.waitForTimeout(200);
    assert.equal(heard('order').length, orders);
    await other.close();
  });

  await check('every message of the page is as the schema describes it', async () => {
    const file = join(folder, 'messages.json');
    writeFileSync(file, JSON.stringify(server.heard));
    execFileSync('python3', [new URL('check_messages.py', import.meta.url).pathname, file], {
      stdio: 'inherit',
    });
    for (const type of ['order', 'lease', 'set', 'edit', 'say'])
      assert.ok(heard(type).length > 0, type);
  });
} finally {
  await browser.close();
  await server.end();
}
report();
process.exit(0);
