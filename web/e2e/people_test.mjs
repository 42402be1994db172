// SPDX-License-Identifier: Apache-2.0
// People with accounts of their own command one run: who drives, and who hears what.
// node people_test.mjs RAVE SCENARIO FOLDER
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {mkdirSync, rmSync} from 'node:fs';
import {join} from 'node:path';
import {launch, startServer} from './browser.mjs';
import {app, check, report, showFailures, until, untilHere} from './checks.mjs';
import {choose, newest, slotOf} from './commander.mjs';
import {clickAt} from './hands.mjs';

const [rave, scenario, folder] = process.argv.slice(2);
rmSync(folder, {recursive: true, force: true});
mkdirSync(folder, {recursive: true});
const accounts = join(folder, 'accounts');
const kPeople = [
  ['olga', 'red'],
  ['paul', 'red'],
  ['quinn', 'blue'],
];
for (const [name, team] of kPeople) {
  execFileSync(
    rave,
    ['people', 'add', name, '--role', 'commander', '--teams', team, '--accounts', accounts],
    {input: `${name} has a horse\n`, stdio: ['pipe', 'ignore', 'inherit']},
  );
}
const server = await startServer(rave, [
  'run',
  scenario,
  '--gui',
  '--accounts',
  accounts,
  '--quiet',
  '--no-picture',
  '--pace',
  'realtime',
  '--output',
  join(folder, 'run'),
]);
const {origin} = new URL(server.link);
const browsers = [];

/** Somebody with a browser of their own, signed in, and every text that the server sent them. */
async function person(name) {
  const browser = await launch();
  browsers.push(browser);
  const page = await (await browser.newContext({viewport: {width: 1400, height: 900}})).newPage();
  const texts = [];
  page.on('websocket', (socket) =>
    socket.on('framereceived', ({payload}) => typeof payload === 'string' && texts.push(payload)),
  );
  await page.goto(`${origin}/`);
  await page.fill('#name', name);
  await page.fill('#password', `${name} has a horse`);
  await page.click('button');
  await until(page, `${app}?.model?.robots?.length === 3 && ${newest} != null`, 60000);
  await page.getByRole('radio', {name: 'Drive'}).click();
  const heard = (text) => texts.filter((line) => line.includes(text));
  return {
    name,
    page,
    heard,
    lease: page.locator('rave-joystick rave-lease'),
    chat: page.locator('rave-chat'),
  };
}

/** Says something in the panel Chat, to one of its addressees. */
async function say({chat}, to, text) {
  await chat.getByRole('radio', {name: to, exact: true}).click();
  await chat.locator('textarea').fill(text);
  await chat.locator('textarea').press('Enter');
}
const reads = ({chat}, text) => chat.locator('article', {hasText: text}).first().waitFor();

try {
  const [olga, paul, quinn] = await Promise.all(kPeople.map(([name]) => person(name)));
  const anna = await slotOf(olga.page, 'anna');
  for (const one of [olga, paul, quinn]) await choose(one.page, anna);
  showFailures(paul.page, join(folder, 'failure.png'));

  await check('the first to take control drives, and the others see who', async () => {
    await olga.lease.getByRole('button', {name: 'Take control'}).click();
    await olga.lease.getByText('You hold the lease').waitFor();
    await paul.lease.getByText('olga drives').waitFor();
    await quinn.lease.getByText('olga drives').waitFor();
  });

  await check('a goal for her robot is refused to the other commander, beside it', async () => {
    await paul.page.keyboard.press('g');
    await clickAt(paul.page, -1, -2);
    const card = paul.page.locator('rave-world .beside.refused');
    await card.waitFor();
    assert.match(await card.innerText(), /`olga` drives anna/);
    await paul.page.screenshot({path: join(folder, 'refused.png')});
    await card.getByRole('button', {name: 'Drop'}).click();
    await paul.page.keyboard.press('v');
    await choose(paul.page, anna);
  });

  await check('who has another team has no buttons for it, and no stick', async () => {
    assert.equal(await quinn.lease.getByRole('button').count(), 0);
    await quinn.lease.getByText('you may not command it').waitFor();
    assert.equal(
      await quinn.page.locator('rave-joystick .stick').getAttribute('aria-disabled'),
      'true',
    );
  });

  await check(
    'Ask is a line in the chat of who drives, and Give hands the lease over',
    async () => {
      await paul.lease.getByRole('button', {name: 'Ask'}).click();
      await paul.lease.getByText('Asked olga').waitFor();
      await reads(olga, 'May I drive anna?');
      await olga.lease.getByLabel('Give the lease to').selectOption('paul');
      await paul.lease.getByText('You hold the lease').waitFor();
      await olga.lease.getByText('paul drives').waitFor();
      assert.deepEqual(quinn.heard('May I drive'), []);
    },
  );

  await check('Take needs a second press, and who drove is told', async () => {
    await olga.lease.getByRole('button', {name: 'Take …'}).click();
    await olga.lease.getByRole('button', {name: 'Keep'}).click();
    await paul.lease.getByText('You hold the lease').waitFor();
    await olga.lease.getByRole('button', {name: 'Take …'}).click();
    await olga.lease.getByRole('button', {name: 'Take it from paul'}).click();
    await olga.lease.getByText('You hold the lease').waitFor();
    await paul.lease.getByText('olga drives').waitFor();
    await olga.page.screenshot({path: join(folder, 'taken.png')});
    await olga.lease.getByRole('button', {name: 'Give back'}).click();
    await paul.lease.getByText('No person drives').waitFor();
  });

  await check('the faces of others have a hue of their own, the same on every page', async () => {
    const hueOf = ({page}, of) =>
      page
        .locator('rave-top-bar .people .face', {hasText: of})
        .evaluate((face) => getComputedStyle(face).backgroundColor);
    const [paulAtOlga, quinnAtOlga, paulAtQuinn] = [
      await hueOf(olga, 'PA'),
      await hueOf(olga, 'QU'),
      await hueOf(quinn, 'PA'),
    ];
    assert.equal(paulAtOlga, paulAtQuinn);
    assert.notEqual(paulAtOlga, quinnAtOlga);
  });

  await check('a line to all is read by all', async () => {
    await say(olga, 'All', 'Good morning, lab.');
    for (const one of [olga, paul, quinn]) await reads(one, 'Good morning, lab.');
  });

  await check('a robot answers what it is told, for who commands with her as well', async () => {
    await say(olga, 'anna', 'Secret of the red team, anna?');
    for (const one of [olga, paul]) {
      await reads(one, 'Secret of the red team, anna?');
      await reads(one, 'not texts');
    }
    assert.match(await paul.chat.locator('article', {hasText: 'not texts'}).innerText(), /anna/);
    await paul.page.screenshot({path: join(folder, 'chat.png')});
  });

  await check('a line to a team, and one to a person, reach those alone', async () => {
    await say(olga, 'Team red', 'Secret plan of red.');
    await reads(paul, 'Secret plan of red.');
    await say(paul, 'olga', 'Secret between us.');
    await reads(olga, 'Secret between us.');
  });

  await check('a member of another team hears nothing of it', async () => {
    // Lines come in their order, so what was not there before this one does not come.
    await say(paul, 'All', 'That is all.');
    await untilHere(quinn.page, () => quinn.heard('That is all.').length > 0, 'the last line');
    await reads(quinn, 'That is all.');
    for (const text of ['Secret', 'not texts']) assert.deepEqual(quinn.heard(text), []);
    await quinn.page.screenshot({path: join(folder, 'other-team.png')});
  });
  report();
} finally {
  for (const browser of browsers) await browser.close();
  server.child.kill('SIGKILL');
}
process.exit(0);
