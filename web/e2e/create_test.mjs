// SPDX-License-Identifier: Apache-2.0
// The same page drives a simulated robot and a Create behind its serial line:
// node create_test.mjs RAVE PEER ROBOTS FOLDER
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {mkdirSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';
import {launch, startServer} from './browser.mjs';
import {app, check, report, showFailures, until} from './checks.mjs';
import {driveByMouse, newest, sendByClick} from './commander.mjs';
import {freePort, startPeer} from './peer_create.mjs';

const [rave, peer, robots, folder] = process.argv.slice(2);
const kStart = {x_m: 1, y_m: 1, yaw_rad: 0.4};
const kGoal = [2.2, 0.8];
rmSync(folder, {recursive: true, force: true});
mkdirSync(folder, {recursive: true});

/** One robot in an empty room, which takes orders by its program and by its controllers. */
function scenarioOf(file, port) {
  const text = readFileSync(join(robots, `${file}.yaml`), 'utf8');
  const robot = join(folder, `${file}.yaml`);
  writeFileSync(
    robot,
    `${text.slice(0, text.lastIndexOf('program:'))}  - {name: navigate, driver: goal_point, actuator: wheels}\nprogram: {driver: obey, params: {velocity_sensor: "", goal_sensor: ""}}\n${file === 'create' ? 'guard: {arm: true}\n' : ''}`,
  );
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
  const scenario = join(folder, `scenario-${file}.yaml`);
  const {x_m, y_m, yaw_rad} = kStart;
  writeFileSync(
    scenario,
    `name: ${file}\nduration_s: 600\nmax_missed_pct: 50\nworld: world.yaml\nrobots:\n  - name: rosie\n    file: ${robot}\n    pose: {x_m: ${x_m}, y_m: ${y_m}, yaw_deg: ${(yaw_rad * 180) / Math.PI}}\n    variables: {base: '${join(folder, 'base')}', laser: '${join(folder, 'laser')}', mocap_port: ${port}, mocap_body: create}\n`,
  );
  return scenario;
}

const browser = await launch();
const children = [];
try {
  for (const [what, file] of [
    ['simulated', 'create-simulated'],
    ['real', 'create'],
  ]) {
    const port = await freePort();
    const real = what === 'real' ? await startPeer(peer, folder, port, kStart) : null;
    if (real) children.push(real.child);
    const context = await browser.newContext({viewport: {width: 1500, height: 950}});
    const page = await context.newPage();
    showFailures(page, join(folder, `failure-${what}.png`));
    const server = await startServer(rave, [
      'run',
      scenarioOf(file, port),
      '--gui',
      '--quiet',
      '--no-picture',
      '--pace',
      'realtime',
      '--output',
      join(folder, what),
    ]);
    children.push(server.child);

    await check(`${what}: the page shows the robot, and what it is`, async () => {
      await page.goto(server.link);
      await until(page, `${newest} != null && ${newest}.time_s > 0.5`, 60000);
      assert.equal(await page.evaluate(`${app}.model.robots[0].kind`), what);
      await page.waitForTimeout(500);
    });

    const refused = async (sentence) => {
      const answer = await page.evaluate(
        (goal) => document.querySelector('rave-app').commands.goal([0], [goal]),
        kGoal,
      );
      assert.equal(answer.good, false, answer.text);
      const card = page.locator('rave-world .beside.refused');
      await card.waitFor();
      assert.match((await card.innerText()).replaceAll('\n', ' '), sentence);
      await card.getByRole('button', {name: 'Drop'}).click();
    };
    if (real) {
      await check('real: before it is armed it takes no goal, and the page says why', async () => {
        await refused(/it waits to be armed/);
        execFileSync(rave, ['arm', String(server.child.pid), '--robot', 'rosie'], {
          stdio: ['ignore', 'ignore', 'inherit'],
        });
      });
    }

    await check(`${what}: a goal by click arrives`, async () => {
      await sendByClick(page, 'rosie', ...kGoal);
      if (!real) return;
      const {x, y} = await real.state();
      assert.ok(
        Math.hypot(x - kGoal[0], y - kGoal[1]) < 0.35,
        `the body of the Create is at ${x}, ${y}`,
      );
    });

    await check(`${what}: the mouse drives it, and letting go stops it`, async () => {
      // The pose of the real one is measured, and so is its speed.
      await driveByMouse(page, 'rosie', real ? 0.05 : 0.001);
      await page.screenshot({path: join(folder, `${what}.png`)});
      if (!real) return;
      const {left_mps, right_mps} = await real.state();
      assert.deepEqual([left_mps, right_mps], [0, 0]);
    });

    await check(`${what}: STOP holds it against a goal`, async () => {
      await page.evaluate(() =>
        document.querySelector('rave-app').link.send({type: 'halt', do: 'stop', slots: []}),
      );
      await until(page, `(${newest}.flags[0] & 4) !== 0`);
      if (real) assert.equal((await real.state()).left_mps, 0);
      await page.evaluate(() =>
        document.querySelector('rave-app').link.send({type: 'halt', do: 'release', slots: []}),
      );
      await until(page, `(${newest}.flags[0] & 4) === 0`);
    });
    if (real) {
      await check('real: where it is not known it stands, and the page says that', async () => {
        await real.tell('mocap mute');
        await until(page, `(${newest}.flags[0] & 2) !== 0`);
        await refused(/its pose is not known at present/);
        assert.deepEqual([(await real.state()).left_mps, (await real.state()).right_mps], [0, 0]);
        await real.tell('mocap speak');
      });
    }
    await context.close();
    await server.end();
    real?.child.kill('SIGKILL');
  }
} finally {
  await browser.close();
  for (const child of children) child.kill('SIGKILL');
}
report();
process.exit(0);
