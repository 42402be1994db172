// SPDX-License-Identifier: Apache-2.0
// A direct line with TLS: a browser that does not know the certificate of the host is told what to
// do, and one that trusts it has the line. node trust_test.mjs RAVE SCENARIO FOLDER
import assert from 'node:assert/strict';
import {execFileSync, spawn} from 'node:child_process';
import {createHash, X509Certificate} from 'node:crypto';
import {mkdirSync, readFileSync, rmSync} from 'node:fs';
import {join} from 'node:path';
import {knowsHosts, launch, startServer} from './browser.mjs';
import {app, check, report, showFailures, until} from './checks.mjs';
import {newest, sendByClick, slotOf} from './commander.mjs';

const [rave, scenario, folder] = process.argv.slice(2);
rmSync(folder, {recursive: true, force: true});
mkdirSync(folder, {recursive: true});
const bus = ['--run', `trust-${process.pid}`];
const key = join(folder, 'line');
const keys = join(folder, 'keys');
execFileSync(rave, ['keys', 'line', key]);
execFileSync(rave, ['keys', 'web', keys, '127.0.0.1']);
const certificate = join(keys, 'server.pem');
const children = ['left', 'right'].map((host) =>
  spawn(
    rave,
    [
      'robot',
      scenario,
      '--host',
      host,
      '--web',
      '127.0.0.1:0',
      '--web-key',
      `${key}.pub`,
      '--web-certificate',
      certificate,
      '--web-certificate-key',
      join(keys, 'server_key.pem'),
      '--quiet',
      '--no-picture',
      '--no-record',
      '--output',
      join(folder, host),
      ...bus,
    ],
    {stdio: ['ignore', 'ignore', 'inherit']},
  ),
);
const gui = await startServer(rave, ['gui', scenario, '--line-key', key, ...bus]);
children.push(gui.child);
/** Chromium's way to say that a certificate is trusted: the hash of its key. */
const spki = createHash('sha256')
  .update(
    new X509Certificate(readFileSync(certificate)).publicKey.export({type: 'spki', format: 'der'}),
  )
  .digest('base64');
const browsers = [];

async function opened(link, ...args) {
  const browser = await launch(...args);
  browsers.push(browser);
  const page = await (await browser.newContext({viewport: {width: 1400, height: 900}})).newPage();
  showFailures(page, join(folder, 'failure.png'));
  await page.goto(link);
  await until(page, `${newest} != null && ${newest}.time_s > 0.5`, 60000);
  return page;
}

try {
  let cookies = null;
  await check(
    'a certificate that the browser does not know is explained, with the address to trust',
    async () => {
      await knowsHosts(gui.link, 2);
      const page = await opened(gui.link);
      cookies = await page.context().storageState();
      await until(
        page,
        `[...${app}.link.direct.lines.values()].some((line) => line.state === 'untrusted')`,
        60000,
      );
      await page
        .locator('rave-way')
        .getByRole('button', {name: /Trust (left|right)/})
        .click();
      const sheet = page.getByRole('dialog', {name: 'Trust a host'});
      await sheet
        .getByText('In most cases it does not trust the certificate of the host yet')
        .waitFor();
      await sheet.getByText('authority.pem').waitFor();
      assert.match(
        await sheet
          .getByRole('link', {name: /left|right/})
          .first()
          .getAttribute('href'),
        /^https:\/\/127\.0\.0\.1:\d+\/$/,
      );
      await page.screenshot({path: join(folder, 'untrusted.png')});
      await page.keyboard.press('Escape');
      const answer = await page.evaluate(
        (slot) => document.querySelector('rave-app').commands.goal([slot], [[-1, 0.5]]),
        await slotOf(page, 'anna'),
      );
      assert.equal(answer.good, false, 'without a line nothing is ordered');
      await page.context().browser().close();
    },
  );

  await check('a browser that trusts it has the line, and orders by it', async () => {
    const browser = await launch(`--ignore-certificate-errors-spki-list=${spki}`);
    browsers.push(browser);
    const page = await (
      await browser.newContext({viewport: {width: 1400, height: 900}, storageState: cookies})
    ).newPage();
    showFailures(page, join(folder, 'failure.png'));
    await page.goto(new URL('/', gui.link).href);
    await until(page, `${newest} != null && ${app}.link.direct.open.length === 2`, 60000);
    assert.ok(
      await page.evaluate(
        `[...${app}.link.direct.lines.values()].every((line) => line.ticket.url.startsWith('wss:'))`,
      ),
    );
    await sendByClick(page, 'anna', -1, 0.8);
    await sendByClick(page, 'ben', 1, 0.8);
    const [address] = await page.evaluate(
      `[...${app}.link.direct.lines.values()].map((line) => line.ticket.url.replace('wss:', 'https:'))`,
    );
    const there = await page.context().newPage();
    await there.goto(new URL('/', address).href);
    await there.screenshot({path: join(folder, 'host.png')});
    assert.match(await there.locator('body').innerText(), /back/i);
  });
  report();
} finally {
  for (const browser of browsers) await browser.close();
  for (const child of children) child.kill('SIGKILL');
}
process.exit(0);
