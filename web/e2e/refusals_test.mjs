// SPDX-License-Identifier: Apache-2.0
// Orders that cannot be: each has a sentence in the page.
// node refusals_test.mjs RAVE SCENARIO PLUGINS FOLDER
import assert from 'node:assert/strict';
import {mkdirSync, rmSync} from 'node:fs';
import {join} from 'node:path';
import {launch, startServer} from './browser.mjs';
import {app, check, report, showFailures, until} from './checks.mjs';
import {choose, newest, slotOf} from './commander.mjs';

const [rave, scenario, plugins, folder] = process.argv.slice(2);
rmSync(folder, {recursive: true, force: true});
mkdirSync(folder, {recursive: true});
const server = await startServer(rave, [
  'run',
  scenario,
  '--plugins',
  plugins,
  '--gui',
  '--quiet',
  '--no-picture',
  '--output',
  join(folder, 'run'),
]);
const browser = await launch();

/** What a person asks for, and what stands beside it then. */
const kOrders = [
  [
    'a goal outside the fence',
    'fenced',
    {goal: [[1.8, 0]]},
    /\(1\.80, 0\.00\) is outside the fence of the robot/,
  ],
  [
    'a goal inside an obstacle',
    'fenced',
    {goal: [[0.1, 0]]},
    /\(0\.10, 0\.00\) is inside the obstacle `post`/,
  ],
  ['a goal outside the world', 'fenced', {goal: [[4000, 0]]}, /outside the world; expected x from/],
  [
    'a path through an obstacle',
    'fenced',
    {
      path: [
        [-1, -0.5],
        [0, 0],
        [1, 0.5],
      ],
    },
    /is inside the obstacle `post`/,
  ],
  [
    'a path of 10 000 points',
    'fenced',
    {path: Array.from({length: 10000}, (_, i) => [-1 + i / 1e5, -0.5])},
    /a path has 10000 points; expected 2 to 1000/,
  ],
  [
    'a path of a single point',
    'fenced',
    {path: [[-1, -0.5]]},
    /a path has 1 points; expected 2 to 1000/,
  ],
  [
    'a goal for a robot that only drives',
    'driven',
    {goal: [[1, -1.5]]},
    /neither its program nor one of its controllers takes goals/,
  ],
  [
    'a goal for a robot that is being handed over',
    'between',
    {goal: [[-1, 1.4]]},
    /it is being handed over/,
  ],
  [
    'a goal for a robot that is stopped',
    'fenced',
    {stop: true, goal: [[-1, -0.5]]},
    /it is stopped; a stop holds until it is released/,
  ],
];

try {
  const context = await browser.newContext({viewport: {width: 1500, height: 950}});
  const page = await context.newPage();
  showFailures(page, join(folder, 'failure.png'));
  const card = page.locator('rave-world .beside.refused');

  await check(
    'the run is there, and one of its robots is between its two sets of drivers',
    async () => {
      await page.goto(server.link);
      await until(
        page,
        `${app}?.model?.robots?.length === 3 && ${newest} != null && ${newest}.time_s > 1`,
        60000,
      );
      await page.waitForTimeout(300);
    },
  );

  for (const [what, robot, {stop, goal, path}, sentence] of kOrders) {
    await check(`${what} is refused beside it, and by the run`, async () => {
      const slot = await slotOf(page, robot);
      await choose(page, slot);
      if (stop) {
        await page.evaluate(
          (of) =>
            document.querySelector('rave-app').link.send({type: 'halt', do: 'stop', slots: [of]}),
          slot,
        );
        await until(page, `(${newest}.flags[${slot}] & 4) !== 0`);
      }
      const answer = await page.evaluate(
        ([kind, of, points]) => document.querySelector('rave-app').commands[kind]([of], points),
        [path ? 'path' : 'goal', slot, path ?? goal],
      );
      assert.equal(answer.good, false);
      assert.match(answer.text, sentence);
      await card.waitFor();
      assert.match((await card.innerText()).replaceAll('\n', ' '), sentence);
      const box = await card.boundingBox();
      assert.ok(
        box.x >= 0 && box.y >= 0 && box.x + box.width <= 1500 && box.y + box.height <= 950,
        'it can be read',
      );
      await page.screenshot({path: join(folder, `${what.replaceAll(' ', '-')}.png`)});
      await card.getByRole('button', {name: 'Drop'}).click();
      await card.waitFor({state: 'detached'});
    });
  }

  await check('what a robot takes stands in its panel beforehand', async () => {
    await choose(page, await slotOf(page, 'driven'));
    await page.getByRole('radio', {name: 'Drive', exact: true}).click();
    await page.locator('rave-robot .takes').waitFor();
    assert.deepEqual(
      await page
        .locator('rave-robot .takes .chip.yes')
        .allInnerTexts()
        .then((texts) => texts.map((text) => text.trim()).sort()),
      ['drive', 'place'],
    );
  });

  await check(
    'of two pages of one person the other one says who drives, and may take it with a second press',
    async () => {
      const other = await context.newPage();
      await other.goto(new URL('/', server.link).href);
      await until(other, `${app}?.model?.robots?.length === 3 && ${newest} != null`, 60000);
      const slot = await slotOf(page, 'driven');
      await page
        .locator('rave-joystick rave-lease')
        .getByRole('button', {name: 'Take control'})
        .click();
      await page.locator('rave-joystick rave-lease').getByText('You hold the lease').waitFor();
      await choose(other, slot);
      await other.getByRole('radio', {name: 'Drive', exact: true}).click();
      const lease = other.locator('rave-joystick rave-lease');
      await lease.getByText('You drive on another page').waitFor();
      const answer = await other.evaluate(
        (of) =>
          document
            .querySelector('rave-app')
            .commands.ask({type: 'order', kind: 'drive', slots: [of], v: 0.1, w: 0}),
        slot,
      );
      assert.equal(answer.good, false);
      assert.match(answer.text, /another page/);
      await other.screenshot({path: join(folder, 'two-pages.png')});
      await lease.getByRole('button', {name: 'Take …'}).click();
      await lease.getByRole('button', {name: 'Take it here'}).click();
      await lease.getByText('You hold the lease').waitFor();
      await page
        .locator('rave-joystick rave-lease')
        .getByText('You drive on another page')
        .waitFor();
    },
  );
  report();
} finally {
  await browser.close();
  server.child.kill('SIGKILL');
}
process.exit(0);
