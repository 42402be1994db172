// SPDX-License-Identifier: Apache-2.0
// The panel Robot: a Create is handed over to its hardware and back, with its shadow; over two
// hosts as well. node robot_test.mjs RAVE PEER ROBOTS TWO_HOSTS FOLDER
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {mkdirSync, rmSync, writeFileSync} from 'node:fs';
import {join, resolve} from 'node:path';
import {knowsHosts, launch, startServer} from './browser.mjs';
import {app, check, report, showFailures, until} from './checks.mjs';
import {choose, newest, slotOf} from './commander.mjs';
import {freePort, startPeer} from './peer_create.mjs';

const [rave, peer, robots, twoHosts, folder] = process.argv.slice(2);
const kStart = {x_m: 1, y_m: 1, yaw_rad: 0.4};
rmSync(folder, {recursive: true, force: true});
mkdirSync(folder, {recursive: true});

function scenarioWithTwin(port) {
  const walls = [
    ['south', 4.2, 0.1, 2, -0.05],
    ['north', 4.2, 0.1, 2, 3.05],
    ['west', 0.1, 3, -0.05, 1.5],
    ['east', 0.1, 3, 4.05, 1.5],
  ];
  writeFileSync(
    join(folder, 'world.yaml'),
    `obstacles:\n${walls.map(([name, w, h, x, y]) => `  - {name: ${name}, box_m: [${w}, ${h}], x_m: ${x}, y_m: ${y}, layer: mapped_real}\n`).join('')}`,
  );
  const scenario = join(folder, 'scenario.yaml');
  const file = (name) => resolve(robots, `${name}.yaml`);
  writeFileSync(
    scenario,
    `name: twins\nduration_s: 600\nmax_missed_pct: 50\nclock: real_time\nworld: world.yaml\nrobots:\n  - name: rosie\n    file: ${file('create-simulated')}\n    twin: ${file('create')}\n    shadow: true\n    pose: {x_m: ${kStart.x_m}, y_m: ${kStart.y_m}, yaw_deg: ${(kStart.yaw_rad * 180) / Math.PI}}\n    variables: {base: '${join(folder, 'base')}', laser: '${join(folder, 'laser')}', mocap_port: ${port}, mocap_body: create}\n`,
  );
  return scenario;
}

const browser = await launch();
const children = [];
const said = [];
try {
  const port = await freePort();
  const real = await startPeer(peer, folder, port, kStart);
  children.push(real.child);
  const context = await browser.newContext({viewport: {width: 1500, height: 950}});
  const page = await context.newPage();
  page.on('websocket', (socket) => {
    for (const way of ['framesent', 'framereceived'])
      socket.on(way, ({payload}) => typeof payload === 'string' && said.push(JSON.parse(payload)));
  });
  showFailures(page, join(folder, 'failure.png'));
  const server = await startServer(rave, [
    'run',
    scenarioWithTwin(port),
    '--gui',
    '--quiet',
    '--no-picture',
    '--output',
    join(folder, 'run'),
  ]);
  children.push(server.child);
  const twin = `${app}.model.drives.get(0)?.twin`;
  const shadow = `${app}.model.drives.get(0)?.shadow`;
  const told = (slot) => `${app}.model.readings.of(${slot}, 0xefff)`;
  const panel = page.locator('rave-robot');
  const handOver = async (to) => {
    await panel.getByRole('button', {name: `Hand over to ${to}`}).click();
    await panel.getByRole('button', {name: 'Hand over now'}).click();
  };

  await check(
    'the panel shows which drivers are in use, with parameters and their ranges',
    async () => {
      await page.goto(server.link);
      await until(page, `${newest} != null && ${newest}.time_s > 0.5`, 60000);
      await choose(page, 0);
      await page.getByRole('radio', {name: 'Drive'}).click();
      await until(page, `${twin}?.simulated === true`);
      await panel.getByText('simulated drivers in use').waitFor();
      await panel.getByText('virtual_laser').waitFor();
      assert.equal(
        await panel.getByLabel('program.cruise_mps', {exact: true}).getAttribute('type'),
        'range',
      );
    },
  );

  await check(
    'what its program asks for is drawn beside what is driven, although nobody here asked for it',
    async () => {
      await until(
        page,
        `${told(0)}?.values[0] > 0.05 && Math.abs(${told(0)}.values[2] - ${told(0)}.values[0]) < 0.02`,
      );
      await until(
        page,
        `document.querySelector('rave-app').model.readings.course(0, 0xefff).length > 20`,
      );
      await panel.locator('polyline.asked').first().waitFor({state: 'attached'});
    },
  );

  await check(
    'a parameter that is set there counts, and one outside of its range is refused with the range',
    async () => {
      const slider = panel.getByLabel('program.cruise_mps, value');
      await slider.fill('0.1');
      await slider.press('Enter');
      await until(
        page,
        `${app}.model.events.some(({text}) => /cruise_mps/.test(text) && /0\\.1/.test(text))`,
      );
      // A page that comes later has it, and one that is there has what a terminal sets.
      const other = await context.newPage();
      await other.goto(new URL('/', server.link).href);
      await until(
        other,
        `${app}?.model?.drives?.get(0)?.values?.['program.cruise_mps'] === 0.1`,
        30000,
      );
      await other.close();
      execFileSync(rave, ['set', 'rosie', 'program.cruise_mps', '0.15', '--run', 'twins'], {
        stdio: ['ignore', 'ignore', 'inherit'],
      });
      await page.waitForFunction(
        () =>
          document
            .querySelector('rave-robot')
            .renderRoot.querySelector('input[aria-label="program.cruise_mps, value"]').value ===
          '0.15',
      );
      await slider.fill('-3');
      await slider.press('Enter');
      await panel.getByRole('alert').waitFor();
      assert.match(await panel.getByRole('alert').innerText(), /cruise_mps/);
    },
  );

  await check(
    'a hand-over to a robot that stands elsewhere is refused, with both places',
    async () => {
      await page.evaluate(() =>
        document.querySelector('rave-app').link.send({type: 'halt', do: 'stop', slots: []}),
      );
      await until(page, `(${newest}.flags[0] & 4) !== 0 && Math.abs(${newest}.speed[0]) < 0.001`);
      await real.tell('place 3.5 2.5 0');
      await handOver('real');
      await until(page, `${twin}.refused === 1 && !${twin}.under_way`, 40000);
      await panel.getByText('Refused:').waitFor();
      await page.screenshot({path: join(folder, 'refused.png')});
    },
  );

  await check('a hand-over to the hardware, which then drives, with its shadow', async () => {
    const [x, y, yaw] = await page.evaluate(`[${newest}.x[0], ${newest}.y[0], ${newest}.yaw[0]]`);
    await real.tell(`place ${x} ${y} ${yaw}`);
    await handOver('real');
    await until(page, `${twin}.made === 1 && ${twin}.simulated === false`, 40000);
    await panel.getByText('real drivers in use').waitFor();
    await until(page, `${app}.model.robots[0].kind === 'real'`);
    await panel.getByText('scip_laser').waitFor();
    const before = (await real.state()).path_m;
    await page.evaluate(() =>
      document.querySelector('rave-app').link.send({type: 'halt', do: 'release', slots: []}),
    );
    await until(page, `${shadow}?.running === true && ${shadow}.most_m > 0.001`, 30000);
    const end = Date.now() + 20000;
    while ((await real.state()).path_m < before + 0.15)
      assert.ok(Date.now() < end, 'the Create does not drive');
    await panel.getByText('difference', {exact: true}).waitFor();
    const laser = await page.evaluate(`${shadow}.readings.find(({sensor}) => sensor === 'laser')`);
    assert.equal(laser.unit, 'm');
    const {m, offset} = await page.evaluate(shadow);
    // The World View draws the shadow there, dashed.
    assert.ok(Math.abs(Math.hypot(offset[0], offset[1]) - m) < 2e-4, `${offset}, but ${m} m`);
    await page.locator('rave-robot .scroll').evaluate((scroll) => scroll.scrollTo(0, 300));
    for (const theme of ['dark', 'light']) {
      await page.evaluate(`${app}.palette.set('${theme}')`);
      await page.waitForTimeout(400);
      await page.screenshot({path: join(folder, `robot-${theme}.png`)});
    }
  });

  await check('the shadow is put where the robot is', async () => {
    const since = await page.evaluate(`${shadow}.since_s`);
    await panel.getByRole('button', {name: 'Reset the shadow'}).click();
    await until(page, `${shadow}.since_s > ${since}`);
  });

  await check('on a phone', async () => {
    const phone = await browser.newContext({
      viewport: {width: 390, height: 844},
      hasTouch: true,
      isMobile: true,
      storageState: await context.storageState(),
    });
    const hand = await phone.newPage();
    await hand.goto(server.link.replace(/\/enter.*/, '/'));
    await until(hand, `${app}?.model?.poses?.newest != null`);
    await choose(hand, 0);
    await hand.evaluate(`${app}.showPanel('robot')`);
    await hand.locator('rave-twin').getByText('difference', {exact: true}).waitFor();
    const [wide, has] = await hand
      .locator('rave-robot .scroll')
      .evaluate((scroll) => [scroll.scrollWidth, scroll.clientWidth]);
    assert.ok(wide <= has, `${wide} px in ${has}`);
    await hand.locator('rave-twin').scrollIntoViewIfNeeded();
    await hand.screenshot({path: join(folder, 'robot-phone.png')});
    await phone.close();
  });

  await check(
    'and back: the hardware stands, the simulated robot goes on where it was',
    async () => {
      await handOver('simulated');
      await until(page, `${twin}.made === 2 && ${twin}.simulated`, 40000);
      const {left_mps, right_mps} = await real.state();
      assert.deepEqual([left_mps, right_mps], [0, 0]);
      await until(page, `${shadow}.running === false`);
      await until(page, `Math.abs(${newest}.speed[0]) > 0.02`, 20000);
      await server.end();
    },
  );

  await check('over two hosts in real time, each of which hands its own robots over', async () => {
    const run = await startServer(rave, [
      'run',
      twoHosts,
      '--gui',
      '--quiet',
      '--no-picture',
      '--no-record',
      '--processes',
      '2',
      '--output',
      join(folder, 'two'),
      '--run',
      `robot-${process.pid}`,
    ]);
    children.push(run.child);
    await knowsHosts(run.link, 2, 60000).catch(() => {});
    await page.goto(run.link);
    await until(
      page,
      `${newest} != null && ${app}.model.drives.get(0)?.twin !== undefined && ${app}.model.drives.get(1)?.twin !== undefined`,
      60000,
    );
    await choose(page, await slotOf(page, 'left'));
    await page.evaluate(`${app}.showPanel('robot')`);
    await handOver('the second set');
    await until(page, `${twin}.made === 1`, 40000);
    await panel.getByText('second set in use').waitFor();
    await until(page, `${told(await slotOf(page, 'left'))}?.values.length === 4`);
    await run.end();
  });

  await check('every message is as the schema describes it', async () => {
    const file = join(folder, 'messages.json');
    writeFileSync(
      file,
      JSON.stringify(
        said.filter(({type}) => ['twin', 'leases', 'answer', 'roster'].includes(type)),
      ),
    );
    assert.ok(said.some(({type}) => type === 'twin'));
    execFileSync('python3', [new URL('check_messages.py', import.meta.url).pathname, file], {
      stdio: 'inherit',
    });
  });
} finally {
  await browser.close();
  for (const child of children) child.kill('SIGKILL');
}
report();
process.exit(0);
