// SPDX-License-Identifier: Apache-2.0
// The page for everybody: no serious finding of axe in any state, in both themes and all widths,
// and the whole page by keyboard alone: node access_test.mjs PAGE FOLDER
import assert from 'node:assert/strict';
import {mkdirSync, readFileSync} from 'node:fs';
import {createRequire} from 'node:module';
import {join} from 'node:path';
import {launch} from './browser.mjs';
import {app, check, report, showFailures, until, untilHere, watch} from './checks.mjs';
import {FakeRun} from './fake_run.mjs';
import {serveFake} from './fake_server.mjs';

const [built, folder] = process.argv.slice(2);
mkdirSync(folder, {recursive: true});
const axe = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');
const kWidths = [
  ['desktop', 1400, 900],
  ['tablet', 820, 1100],
  ['phone', 390, 844],
  ['pen', 480, 640],
];

const run = new FakeRun(16, {
  now_s: 20,
  role: 'super_user',
  may: ['play', 'pace', 'step', 'stop', 'release', 'readings', 'obstacles', 'log', 'rights'],
});
run.setRight({user: 'carla', class: 'stop', reach: 'own'});
run.hosts = [1, 2].map((i) => ({
  name: `host-${i}`,
  machine: `lab-${i}`,
  state: i === 2 ? 'late' : 'here',
  ...(i === 2 ? {late_s: 2.9} : {}),
  real: 2,
  simulated: 6,
  step: 1700,
  steps_per_s: 99.8,
  delay_s: 0.0003,
  cpu: 0.4,
  lost: i - 1,
}));
run.events.push({
  t: 9,
  until: 12,
  count: 131,
  kind: 'contact',
  level: 'warn',
  text: 'real-4 and real-5 touch',
  slots: [3, 4],
});
const server = await serveFake(built, run);
const browser = await launch();

async function open(width, height, theme) {
  const context = await browser.newContext({
    viewport: {width, height},
    hasTouch: width < 600,
    reducedMotion: 'reduce',
  });
  const page = await context.newPage();
  await page.addInitScript((value) => localStorage.setItem('rave.theme', value), theme);
  await page.goto(server.origin);
  await until(page, `${app}?.model?.poses?.newest`);
  await page.evaluate(`${app}.selection.set([2])`);
  await page.waitForTimeout(500);
  return page;
}

/** Names of the serious findings, with the elements. */
async function findings(page) {
  await page.evaluate(axe);
  const {violations} = await page.evaluate(() =>
    window.axe.run(document, {resultTypes: ['violations']}),
  );
  return violations
    .filter(({impact}) => impact === 'serious' || impact === 'critical')
    .map(
      ({id, nodes}) =>
        `${id}: ${nodes
          .slice(0, 4)
          .map(({target, any}) => `${target.flat().join(' > ')} ${any[0]?.message ?? ''}`)
          .join(' | ')}`,
    );
}

/** Brings a panel to the front. */
async function show(page, id) {
  await page.evaluate((panel) => document.querySelector('rave-app').context.show(panel), id);
  await page.waitForTimeout(300);
  await until(
    page,
    `document.querySelector('rave-app').shadowRoot.querySelector('${kTags[id]}') ?? document.querySelector('${kTags[id]}')`,
  );
}
const kTags = {
  hosts: 'rave-hosts',
  log: 'rave-log',
  robot: 'rave-robot',
  chat: 'rave-chat',
  rights: 'rave-super-user',
};

const found = [];

async function look(page, what) {
  for (const finding of await findings(page)) found.push(`${what}: ${finding}`);
}

/** Each panel that an observer may not see says so. */
async function lookElsewhere(page) {
  await look(page, 'withheld');
  await page.screenshot({path: join(folder, 'withheld.png')});
  for (const [panel, words] of [
    ['map', 'maps'],
    ['hosts', 'You may not see hosts.'],
    ['probe', 'try virtual sensors'],
    ['rights', 'Only super-users see rights'],
  ]) {
    await page.evaluate((id) => document.querySelector('rave-app').context.show(id), panel);
    await page
      .locator(panel === 'rights' ? 'rave-super-user' : `rave-${panel}`)
      .getByText(words)
      .waitFor();
    await look(page, panel);
  }
}

try {
  for (const theme of ['dark', 'light']) {
    for (const [name, width, height] of kWidths) {
      await check(`${name}, ${theme}: nothing serious`, async () => {
        const page = await open(width, height, theme);
        showFailures(page, join(folder, 'failed.png'));
        await look(page, 'as it opens');
        await page.getByRole('button', {name: 'Layers'}).click();
        await look(page, 'layers');
        await page.keyboard.press('Escape');
        await page.keyboard.press('?');
        await page.waitForTimeout(100);
        await look(page, 'keys');
        await page.keyboard.press('Escape');
        await page.keyboard.press('Control+k');
        await page.keyboard.type('stop wal');
        await page.waitForTimeout(100);
        await look(page, 'find');
        await page.keyboard.press('Escape');
        run.stopped = new Set(run.robots.keys());
        await page.getByText('Hold to release').waitFor();
        await look(page, 'stopped');
        run.stopped.clear();
        for (const panel of ['hosts', 'log', 'robot', 'chat']) {
          await show(page, panel);
          await look(page, panel);
        }
        await show(page, 'rights');
        for (const part of ['Rights', 'People', 'Invitations', 'Audit log']) {
          await page.getByRole('tab', {name: part}).last().click();
          if (part === 'People') await page.getByRole('button', {name: 'Change fatima'}).click();
          if (part === 'Invitations') {
            await page.getByRole('button', {name: 'Make a link'}).click();
            await page.getByText('The link is shown once').waitFor();
          }
          await page.waitForTimeout(200);
          await look(page, part);
          await page.screenshot({
            path: join(folder, `${part.split(' ')[0].toLowerCase()}-${name}-${theme}.png`),
          });
        }
        await page.context().close();
        assert.deepEqual(found.splice(0), []);
      });
    }
  }

  await check(
    'an observer is told what is not theirs, who has it and whom to ask; nothing serious there either',
    async () => {
      const observed = new FakeRun(6, {now_s: 20, role: 'observer', may: ['chat']});
      for (const robot of observed.robots) Object.assign(robot, {sensors: [], yours: false});
      observed.events = [];
      const other = await serveFake(built, observed);
      const page = await (
        await browser.newContext({viewport: {width: 1400, height: 900}, reducedMotion: 'reduce'})
      ).newPage();
      showFailures(page, join(folder, 'failed.png'));
      await page.goto(other.origin);
      await until(page, `${app}?.model?.poses?.newest`);
      await page.evaluate(`${app}.selection.set([2])`);
      await page
        .locator('rave-sensors')
        .getByText(
          'You may not see sensors and their readings. By default observers and commanders have this right for robots of their teams, super-users for all robots. Ask a super-user for it; none is here now.',
        )
        .waitFor();
      other.say({
        type: 'people',
        people: [
          {name: 'Ada N', role: 'observer'},
          {name: 'Cora S', role: 'super_user'},
        ],
      });
      await page
        .locator('rave-sensors')
        .getByText('Ask a super-user who is here: Cora S.')
        .waitFor();
      await page.locator('rave-log').getByText('You may not see the log.').waitFor();
      await page.locator('rave-world').getByRole('button', {name: 'virtual obstacles'}).click();
      await page
        .locator('rave-world .menu')
        .getByText('You may not see virtual obstacles.')
        .waitFor();
      await page
        .locator('rave-world .menu')
        .getByText('You may not see true poses. By default super-users have this right.')
        .waitFor();
      await lookElsewhere(page);
      await page.keyboard.press('Control+k');
      await page.keyboard.type('map');
      await page.getByRole('option', {name: 'Map panel; you may not see it'}).waitFor();
      await page.keyboard.press('Escape');
      await page.evaluate(`${app}.context.show('hosts')`);
      await page.locator('rave-hosts').getByRole('button', {name: 'Ask in the chat'}).click();
      await page
        .locator('rave-chat')
        .getByRole('radio', {name: 'Super-users', checked: true})
        .waitFor();
      observed.may = [];
      other.turnInto({});
      await page.locator('rave-chat').getByText('You may not see the chat.').waitFor();
      await page.context().close();
      await other.end();
      assert.deepEqual(found.splice(0), []);
    },
  );

  await check('everything is reached by the keyboard alone', async () => {
    const page = await open(1400, 900, 'dark');
    const seen = watch(page, server.origin);
    const reached = new Set();
    for (let i = 0; i < 120; ++i) {
      await page.keyboard.press('Tab');
      reached.add(
        await page.evaluate(() => {
          let at = document.activeElement;
          while (at?.shadowRoot?.activeElement) at = at.shadowRoot.activeElement;
          return (
            at?.getAttribute('aria-label') || at?.textContent?.trim().slice(0, 24) || at?.localName
          );
        }),
      );
    }
    for (const name of [
      'Find a robot, panel or moment',
      'Light or dark',
      'Filter robots',
      'Layers',
      'Follow the selected robot',
      'Pause',
      'One step forward',
    ]) {
      assert.ok(
        [...reached].some((known) => known?.startsWith(name)),
        `${name} is not reached: ${[...reached].join(', ')}`,
      );
    }
    assert.ok(
      [...reached].some((known) => known?.includes('STOP')),
      'STOP',
    );
    assert.ok(
      [...reached].some((known) => known?.includes('walker-1')),
      'rows of robots',
    );
    assert.deepEqual(seen.foreign, []);
    assert.deepEqual(seen.errors, []);
  });

  await check('stop and release by keyboard', async () => {
    const page = await open(1400, 900, 'light');
    await page.locator('rave-stop .stop').focus();
    await page.keyboard.press('Enter');
    await untilHere(page, () => run.stopped.size === 16, 'stopped');
    await page.locator('rave-stop .release').focus();
    await page.keyboard.down(' ');
    await untilHere(page, () => run.stopped.size === 0, 'released');
    await page.keyboard.up(' ');
  });
} finally {
  await browser.close();
}
report();
process.exit(0);
