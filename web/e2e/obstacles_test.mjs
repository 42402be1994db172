// SPDX-License-Identifier: Apache-2.0
// An obstacle that is drawn on the page stands in a robot's way, which avoids it; robots are
// placed. node obstacles_test.mjs RAVE SCENARIO FOLDER
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {mkdirSync, rmSync} from 'node:fs';
import {join} from 'node:path';
import {launch, startServer} from './browser.mjs';
import {app, check, report, showFailures, until} from './checks.mjs';
import {choose, newest, placeOf, slotOf} from './commander.mjs';
import {clickAt, dragThrough} from './hands.mjs';

const [rave, scenario, folder] = process.argv.slice(2);
rmSync(folder, {recursive: true, force: true});
mkdirSync(folder, {recursive: true});
const server = await startServer(rave, [
  'run',
  scenario,
  '--gui',
  '--quiet',
  '--no-picture',
  '--pace',
  'realtime',
  '--output',
  join(folder, 'run'),
]);
const browser = await launch();
const contacts = `${app}.model.events.filter((event) => event.kind === 'contact').length`;
const drawn = `[...${app}.model.bodies.values()].find((body) => body.kind === 'virtual')`;
/** What the run itself says of its obstacles. */
const listed = () =>
  execFileSync(rave, ['edit', String(server.child.pid), 'list'], {encoding: 'utf8'});

try {
  const page = await (await browser.newContext({viewport: {width: 1500, height: 950}})).newPage();
  showFailures(page, join(folder, 'failure.png'));
  const say = (message) =>
    page.evaluate((what) => document.querySelector('rave-app').link.send(what), message);
  const stands = async () => {
    await say({type: 'halt', do: 'stop', slots: []});
    await until(
      page,
      `[...${newest}.flags].every((flags, slot) => flags & 4 && ${newest}.speed[slot] === 0)`,
    );
    await page.waitForTimeout(300);
  };
  let anna = 0;
  let ben = 0;

  await check('a polygon is drawn across the way of a robot', async () => {
    await page.goto(server.link);
    await until(page, `${app}?.model?.robots?.length === 2 && ${newest} != null`, 60000);
    [anna, ben] = [await slotOf(page, 'anna'), await slotOf(page, 'ben')];
    await stands();
    const [x, y] = await placeOf(page, anna);
    const yaw = await page.evaluate(`${newest}.yaw[${anna}]`);
    // A wedge 0.9 m ahead, broad enough that it cannot pass by chance.
    const at = (ahead, left) => [
      x + ahead * Math.cos(yaw) - left * Math.sin(yaw),
      y + ahead * Math.sin(yaw) + left * Math.cos(yaw),
    ];
    await page.keyboard.press('o');
    await page.getByRole('radio', {name: 'polygon'}).click();
    const corners = [at(0.9, -0.6), at(1.3, -0.4), at(1.3, 0.4), at(0.9, 0.6)];
    for (const corner of [...corners, corners[0]]) await clickAt(page, ...corner);
    await until(page, `${drawn}?.shapes[0].polygon?.length === 4`);
    await page.keyboard.press('v');
    await page.screenshot({path: join(folder, 'drawn.png')});
  });

  await check('the robot turns away from it, and touches nothing', async () => {
    const yaw = await page.evaluate(`${newest}.yaw[${anna}]`);
    const [x, y] = await placeOf(page, anna);
    const before = await page.evaluate(`${newest}.time_s`);
    await say({type: 'transport', do: 'pace', value: 4});
    await say({type: 'halt', do: 'release', slots: []});
    await until(page, `Math.cos(${newest}.yaw[${anna}] - ${yaw}) < 0.8`);
    const [nx, ny] = await placeOf(page, anna);
    const ahead = (nx - x) * Math.cos(yaw) + (ny - y) * Math.sin(yaw);
    assert.ok(ahead < 0.9, `it turns after ${ahead} m, in front of the polygon`);
    await until(page, `${newest}.time_s > ${before} + 20`);
    await say({type: 'transport', do: 'pace', value: 1});
    await stands();
    assert.equal(await page.evaluate(contacts), 0);
  });

  await check('it is moved, turned and removed, and so it is in the run', async () => {
    const pose = () => page.evaluate(`${drawn}.pose`);
    const [x, y, yaw] = await pose();
    // To a corner where no robot is.
    const robots = await Promise.all([placeOf(page, anna), placeOf(page, ben)]);
    const goal = [
      [-1.2, -1.2],
      [1.2, -1.2],
      [-1.2, 1.2],
    ].find(([gx, gy]) => robots.every(([rx, ry]) => Math.hypot(rx - gx, ry - gy) > 1.1));
    await clickAt(page, x, y);
    await page.getByRole('button', {name: 'Turn left'}).waitFor();
    await dragThrough(page, [[x, y], goal]);
    await until(
      page,
      `Math.hypot(${drawn}.pose[0] - ${goal[0]}, ${drawn}.pose[1] - ${goal[1]}) < 0.1`,
    );
    assert.ok(listed().includes(`${(await pose())[0].toFixed(2)}`), listed());
    await page.getByRole('button', {name: 'Turn left'}).click();
    await until(page, `Math.abs(${drawn}.pose[2] - ${yaw} - Math.PI / 12) < 0.01`);
    await page.screenshot({path: join(folder, 'moved.png')});
    const name = await page.evaluate(`${drawn}.name`);
    assert.ok(listed().includes(name));
    await page.keyboard.press('Delete');
    await until(page, `${drawn} === undefined`);
    assert.equal(listed().includes(name), false, listed());
  });

  await check('an obstacle on top of a robot is refused with a sentence', async () => {
    const [x, y] = await placeOf(page, ben);
    await page.keyboard.press('o');
    await page.getByRole('radio', {name: 'disc'}).click();
    await dragThrough(page, [
      [x, y],
      [x + 0.3, y],
    ]);
    const card = page.locator('rave-world .beside.refused');
    await card.waitFor();
    assert.match(
      await card.innerText(),
      /would overlap the robot `ben` at .*; an obstacle does not push robots away, so put it elsewhere/,
    );
    await page.screenshot({path: join(folder, 'overlap.png')});
    await card.getByRole('button', {name: 'Close'}).click();
    await page.keyboard.press('v');
    assert.equal(await page.evaluate(`${drawn}`), undefined);
  });

  await check('a robot is placed; into a wall, or onto another robot, it is not', async () => {
    await choose(page, ben);
    await page.keyboard.press('b');
    const before = await placeOf(page, ben);
    const card = page.locator('rave-world .beside.refused');
    const [rx, ry] = await placeOf(page, anna);
    // A click on her would choose her.
    for (const [what, [x, y]] of [
      ['east', [2.05, 0.3]],
      ['anna', [rx - 0.25 * Math.sign(rx), ry]],
    ]) {
      await clickAt(page, x, y);
      await card.waitFor();
      assert.match(await card.innerText(), new RegExp(`it would overlap .*${what}`));
      await card.getByRole('button', {name: 'Drop'}).click();
      assert.deepEqual(await placeOf(page, ben), before);
    }
    const [ax, ay] = await placeOf(page, anna);
    const [x, y] = [
      [-1.4, -1.4],
      [1.4, -1.4],
      [-1.4, 1.4],
    ].find(([gx, gy]) => Math.hypot(ax - gx, ay - gy) > 0.8);
    await clickAt(page, x, y);
    await until(page, `Math.hypot(${newest}.x[${ben}] - ${x}, ${newest}.y[${ben}] - ${y}) < 0.05`);
  });
  report();
} finally {
  await browser.close();
  server.child.kill('SIGKILL');
}
process.exit(0);
