// SPDX-License-Identifier: Apache-2.0
// Pictures of the page: node web/e2e/shots.mjs RAVE RECORDING FOLDER [SECONDS] [ROBOT]
import {mkdirSync} from 'node:fs';
import {join} from 'node:path';
import {launch, startServer} from './browser.mjs';

const [rave, recording, folder, seconds = '17.5', robot = ''] = process.argv.slice(2);
const kViews = [
  ['desktop-dark', 1600, 1000, 'dark'],
  ['desktop-light', 1600, 1000, 'light'],
  ['tablet-dark', 820, 1100, 'dark'],
  ['phone-dark', 390, 844, 'dark'],
];

mkdirSync(folder, {recursive: true});
const gui = await startServer(rave, ['gui', recording]);
const browser = await launch();
const context = await browser.newContext();
const first = await context.newPage();
await first.goto(gui.link);
const origin = new URL(gui.link).origin;
for (const [name, width, height, theme] of kViews) {
  const page = await context.newPage();
  page.on('console', (message) => message.type() === 'error' && console.error(`${name}: ${message.text()}`));
  page.on('pageerror', (error) => console.error(`${name}: ${error}`));
  await page.setViewportSize({width, height});
  await page.addInitScript((value) => localStorage.setItem('rave.theme', value), theme);
  await page.goto(`${origin}/#t=${seconds}`);
  await page.waitForSelector('rave-world');
  await page.waitForTimeout(1500);
  await page.keyboard.press('k');
  if (robot) await page.evaluate((wanted) => {
    const app = document.querySelector('rave-app');
    app.selection.set([app.model.robots.findIndex((known) => known.name === wanted)]);
  }, robot);
  await page.waitForTimeout(1200);
  await page.screenshot({path: join(folder, `${name}.png`)});
  await page.close();
}
await browser.close();
await gui.end();
