// SPDX-License-Identifier: Apache-2.0
// Virtual sensors that are tried on robots: on a real one, in one process and over two hosts; no
// part of the run. node probe_test.mjs RAVE MIXED_REALITY TWO_ROBOTS ROBOTS FOLDER
import assert from 'node:assert/strict';
import {execFileSync, spawnSync} from 'node:child_process';
import {mkdirSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';
import {launch, startServer} from './browser.mjs';
import {app, check, report, showFailures, until} from './checks.mjs';
import {choose, newest, slotOf} from './commander.mjs';

const [rave, mixed, twoRobots, robots, folder] = process.argv.slice(2);
const kFirst = 0xf000;
rmSync(folder, {recursive: true, force: true});
mkdirSync(folder, {recursive: true});
const {drivers} = JSON.parse(
  execFileSync(rave, ['drivers', '--kind', 'virtual_sensor', '--json'], {encoding: 'utf8'}),
);

const browser = await launch();
const servers = [];
const said = [];
const errors = [];
/** Readings of probes that came, as frames. */
let frames = 0;
try {
  const context = await browser.newContext({
    viewport: {width: 1500, height: 950},
    permissions: ['clipboard-read', 'clipboard-write'],
  });
  const page = await context.newPage();
  page.on('pageerror', (error) => errors.push(String(error)));
  page.on('websocket', (socket) => {
    for (const way of ['framesent', 'framereceived'])
      socket.on(way, ({payload}) => {
        if (typeof payload === 'string') said.push(JSON.parse(payload));
        else if (payload[0] === 2 && payload.readUInt16LE(2) >= kFirst) ++frames;
      });
  });
  showFailures(page, join(folder, 'failure.png'));
  const panel = page.locator('rave-probe');
  const reading = (slot) => `${app}.model.readings.of(${slot}, ${kFirst})`;
  const open = async (name) => {
    await choose(page, await slotOf(page, name));
    await page.evaluate(`${app}.showPanel('probe')`);
    await panel.getByLabel('Virtual sensor').waitFor();
  };
  const choosesDriver = (name) => panel.getByLabel('Virtual sensor').selectOption(name);
  const fill = async (field, value, what = 'value') => {
    await panel.getByLabel(`${field}, ${what}`, {exact: true}).fill(String(value));
    await panel.getByLabel(`${field}, ${what}`, {exact: true}).press('Enter');
  };
  const start = async (words) => {
    servers.push(await startServer(rave, words));
    await page.goto(servers.at(-1).link);
    await until(page, `${newest} != null && ${newest}.time_s > 0.3`, 60000);
  };
  const copied = async () => {
    await panel.getByRole('button', {name: 'Copy for the robot file'}).click();
    await panel.getByRole('button', {name: 'Copied'}).waitFor();
    return page.evaluate(() => navigator.clipboard.readText());
  };

  await start([
    'run',
    mixed,
    '--gui',
    '--quiet',
    '--no-picture',
    '--no-record',
    '--pace',
    'realtime',
    '--output',
    join(folder, 'one'),
  ]);
  const real = await slotOf(page, 'real-3');

  await check('the form is made from the description of the driver', async () => {
    await open('real-3');
    const offered = await panel.getByLabel('Virtual sensor').locator('option').allInnerTexts();
    assert.deepEqual(offered.toSorted(), drivers.map(({name}) => name).toSorted());
    await choosesDriver('virtual_sonar');
    for (const {name} of drivers.find((driver) => driver.name === 'virtual_sonar').params)
      await panel.getByLabel(name, {exact: true}).waitFor();
    assert.match(
      await panel.locator('label', {hasText: 'cone_deg'}).getAttribute('title'),
      /From 0.1 to 180/,
    );
  });

  await check(
    'a real robot gets a sensor that it never had, and its readings at once',
    async () => {
      await choosesDriver('virtual_laser');
      await until(page, `${reading(real)}?.rows === 180`);
      await fill('rays', 91);
      await fill('fov_deg', 360);
      await until(page, `${reading(real)}?.rows === 91`);
      // The robots and tubes around it are what it meets.
      const met = await page.evaluate((slot) => {
        const {model} = document.querySelector('rave-app');
        const {values} = model.readings.of(slot, 0xf000);
        const {newest} = model.poses;
        const nearest = Math.min(...values);
        const distances = [...model.robots.keys()]
          .filter((other) => other !== slot)
          .map((other) =>
            Math.hypot(newest.x[other] - newest.x[slot], newest.y[other] - newest.y[slot]),
          );
        return {
          nearest,
          robot: Math.min(...distances),
          finite: values.filter(Number.isFinite).length,
        };
      }, real);
      assert.ok(met.finite > 3 && met.nearest > 0 && met.nearest < met.robot, JSON.stringify(met));
      const [kind, known] = await page.evaluate(
        `[${app}.model.robots[${real}].kind, ${app}.model.robots[${real}].sensors.map(({name}) => name)]`,
      );
      assert.equal(kind, 'real');
      await until(page, `${app}.model.probes.sensor(${kFirst}) !== undefined`);
      assert.ok(
        !known.includes(await page.evaluate(`${app}.model.probes.sensor(${kFirst}).name`)),
        'the robot has the sensor itself',
      );
      await page.evaluate(`${app}.palette.set('dark')`);
      await page.waitForTimeout(500);
      await page.screenshot({path: join(folder, 'probe-dark.png')});
      await page.evaluate(`${app}.palette.set('light')`);
      await page.waitForTimeout(500);
      await page.screenshot({path: join(folder, 'probe-light.png')});
    },
  );

  await check('what cannot be is refused with a sentence, and nothing is read', async () => {
    await fill('range_min_m', 9);
    await panel.getByRole('alert').waitFor();
    assert.match(await panel.getByRole('alert').innerText(), /range_min_m/);
    assert.ok(await panel.getByRole('button', {name: 'Copy for the robot file'}).isDisabled());
    await fill('range_min_m', 0.02);
    await until(page, `${reading(real)}?.rows === 91`);
  });

  await check('the block that is copied is good for the robot file', async () => {
    await fill('x_m', -0.16);
    await fill('yaw_deg', 180);
    await until(
      page,
      `((mount) => mount?.[0] === -0.16 && Math.abs(mount[2] - Math.PI) < 1e-6)(${app}.model.probes.sensor(${kFirst})?.mount)`,
    );
    await until(page, `${reading(real)}?.rows === 91`);
    const block = await copied();
    assert.match(block, /mount: \{x_m: -0.16, y_m: 0, z_m: 0.1, yaw_deg: 180\}/);
    const file = join(folder, 'with-probe.yaml');
    const robot = readFileSync(join(robots, 'wanderer.yaml'), 'utf8');
    writeFileSync(file, robot.replace('sensors:\n', `sensors:\n${block}`));
    const checked = spawnSync(rave, ['check', file], {encoding: 'utf8'});
    assert.equal(checked.status, 0, checked.stdout + checked.stderr);
    const expanded = execFileSync(rave, ['check', '--expand', file], {encoding: 'utf8'});
    assert.match(expanded, /rays: 91/);
  });

  await check('every virtual sensor of the catalogue can be tried', async () => {
    for (const {name, params} of drivers) {
      await choosesDriver(name);
      // What has no default has to be given first.
      for (const {name: key, type, required} of params)
        if (required) await fill(key, 7, type === 'list' ? 'numbers' : 'value');
      await until(page, `${app}.model.probes.sensor(${kFirst})?.driver === '${name}'`);
      await until(page, `${reading(real)} != null`);
      assert.match(await copied(), new RegExp(`driver: ${name}`));
      await page.waitForTimeout(2100); // The button says again what it does.
    }
  });

  await check('it ends when nobody looks', async () => {
    await page.evaluate(`${app}.showPanel('robot')`);
    await until(
      page,
      `document.querySelector('rave-app').model.probes.sensor(${kFirst}) === undefined`,
    );
    assert.deepEqual(said.findLast(({type}) => type === 'look_probes').probes, []);
    await page.waitForTimeout(500);
    const before = frames;
    await page.waitForTimeout(1000);
    assert.equal(frames, before);
  });

  await check('on a phone', async () => {
    const phone = await browser.newContext({
      viewport: {width: 390, height: 844},
      hasTouch: true,
      isMobile: true,
      storageState: await context.storageState(),
    });
    const hand = await phone.newPage();
    await hand.goto(servers[0].link.replace(/\/enter.*/, '/'));
    await until(hand, `${app}?.model?.poses?.newest != null`);
    await choose(hand, real);
    await hand.evaluate(`${app}.showPanel('probe')`);
    await until(hand, `${reading(real)}?.rows === 180`);
    assert.ok(
      (await hand.locator('rave-probe').evaluate((view) => view.scrollWidth - view.clientWidth)) <=
        0,
    );
    await hand.waitForTimeout(400);
    await hand.screenshot({path: join(folder, 'probe-phone.png')});
    await phone.close();
    await servers[0].end();
  });

  await check('over two hosts, as the robot that has the same sensor reads it', async () => {
    await start([
      'run',
      twoRobots,
      '--gui',
      '--quiet',
      '--no-picture',
      '--no-record',
      '--pace',
      'realtime',
      '--processes',
      '2',
      '--output',
      join(folder, 'two'),
      '--run',
      `probe-${process.pid}`,
    ]);
    for (const name of ['anna', 'ben']) {
      const slot = await slotOf(page, name);
      await open(name);
      await choosesDriver('virtual_laser');
      for (const [field, value] of [
        ['rays', 61],
        ['fov_deg', 240],
        ['range_max_m', 3],
        ['x_m', 0.05],
        ['z_m', 0.08],
      ])
        await fill(field, value);
      await until(
        page,
        `${reading(slot)}?.rows === 61 && ${app}.model.probes.sensor(${kFirst})?.mount[0] === 0.05`,
      );
      // Of one step both see the same, but for the noise of the robot file.
      await page.evaluate(
        (of) => document.querySelector('rave-app').link.look(window, [[of, 0]]),
        slot,
      );
      await until(
        page,
        `(() => {
        const {readings} = document.querySelector('rave-app').model;
        const [own, tried] = [readings.of(${slot}, 0), readings.of(${slot}, ${kFirst})];
        if (own === null || tried === null || own.stamp_s !== tried.stamp_s || own.rows !== 61) return false;
        return own.values.filter((range, i) => Number.isFinite(range) !== Number.isFinite(tried.values[i]) || (Number.isFinite(range) && Math.abs(range - tried.values[i]) > 0.06)).length <= 2;
      })()`,
        30000,
      );
    }
    await servers.at(-1).end();
  });

  await check('a run with a probe has the hash of the run without', async () => {
    const seconds = ['--quiet', '--no-picture', '--duration', '8'];
    spawnSync(
      rave,
      ['run', mixed, ...seconds, '--pace', 'max', '--no-record', '--output', join(folder, 'alone')],
      {stdio: 'ignore'},
    );
    await start([
      'run',
      mixed,
      '--gui',
      ...seconds,
      '--pace',
      'realtime',
      '--output',
      join(folder, 'watched'),
    ]);
    await open('real-3');
    await choosesDriver('neighbour_velocity');
    await until(page, `${reading(real)} != null`);
    await until(page, `${app}.model.hello.run.source === 'replay'`, 40000);
    assert.equal(
      await page.evaluate(`${app}.model.hello.run.hash`),
      JSON.parse(readFileSync(join(folder, 'alone', 'result.json'))).hash,
    );
    assert.equal(await page.evaluate(`${app}.model.may('probe')`), false);
    assert.deepEqual(errors, []);
  });

  await check('every message is as the schema describes it', async () => {
    const file = join(folder, 'messages.json');
    const types = ['catalogue', 'ask_catalogue', 'probes', 'look_probes'];
    writeFileSync(file, JSON.stringify(said.filter(({type}) => types.includes(type))));
    for (const type of types)
      assert.ok(
        said.some((message) => message.type === type),
        type,
      );
    execFileSync('python3', [new URL('check_messages.py', import.meta.url).pathname, file], {
      stdio: 'inherit',
    });
  });
} finally {
  for (const server of servers) server.child.kill('SIGTERM');
  await browser.close();
}
report();
process.exit(0);
