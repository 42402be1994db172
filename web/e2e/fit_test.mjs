// SPDX-License-Identifier: Apache-2.0
// What the World View shows of a made-up run by itself and when it is asked for everything: node
// fit_test.mjs PAGE FOLDER
import assert from 'node:assert/strict';
import {mkdirSync} from 'node:fs';
import {join} from 'node:path';
import {launch} from './browser.mjs';
import {app, check, report, showFailures, until} from './checks.mjs';
import {FakeRun} from './fake_run.mjs';
import {serveFake} from './fake_server.mjs';

const [built, folder] = process.argv.slice(2);
mkdirSync(folder, {recursive: true});
const kRoom_m = 12;
const world = 'document.querySelector("rave-app").world';

/** Two simulated robots of two kinds; the second one goes where `there` says. */
class Hunt extends FakeRun {
  there = [1, 1];

  constructor() {
    super(2, {real: 0, now_s: 5});
    ['predator', 'prey'].forEach((word, i) => Object.assign(this.robots[i], {name: word, word}));
    const long = (id, x, y, w, h) => ({
      id,
      name: `wall-${id}`,
      kind: 'wall',
      pose: [x, y, 0],
      shapes: [
        {
          polygon: [
            [0, 0],
            [w, 0],
            [w, h],
            [0, h],
          ],
          z: [0, 1],
        },
      ],
    });
    const half = kRoom_m / 2;
    this.bodies = [
      long(1, -half, -half, kRoom_m, 0.1),
      long(2, -half, half, kRoom_m, 0.1),
      long(3, -half, -half, 0.1, kRoom_m),
      long(4, half, -half, 0.1, kRoom_m),
    ];
  }

  place(i) {
    return i === 0 ? [-1, -1, 0] : [...this.there, 0];
  }
}

/** Whether a place of the world, or a robot, is in the picture. */
const holds = (at) =>
  `(() => { const {clientWidth, clientHeight} = ${world}.stage.element; const [x, y] = ${at}; return x >= 0 && y >= 0 && x <= clientWidth && y <= clientHeight; })()`;
const holdsPrey = `${holds(`${world}.screenOf(1)`)} && Math.hypot(${app}.model.poses.newest.x[1] - THERE[0], ${app}.model.poses.newest.y[1] - THERE[1]) < 0.1`;
const preyAt = (there) => holdsPrey.replaceAll('THERE', JSON.stringify(there));

const run = new Hunt();
const server = await serveFake(built, run);
const browser = await launch();
try {
  for (const [width, height] of [
    [1366, 768],
    [390, 844],
  ]) {
    run.there = [1, 1];
    const page = await (
      await browser.newContext({viewport: {width, height}, hasTouch: width < 600})
    ).newPage();
    showFailures(page, join(folder, 'failed.png'));
    await page.goto(server.origin);
    await until(page, `${app}?.model?.poses?.newest != null`);
    await until(page, preyAt(run.there));

    await check(
      `${width}x${height}: an untouched picture keeps a robot that leaves it`,
      async () => {
        for (const there of [
          [5, 5],
          [-15, 4],
          [20, -18],
        ]) {
          run.there = there;
          await until(page, preyAt(there));
        }
        await page.screenshot({path: join(folder, `far-${width}.png`)});
      },
    );

    await check(
      `${width}x${height}: one that the person moved stays, until everything is asked for`,
      async () => {
        run.there = [2, 0];
        await until(page, preyAt(run.there));
        await page.evaluate(`${world}.lookFrom('top,0,0,80')`);
        await until(page, `${world}.viewpoint().startsWith('top,0')`);
        const before = await page.evaluate(`${world}.viewpoint()`);
        run.there = [30, 0];
        await until(page, `${app}.model.poses.newest.x[1] > 29`);
        const drawn = await page.evaluate(`${world}.painted`);
        await until(page, `${world}.painted > ${drawn} + 40`);
        assert.equal(await page.evaluate(`${world}.viewpoint()`), before);
        run.there = [2, 0];
        await until(page, `${app}.model.poses.newest.x[1] < 3`);
        await page.evaluate(`${world}.fit()`);
        for (const corner of [
          [-6, -6],
          [6, -6],
          [-6, 6],
          [6, 6],
        ])
          await until(page, holds(`${world}.stage.screenAt(${corner})`));
        await page.screenshot({path: join(folder, `everything-${width}.png`)});
        run.there = [30, 0];
        await until(page, preyAt(run.there));
      },
    );
    await page.close();
  }

  await check('predator and prey have colours of their own', async () => {
    const page = await (await browser.newContext({viewport: {width: 1366, height: 768}})).newPage();
    await page.goto(server.origin);
    await until(page, `${app}?.model?.robots?.length === 2`);
    const hues = await page.evaluate(`[0, 1].map((slot) => ${app}.palette.hue(slot).ink)`);
    assert.notEqual(hues[0], hues[1]);
    assert.ok(!hues.includes(await page.evaluate(`${app}.palette.token('sim-ink')`)));
  });
} finally {
  await browser.close();
  await server.end();
}
report();
process.exit(0);
