// SPDX-License-Identifier: Apache-2.0
// Pictures of how a person commands, with a made-up run: node order_shots.mjs PAGE FOLDER [NAME].
// Those of docs/images are made with `command-dark` and `command-pen`.
import {mkdirSync} from 'node:fs';
import {join} from 'node:path';
import {launch} from './browser.mjs';
import {app, until} from './checks.mjs';
import {FakeRun} from './fake_run.mjs';
import {serveFake} from './fake_server.mjs';

const [pageFolder, folder, only = ''] = process.argv.slice(2);
mkdirSync(folder, {recursive: true});

function made() {
  const run = new FakeRun(16, {real: 5, now_s: 24, name: 'mixed-reality'});
  run.drives.get(9).lease = 'Ben K';
  run.drives.get(9).order = 'goal 2.00, 2.50';
  run.drives.get(6).lease = 'Ada N';
  run.say({to: 'all', text: 'Can you look behind the crate? I have walker-5 in the corner.'}, {name: 'Ben K', role: 'commander'});
  run.say({to: 'team', name: 'east', text: 'Sending walker-2 around. Team: keep clear of the pond.'});
  run.events.push({t: 24, until: 24, count: 1, kind: 'said', level: 'info', text: 'walker-2: said, going to (1.2, 0.4), 2.7 m', slots: [6]});
  return run;
}

const browser = await launch();
const place = (page, x, y) => page.evaluate(([wx, wy]) => {
  const world = document.querySelector('rave-world') ?? document.querySelector('rave-app').renderRoot.querySelector('rave-world');
  const box = world.renderRoot.querySelector('.canvas').getBoundingClientRect();
  const [px, py] = world.stage.screenAt(wx, wy);
  return [box.left + px, box.top + py];
}, [x, y]);

async function shot(name, [width, height], theme, act, options = {}) {
  if (only !== '' && only !== name) return;
  const server = await serveFake(pageFolder, made());
  const context = await browser.newContext({viewport: {width, height}, ...options});
  const page = await context.newPage();
  page.on('pageerror', (error) => console.error(`${name}: ${error}`));
  page.on('console', (message) => message.type() === 'error' && console.error(`${name}: ${message.text()}`));
  await page.addInitScript((value) => localStorage.setItem('rave.theme', value), theme);
  await page.goto(server.origin);
  await until(page, `${app}?.model?.poses?.newest != null`);
  await page.waitForTimeout(600);
  await act(page, server);
  await page.waitForTimeout(500);
  await page.screenshot({path: join(folder, `${name}.png`)});
  await context.close();
  await server.end();
}

async function drivePath(page) {
  await page.getByRole('radio', {name: 'Drive'}).click();
  await page.waitForTimeout(400);
  await page.evaluate(() => document.querySelector('rave-app').selection.set([6]));
  await page.keyboard.press('w');
  await page.mouse.move(...await place(page, -1, -1));
  await page.mouse.down();
  for (const [x, y] of [[-0.6, 0], [0, 0.8], [0.8, 1.2], [1.6, 1], [2.2, 0.2]]) await page.mouse.move(...await place(page, x, y), {steps: 5});
  await page.mouse.up();
}

await shot('command-dark', [1600, 1000], 'dark', drivePath);
await shot('command-light', [1600, 1000], 'light', async (page) => {
  await drivePath(page);
  const box = await page.locator('rave-joystick .stick').boundingBox();
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width * 0.42, box.y + box.height * 0.25);
});
await shot('refused-dark', [1280, 800], 'dark', async (page) => {
  await page.evaluate(() => document.querySelector('rave-app').selection.set([9]));
  await page.evaluate(() => document.querySelector('rave-app').commands.goal([9], [[1, 1]]));
  await page.keyboard.press('o');
  await page.mouse.move(...await place(page, -2, 2));
  await page.mouse.down();
  await page.mouse.move(...await place(page, -1.2, 1.4), {steps: 4});
});
await shot('ring-phone', [390, 844], 'dark', async (page) => {
  await page.evaluate(() => document.querySelector('rave-app').selection.set([6]));
  await page.waitForTimeout(200);
  const [x, y] = await place(page, 0, 0.5);
  await page.mouse.click(x, y, {button: 'right'});
}, {hasTouch: true, isMobile: true});
await shot('pen', [480, 640], 'light', async (page) => {
  await page.evaluate(() => document.querySelector('rave-app').selection.set([6]));
  await page.evaluate(() => document.querySelector('rave-app').commands.goal([6], [[1, 2]]));
}, {hasTouch: true});
await shot('command-pen', [480, 640], 'light', async (page) => {
  await page.evaluate(() => document.querySelector('rave-app').selection.set([6]));
  const [x, y] = await place(page, 0, 0);
  await page.mouse.click(x, y, {button: 'right'});
}, {hasTouch: true});
await shot('pen-stick', [480, 640], 'dark', async (page) => {
  await page.evaluate(() => document.querySelector('rave-app').selection.set([6]));
  await page.getByRole('button', {name: 'Drive', exact: true}).click();
}, {hasTouch: true});
await browser.close();
