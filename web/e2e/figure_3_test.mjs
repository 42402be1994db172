// SPDX-License-Identifier: Apache-2.0
// Figure 3 of the paper with real browsers: a super-user, two commanders and an observer of three
// robots in processes of their own, one of them behind a serial line.
// node figure_3_test.mjs RAVE SCENARIO FOLDER
import assert from 'node:assert/strict';
import {mkdirSync, readdirSync, readFileSync, rmSync} from 'node:fs';
import {join} from 'node:path';
import {startServer} from './browser.mjs';
import {app, check, report, until, untilHere} from './checks.mjs';
import {choose, near, newest, slotOf} from './commander.mjs';
import {goal, invited, linkIn} from './invited.mjs';
import {Wire} from './rights/wire.mjs';

const [rave, scenario, folder] = process.argv.slice(2);
const kPeople = ['sue', 'lea', 'rick', 'iris'];
const kNotYours = /Your rights do not include this/;
rmSync(folder, {recursive: true, force: true});
mkdirSync(folder, {recursive: true});
const run = join(folder, 'run');
const server = await startServer(rave, [
  'run',
  scenario,
  '--gui',
  '--arm',
  '--quiet',
  '--no-picture',
  '--output',
  run,
]);
const {origin} = new URL(server.link);
const browsers = [];

const linkOf = (name) => linkIn(server.said(), name);

async function person(name) {
  const one = await invited(server, name, 3, join(folder, `failure-${name}.png`));
  browsers.push(one.browser);
  return {...one, chat: one.page.locator('rave-chat')};
}

/** All files of the run that are text, as one. */
const textOf = (where) =>
  readdirSync(where, {withFileTypes: true})
    .filter((entry) => !/\.(mcap|png)$/.test(entry.name))
    .map((entry) => {
      const path = join(where, entry.name);
      if (entry.isDirectory()) return textOf(path);
      // The links of the stand-in lead nowhere by now.
      return entry.isFile() ? readFileSync(path, 'utf8') : '';
    })
    .join('\n');

try {
  await untilHere(
    {waitForTimeout: (ms) => new Promise((resolve) => setTimeout(resolve, ms))},
    () => [...kPeople, 'otto'].every(linkOf),
    'a link for each',
  );
  const there = {};
  await check('the terminal has a link for each person, and all of them come in', async () => {
    for (const name of kPeople) there[name] = await person(name);
    assert.equal(new Set([...kPeople, 'otto'].map(linkOf)).size, 5);
  });
  const slots = {};
  for (const name of ['create', 'anna', 'ben']) slots[name] = await slotOf(there.sue.page, name);

  await check('the robot behind the serial line is real, the others are simulated', async () => {
    const kinds = await there.iris.page.evaluate(
      `Object.fromEntries(${app}.model.robots.map(({name, kind}) => [name, kind]))`,
    );
    assert.deepEqual(kinds, {create: 'real', anna: 'simulated', ben: 'simulated'});
  });

  await check('each commander sends their robots, and no others: the server refuses', async () => {
    const own = {
      lea: [['create', [-1.2, -0.4]]],
      rick: [
        ['anna', [0.6, 0.7]],
        ['ben', [0.6, -0.8]],
      ],
    };
    for (const [name, orders] of Object.entries(own)) {
      const one = there[name];
      for (const [robot, point] of orders) {
        await until(one.page, `${newest}.flags[${slots[robot]}] & 1`);
        const answer = await goal(one, slots[robot], point);
        assert.ok(answer.good, `${name}, ${robot}: ${answer.text}`);
      }
      for (const [robot, point] of orders) await near(one.page, slots[robot], ...point, 0.3);
      const wire = await Wire.open(origin, one.cookie);
      const mine = orders.map(([robot]) => robot);
      for (const robot of Object.keys(slots).filter((other) => !mine.includes(other))) {
        assert.equal((await goal(one, slots[robot], [0, 0])).good, false, `${name}, ${robot}`);
        const answer = await wire.ask({
          type: 'order',
          request: 900 + slots[robot],
          kind: 'goal',
          slots: [slots[robot]],
          points: [[0, 0]],
        });
        assert.equal(answer.good, false);
        assert.match(answer.text, kNotYours, `${name}, ${robot}`);
      }
      wire.end();
    }
  });

  await check('an observer sends nothing at all', async () => {
    for (const slot of Object.values(slots))
      assert.equal((await goal(there.iris, slot, [0, 0])).good, false);
  });

  await check('an obstacle of the super-user reaches commanders, and no observer', async () => {
    await there.sue.page.evaluate(() =>
      document.querySelector('rave-app').link.send({
        type: 'edit',
        request: 77,
        do: 'add',
        name: 'parcel',
        pose: [2, 0, 0],
        disc: 0.2,
      }),
    );
    for (const name of ['lea', 'rick'])
      await until(
        there[name].page,
        `[...${app}.model.bodies.values()].some(({name}) => name === 'parcel')`,
      );
    assert.ok(there.lea.heard('crate').length > 0, 'the obstacle of the scenario');
  });

  await check('a commander talks to a team, and the observer hears what is for all', async () => {
    await there.rick.page.getByRole('radio', {name: 'Drive'}).click();
    await choose(there.rick.page, slots.anna);
    const say = async (to, text) => {
      await there.rick.chat.getByRole('radio', {name: to, exact: true}).click();
      await there.rick.chat.locator('textarea').fill(text);
      await there.rick.chat.locator('textarea').press('Enter');
    };
    await say('Team right', 'Only for the right.');
    await say('All', 'For everybody.');
    await untilHere(
      there.iris.page,
      () => there.iris.heard('For everybody.').length > 0,
      'the line for all',
    );
    await untilHere(
      there.lea.page,
      () => there.lea.heard('For everybody.').length > 0,
      'the line for all',
    );
    assert.deepEqual(there.lea.heard('Only for the right.'), []);
    // It came after the obstacle, which would have come before.
    for (const word of ['crate', 'parcel']) assert.deepEqual(there.iris.heard(word), []);
    for (const name of kPeople)
      await there[name].page.screenshot({path: join(folder, `${name}.png`)});
  });

  await check('the run ends with its verdict, and keeps no link', async () => {
    const links = [...kPeople, 'otto'].map((name) => linkOf(name).split('invite=')[1]);
    // The recording is shown afterwards, until a person quits.
    server.child.kill('SIGINT');
    const exited = new Promise((resolve) => server.child.once('exit', resolve));
    assert.equal(await exited, 0);
    const result = JSON.parse(readFileSync(join(run, 'result.json'), 'utf8'));
    assert.equal(result.whole, true, JSON.stringify(result.problems));
    assert.deepEqual(
      result.checks.map(({check: what, holds}) => [what, holds]),
      [['touches of create, anna, ben', true]],
    );
    const text = textOf(run);
    assert.ok(text.includes('ready '), 'the output of the stand-in');
    for (const secret of links)
      assert.ok(!text.includes(secret), 'a link in the folder of the run');
  });
} finally {
  for (const browser of browsers) await browser.close();
  server.child.kill('SIGINT');
}
report();
process.exit(0);
