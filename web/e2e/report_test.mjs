// SPDX-License-Identifier: Apache-2.0
// The report of an experiment in a browser: node report_test.mjs RAVE FOLDER
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {mkdirSync, rmSync} from 'node:fs';
import {join} from 'node:path';
import {launch} from './browser.mjs';
import {check, report, showFailures} from './checks.mjs';

const [rave, folder] = process.argv.slice(2);
rmSync(folder, {recursive: true, force: true});
mkdirSync(folder, {recursive: true});
const swept = join(folder, 'prey-speed');
execFileSync(rave, ['sweep', 'prey-speed', '--output', swept, '--quiet']);
execFileSync(rave, ['report', swept, '--quiet']);

const browser = await launch();
const context = await browser.newContext({viewport: {width: 1280, height: 900}});
const page = await context.newPage();
showFailures(page, join(folder, 'report.png'));
const requests = [];
const errors = [];
page.on('request', (request) => requests.push(request.url()));
page.on('pageerror', (error) => errors.push(error.message));
page.on('console', (message) => {
  if (message.type() === 'error') errors.push(message.text());
});
const url = `file://${join(swept, 'report.html')}`;
await page.goto(url);

await check('asks for nothing but itself, and has no errors', async () => {
  assert.deepEqual(requests, [url]);
  assert.deepEqual(errors, []);
});

await check('has the question, the answer and the evidence', async () => {
  assert.equal(await page.textContent('h1'), 'How fast must a prey be to escape?');
  assert.match(await page.textContent('.answer'), /^capture_time: it comes later with speed=0.5 /);
  assert.equal(await page.locator('h2', {hasText: 'Comparisons named before the runs'}).count(), 1);
  assert.equal(await page.locator('td', {hasText: 'more, as expected'}).count(), 3);
});

await check('plots have their text as text, inside their picture', async () => {
  const outside = await page.evaluate(() =>
    [...document.querySelectorAll('svg text')]
      .filter((text) => {
        const a = text.getBoundingClientRect();
        const b = text.ownerSVGElement.getBoundingClientRect();
        return (
          a.left < b.left - 1 ||
          a.right > b.right + 1 ||
          a.top < b.top - 1 ||
          a.bottom > b.bottom + 1
        );
      })
      .map((text) => text.textContent),
  );
  assert.deepEqual(outside, []);
  assert.ok((await page.locator('svg text.axis', {hasText: 'capture_time, s'}).count()) > 0);
});

const colours = () =>
  page.evaluate(() => {
    const style = getComputedStyle(document.body);
    return [
      style.backgroundColor,
      style.color,
      getComputedStyle(document.querySelector('svg .mean')).fill,
    ];
  });

await check('is light or dark as the system is', async () => {
  await page.emulateMedia({colorScheme: 'light'});
  const light = await colours();
  await page.emulateMedia({colorScheme: 'dark'});
  const dark = await colours();
  light.forEach((colour, i) => assert.notEqual(colour, dark[i]));
  assert.equal(light[0], 'rgb(255, 255, 255)');
});

await check('fits a phone: only tables scroll sideways', async () => {
  await page.setViewportSize({width: 375, height: 800});
  const [wide, seen] = await page.evaluate(() => [
    document.documentElement.scrollWidth,
    document.documentElement.clientWidth,
  ]);
  assert.ok(wide <= seen, `${wide} px of ${seen}`);
});

await browser.close();
report();
