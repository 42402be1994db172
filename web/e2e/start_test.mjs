// SPDX-License-Identifier: Apache-2.0
// A page that outlives its runs: it starts, ends and restarts them, and others look on.
// node start_test.mjs RAVE SCENARIO FOLDER
import assert from 'node:assert/strict';
import {copyFileSync, existsSync, mkdirSync, readFileSync, rmSync} from 'node:fs';
import {join} from 'node:path';
import {launch, startServer} from './browser.mjs';
import {app, check, report, showFailures, until, untilHere} from './checks.mjs';
import {newest} from './commander.mjs';
import {touch} from './hands.mjs';
import {linkIn} from './invited.mjs';

const [rave, scenario, folder] = process.argv.slice(2);
rmSync(folder, {recursive: true, force: true});
mkdirSync(join(folder, 'scenarios'), {recursive: true});
copyFileSync(scenario, join(folder, 'scenarios/two-steps.yaml'));
let server = await startServer(rave, ['gui'], {cwd: folder});
const browsers = [];

/** A browser at a link, marked: a page that is loaded again loses the mark. */
async function open(link, joins = false) {
  const browser = await launch();
  browsers.push(browser);
  const page = await (await browser.newContext({viewport: {width: 1366, height: 768}})).newPage();
  const texts = [];
  page.on('websocket', (socket) =>
    socket.on('framereceived', ({payload}) => typeof payload === 'string' && texts.push(payload)),
  );
  await page.goto(link);
  if (joins) {
    await page.getByRole('button', {name: 'Join'}).click();
  }
  await touch(page);
  await page.evaluate('window.mark = true');
  return {browser, page, heard: (text) => texts.filter((line) => line.includes(text))};
}

const source = (word) => `${app}.model.hello?.run.source === '${word}'`;
const run = `${app}.model.conduct?.run`;
const ask = (page, request) =>
  page.evaluate(
    (what) => document.querySelector('rave-app').commands.ask({type: 'conduct', ...what}),
    request,
  );
const ended = (page, number) =>
  until(page, `${run}?.number === ${number} && ['ended', 'failed'].includes(${run}.state)`);
const told = (page) => page.evaluate(run);
const resultOf = ({folder: where}) =>
  JSON.parse(readFileSync(join(folder, where, 'result.json'), 'utf8'));
const gone = (process_id) => !existsSync(`/proc/${process_id}`);

try {
  const sue = await open(server.link);
  const {page} = sue;
  showFailures(page, join(folder, 'failure.png'));
  await check('without a run the page lists what can be started', async () => {
    await until(page, source('none'));
    await page.getByRole('button', {name: /^two-steps/}).waitFor();
    await page.getByRole('button', {name: /^flock/}).waitFor();
    await page.screenshot({path: join(folder, 'start.png')});
  });

  const made = await page.evaluate(() =>
    document.querySelector('rave-app').commands.ask({
      type: 'invitation',
      do: 'make',
      role: 'observer',
      teams: '*',
      uses: 1,
      days: 1,
      name: 'olga',
    }),
  );
  assert.equal(made.good, true, made.text);
  const link = await page.evaluate(
    `new URL(${app}.model.takeInvited(${made.request}), location.origin).href`,
  );
  const olga = await open(link, true);

  await check('an observer waits there, gets no list and starts nothing', async () => {
    await until(olga.page, source('none'));
    await olga.page.getByText('No run in progress').first().waitFor();
    const answer = await ask(olga.page, {do: 'start', name: 'two-steps'});
    assert.deepEqual([answer.good, answer.text], [false, 'Your rights do not include this.']);
    assert.ok(olga.heard('"type":"conduct"').length > 0);
    assert.deepEqual(olga.heard('"scenarios"'), []);
  });
  await check('what is no scenario of the list is refused', async () => {
    const answer = await ask(page, {do: 'start', name: '../../etc/passwd'});
    assert.equal(answer.good, false);
    assert.match(answer.text, /There is no scenario/);
    assert.equal((await ask(page, {do: 'open', name: '..'})).good, false);
    assert.equal((await ask(page, {do: 'end'})).good, false);
  });
  await check('a click starts a run, and all pages show it without a reload', async () => {
    await page.getByRole('button', {name: /^two-steps/}).click();
    await page.getByRole('button', {name: 'Start two-steps'}).click();
    for (const one of [page, olga.page])
      await until(
        one,
        `${source('live')} && ${app}.model.robots.length === 1 && ${newest} != null`,
      );
    assert.equal(await page.evaluate('window.mark'), true);
    assert.equal(await olga.page.evaluate('window.mark'), true);
    // Users of the scenario are invited, too.
    await untilHere(page, () => linkIn(server.said(), 'dora'), 'a link for the user');
    assert.equal((await ask(page, {do: 'start', name: 'flock'})).good, false);
  });
  await check('it is paused, stepped and continued from the page', async () => {
    const say = (message) =>
      page.evaluate((what) => document.querySelector('rave-app').link.send(what), message);
    const state = (word) => until(page, `${app}.model.time.state === '${word}'`);
    await say({type: 'transport', do: 'pause'});
    await state('paused');
    await say({type: 'transport', do: 'step', value: 1});
    await until(page, `${newest}.time_s > 0`);
    assert.equal(await page.evaluate(source('live')), true);
    await page.getByRole('radio', {name: 'Conduct'}).click();
    await page.getByRole('tab', {name: 'Run control'}).click();
    await page.getByLabel('Command', {exact: true}).fill('resume');
    await page.keyboard.press('Enter');
    await state('running');
  });
  await check('its recording follows, and its result is in the list', async () => {
    await ended(page, 1);
    await until(page, source('replay'));
    await until(olga.page, source('replay'));
    const {recordings} = await page.evaluate(`${app}.model.conduct`);
    assert.equal(recordings.length, 1);
    assert.equal(recordings[0].verdict, 'passed');
    assert.match(recordings[0].hash, /^[0-9a-f]{16}$/);
    const {due} = await told(page);
    assert.deepEqual(
      due.map(({name}) => name),
      ['off', 'half way'],
    );
  });
  await check('an exact restart: the same seed, the same hash, another folder', async () => {
    const first = await told(page);
    await ask(page, {do: 'restart'});
    await until(page, source('live'));
    await ended(page, 2);
    const second = await told(page);
    assert.notEqual(second.folder, first.folder);
    assert.equal(resultOf(second).hash, resultOf(first).hash);
    assert.equal(second.seed, first.seed);
  });
  await check('a run in progress can be begun anew with another seed, and ended', async () => {
    await ask(page, {do: 'restart'});
    await until(page, `${source('live')} && ${newest}?.time_s > 0.3`);
    await ask(page, {do: 'restart', seed: 7});
    await until(page, `${run}.number === 4 && ${run}.state === 'running'`);
    await until(page, `${source('live')} && ${newest}?.time_s > 0.3`);
    assert.equal((await told(page)).seed, 7);
    await ask(page, {do: 'end'});
    await ended(page, 4);
    const result = resultOf(await told(page));
    assert.equal(result.seed, 7);
    assert.ok(result.ended_by_hand_s < 5, `${result.ended_by_hand_s}`);
  });
  await check('a run that is killed leaves the page, which says so', async () => {
    await ask(page, {do: 'restart'});
    await until(page, `${run}.number === 5 && ${run}.process > 0`);
    const {process: id} = await told(page);
    process.kill(id, 'SIGKILL');
    await ended(page, 5);
    assert.equal((await told(page)).state, 'failed');
    assert.match((await told(page)).text, /signal 9/);
    assert.equal(await page.evaluate('window.mark'), true);
  });
  await check('the list comes back, and a recording is opened from it', async () => {
    await ask(page, {do: 'close'});
    await until(page, source('none'));
    await until(olga.page, source('none'));
    await page
      .getByRole('button', {name: /^Open /})
      .first()
      .waitFor();
    await page.screenshot({path: join(folder, 'list.png')});
    await page
      .getByRole('button', {name: /^Open /})
      .last()
      .click();
    await until(page, source('replay'));
    await until(olga.page, source('replay'));
    assert.equal(await page.evaluate('window.mark'), true);
  });
  await check('a run goes on without browsers, and is there when one comes back', async () => {
    await ask(page, {do: 'restart', seed: 3});
    await until(page, `${run}.number === 6 && ${run}.state === 'running'`);
    const state = await page.context().storageState();
    await sue.browser.close();
    const back = await launch();
    browsers.push(back);
    const again = await (await back.newContext({storageState: state})).newPage();
    await again.goto(new URL('/', server.link).href);
    await until(again, `${run}?.number === 6`);
    await ended(again, 6);
    assert.equal((await told(again)).state, 'ended');
  });
  await check('a run ends with the server that started it, also when that is killed', async () => {
    await server.end();
    server = await startServer(rave, ['gui'], {cwd: folder});
    const other = await open(server.link);
    await until(other.page, source('none'));
    assert.equal((await ask(other.page, {do: 'start', name: 'two-steps'})).good, true);
    await until(other.page, `${run}?.process > 0 && ${newest}?.time_s > 0.2`);
    const {process: id} = await told(other.page);
    server.child.kill('SIGKILL');
    await untilHere(other.page, () => gone(id), 'the run ends', 30_000);
  });
} finally {
  for (const browser of browsers) await browser.close();
  await server.end();
}
report();
