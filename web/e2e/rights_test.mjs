// SPDX-License-Identifier: Apache-2.0
// Three people of the three roles in one live run: what each page offers, what the server sends and
// takes, and a right that is changed meanwhile. node rights_test.mjs RAVE SCENARIO FOLDER
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {mkdirSync, rmSync} from 'node:fs';
import {join} from 'node:path';
import {launch, startServer} from './browser.mjs';
import {app, check, report, showFailures, until} from './checks.mjs';
import {choose, newest, slotOf} from './commander.mjs';
import {kRequests} from './rights/requests.mjs';
import {Wire} from './rights/wire.mjs';

const [rave, scenario, folder] = process.argv.slice(2);
/** A change is in force within so long. */
const kInForce_ms = 1000;
const kNotYours = /Your rights do not include this|Only a super-user can do this/;

rmSync(folder, {recursive: true, force: true});
mkdirSync(folder, {recursive: true});
const accounts = join(folder, 'accounts');
const kPeople = {olga: 'observer', carl: 'commander', sue: 'super_user'};
for (const [name, role] of Object.entries(kPeople)) {
  const teams = role === 'super_user' ? [] : ['--teams', 'red'];
  execFileSync(rave, ['people', 'add', name, '--role', role, ...teams, '--accounts', accounts], {
    input: `${name} has a horse\n`,
    stdio: ['pipe', 'ignore', 'inherit'],
  });
}
const server = await startServer(rave, [
  'run',
  scenario,
  '--gui',
  '--accounts',
  accounts,
  '--quiet',
  '--no-picture',
  '--no-record',
  '--pace',
  'realtime',
  '--output',
  join(folder, 'run'),
]);
const {origin} = new URL(server.link);
const browser = await launch();

async function person(name) {
  const context = await browser.newContext({viewport: {width: 1400, height: 900}});
  const page = await context.newPage();
  await page.goto(`${origin}/`);
  await page.fill('#name', name);
  await page.fill('#password', `${name} has a horse`);
  await page.click('button');
  await until(page, `${app}?.model?.robots?.length === 2 && ${newest} != null`, 60000);
  const cookie = (await context.cookies()).map((kept) => `${kept.name}=${kept.value}`).join('; ');
  return {name, page, wire: await Wire.open(origin, cookie)};
}

const kSeen = [
  'World View',
  'Robots',
  'Sensor Display',
  'Robot',
  'Chat',
  'Log & alerts',
  'Hosts',
  'Map',
];
const kCommanded = ['Joystick', 'Probe'];
const kConducted = ['Super-User'];

/** The panels that Find has for a person; it lists but the first ones of all. */
async function panelsOf({page}) {
  await page.keyboard.press('Control+k');
  const input = page.getByRole('textbox', {name: 'Find'});
  const rows = page.getByRole('listbox', {name: 'Found'}).getByRole('option');
  const found = [];
  for (const title of [...kSeen, ...kCommanded, ...kConducted]) {
    await input.fill(title);
    const notes = await rows.evaluateAll(
      (all, wanted) =>
        all
          .filter((row) => row.querySelector('span').textContent === wanted)
          .map((row) => row.querySelector('em').textContent),
      title,
    );
    if (notes.includes('panel')) found.push(title);
  }
  await page.keyboard.press('Escape');
  return found;
}

/** The controls of a page that depend on the role. */
async function controlsOf({page}) {
  await choose(page, await slotOf(page, 'anna'));
  const there = async (locator) =>
    (await locator.count()) > 0 &&
    (await locator.first().isVisible()) &&
    (await locator.first().isEnabled());
  const world = page.locator('rave-world');
  const all = {
    STOP: page.locator('rave-stop').getByRole('button', {name: /^STOP/}),
    Goal: world.getByRole('button', {name: /goal/i}).or(world.getByRole('radio', {name: /goal/i})),
    Obstacle: world
      .getByRole('button', {name: /obstacle/i})
      .or(world.getByRole('radio', {name: /obstacle/i})),
    Pause: page.getByRole('button', {name: 'Pause', exact: true}),
    Drive: page.getByRole('radio', {name: 'Drive'}),
    Conduct: page.getByRole('radio', {name: 'Conduct'}),
  };
  const found = [];
  for (const [name, locator] of Object.entries(all)) if (await there(locator)) found.push(name);
  return found;
}

const within = (small, large) =>
  small.length < large.length && small.every((name) => large.includes(name));

try {
  const [olga, carl, sue] = [await person('olga'), await person('carl'), await person('sue')];
  showFailures(sue.page, join(folder, 'failure.png'));

  await check('each page has the panels of its role and no others', async () => {
    assert.deepEqual(await panelsOf(olga), kSeen);
    assert.deepEqual(await panelsOf(carl), [...kSeen, ...kCommanded]);
    assert.deepEqual(await panelsOf(sue), [...kSeen, ...kCommanded, ...kConducted]);
  });

  await check('and its controls: an observer views only', async () => {
    assert.deepEqual(await controlsOf(olga), []);
    await olga.page.locator('rave-stop').getByText('View only').waitFor();
    assert.deepEqual(await controlsOf(carl), ['STOP', 'Goal', 'Drive']);
    assert.deepEqual(await controlsOf(sue), [
      'STOP',
      'Goal',
      'Obstacle',
      'Pause',
      'Drive',
      'Conduct',
    ]);
  });

  await check(
    'the server takes from each what the table of rights says, and refuses the rest, whatever is sent',
    async () => {
      const taken = {};
      for (const {name, wire} of [olga, carl, sue]) {
        taken[name] = [];
        for (const {what, request, done} of kRequests) {
          const answer = await wire.ask(request, done);
          if (answer.good) taken[name].push(what);
          else assert.match(answer.text, name === 'sue' ? /^$/ : kNotYours, `${name}, ${what}`);
        }
      }
      const of = (role) => kRequests.filter(({from}) => from.includes(role)).map(({what}) => what);
      assert.deepEqual(taken, {olga: of('observer'), carl: of('commander'), sue: of('super_user')});
      assert.ok(
        within(taken.olga, taken.carl) && within(taken.carl, taken.sue),
        'each role has more than the one before',
      );
      console.log(
        `of ${kRequests.length} kinds of requests: ${Object.entries(taken)
          .map(([name, kinds]) => `${name} ${kinds.length}`)
          .join(', ')}`,
      );
    },
  );

  const sensors = () => olga.wire.last('roster').robots.map((robot) => robot.sensors.length);
  const flowing = (since_ms) =>
    olga.wire.readingsAt_ms.filter((at_ms) => at_ms >= since_ms).length > 2;
  /** A press on the cell of readings of observers; how long until the wire of one has these numbers
   * of sensors. */
  async function press(before, wanted) {
    await sue.page
      .locator('rave-rights')
      .getByRole('button', {name: `Readings of Observer: ${before}`})
      .click();
    await olga.wire.until(() => sensors().join() === wanted.join(), `sensors ${wanted}`);
    return olga.wire.last('roster').at_ms - (await sue.page.evaluate('globalThis.clickedAt_ms'));
  }

  await check(
    'a click on a cell takes a class off the wire of an observer within a second, and a click brings it back',
    async () => {
      await sue.page.getByRole('radio', {name: 'Conduct'}).click();
      await sue.page.evaluate(() =>
        addEventListener('click', () => (globalThis.clickedAt_ms = Date.now()), true),
      );
      assert.deepEqual(sensors(), [1, 0]);
      olga.wire.look();
      await olga.wire.until(() => flowing(0), 'readings');
      const took_ms = [
        await press('robots of own teams', [1, 1]),
        await press('all robots', [0, 0]),
      ];
      const gone_ms = Date.now();
      await until(olga.page, `${app}.model.robots.every(({sensors}) => sensors.length === 0)`);
      // What was on its way came before the roster. The server sends the time once a second.
      const times = () =>
        olga.wire.messages.filter(({type, at_ms}) => type === 'time' && at_ms > gone_ms).length;
      await olga.wire.until(() => times() >= 2, 'the time, twice');
      assert.equal(olga.wire.readingsAt_ms.filter((at_ms) => at_ms > gone_ms).length, 0);
      await olga.page
        .locator('rave-sensors')
        .getByText(/sensors and their readings/i)
        .first()
        .waitFor();
      await olga.page.screenshot({path: join(folder, 'without.png')});
      took_ms.push(await press('no right', [1, 0]));
      const back_ms = Date.now();
      await olga.wire.until(() => flowing(back_ms), 'readings again');
      await until(olga.page, `${app}.model.robots[0].sensors.length === 1`);
      console.log(`in force at the observer after ${took_ms.join(', ')} ms`);
      assert.ok(Math.max(...took_ms) < kInForce_ms, took_ms.join());
      await sue.page.screenshot({path: join(folder, 'rights.png')});
    },
  );

  await check(
    'an observer without any class is still told the time, and so has no lost link',
    async () => {
      const {classes} = sue.wire.last('rights');
      for (const what of classes)
        assert.ok(
          (await sue.wire.ask({type: 'set_right', role: 'observer', class: what, reach: 'none'}))
            .good,
          what,
        );
      await until(olga.page, `${app}.model.robots.length === 0`);
      await olga.page.evaluate(() => {
        const {link} = document.querySelector('rave-app');
        globalThis.losses = 0;
        link.changed.on(() => (globalThis.losses += link.state === 'open' ? 0 : 1));
      });
      const since_ms = Date.now();
      // For longer than a silent link is kept.
      await olga.wire.until(
        () =>
          olga.wire.messages.filter(({type, at_ms}) => type === 'time' && at_ms > since_ms)
            .length >= 5,
        'the time',
      );
      assert.equal(await olga.page.evaluate('globalThis.losses'), 0);
    },
  );
} finally {
  await browser.close();
  server.child.kill('SIGKILL');
}
report();
process.exit(0);
