// SPDX-License-Identifier: Apache-2.0
// A server that stands still closes no connection: the page notices all the same. node
// silent_test.mjs RAVE SCENARIO FOLDER
import assert from 'node:assert/strict';
import {mkdirSync, rmSync} from 'node:fs';
import {join} from 'node:path';
import {launch, startServer} from './browser.mjs';
import {app, check, report, showFailures, until} from './checks.mjs';
import {newest} from './commander.mjs';

const [rave, scenario, folder] = process.argv.slice(2);
/** The page takes 3 s without a message for silence. */
const kTold_ms = 5000;

rmSync(folder, {recursive: true, force: true});
mkdirSync(folder, {recursive: true});
const server = await startServer(rave, [
  'run',
  scenario,
  '--gui',
  '--pace',
  'realtime',
  '--quiet',
  '--no-picture',
  '--duration',
  '60',
  '--output',
  join(folder, 'run'),
]);
const browser = await launch();
const say = (page, message) =>
  page.evaluate((what) => document.querySelector('rave-app').link.send(what), message);
/** Counts how often the link was lost, and the messages `time`. */
const watchLink = (page) =>
  page.evaluate(() => {
    const {link, model} = document.querySelector('rave-app');
    const seen = (globalThis.seen = {losses: 0, times: 0, state: link.state});
    link.changed.on(() => {
      if (link.state === 'lost' && seen.state !== 'lost') ++seen.losses;
      seen.state = link.state;
    });
    model.timeChanged.on(() => {
      ++seen.times;
    });
  });

/** The server tells the time once a second: for longer than a silent link is kept, without a
 * loss. */
async function staysLive(page) {
  await watchLink(page);
  await until(page, 'globalThis.seen.times >= 6');
  assert.equal(await page.evaluate('globalThis.seen.losses'), 0);
}

try {
  const page = await (await browser.newContext({viewport: {width: 1400, height: 900}})).newPage();
  showFailures(page, join(folder, 'failure.png'));
  await page.goto(server.link);
  await until(page, `${newest} != null && ${newest}.time_s > 0.5`);
  const stop = page.locator('rave-stop button.stop');

  await check(
    'a server that stands still is a lost link within 5 s, and STOP is out of reach',
    async () => {
      assert.equal(await page.locator('rave-top-bar .state').innerText(), 'Live');
      server.child.kill('SIGSTOP');
      await until(page, `${app}.link.state === 'lost'`, kTold_ms);
      await page.locator('rave-top-bar .state', {hasText: 'Link lost'}).waitFor();
      const [, ago_s] = /Link lost (\d+\.\d) s ago/.exec(await page.getByRole('alert').innerText());
      assert.ok(Number(ago_s) >= 3, `since the last message: ${ago_s} s`);
      assert.ok(await stop.isDisabled());
      assert.match(await stop.innerText(), /out of reach/);
      await page.screenshot({path: join(folder, 'lost.png')});
    },
  );

  await check('it is live again when the server goes on, by itself', async () => {
    const before = await page.evaluate(`${newest}.time_s`);
    server.child.kill('SIGCONT');
    await until(
      page,
      `${app}.link.state === 'open' && ${newest} != null && ${newest}.time_s > ${before} + 0.5`,
    );
    await page.locator('rave-top-bar .state', {hasText: 'Live'}).waitFor();
    assert.ok(await stop.isEnabled());
    assert.equal(await page.getByRole('alert').count(), 0);
  });

  await check('a run that is held, and a page that looks at nothing, are no silence', async () => {
    await say(page, {type: 'transport', do: 'pause'});
    await until(page, `${app}.model.time.state === 'paused'`);
    await staysLive(page);
  });

  await check('neither is a replay that is held', async () => {
    await say(page, {type: 'transport', do: 'pace', value: 0});
    await say(page, {type: 'transport', do: 'play'});
    await until(
      page,
      `${app}.model.hello.run.source === 'replay' && ${app}.model.may('seek')`,
      60000,
    );
    await say(page, {type: 'transport', do: 'pause'});
    await until(page, `${app}.model.time.state === 'paused'`);
    await staysLive(page);
  });
} finally {
  await browser.close();
  server.child.kill('SIGKILL');
}
report();
process.exit(0);
