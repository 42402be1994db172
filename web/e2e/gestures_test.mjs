// SPDX-License-Identifier: Apache-2.0
// Gestures on a small screen against a made-up run: node gestures_test.mjs PAGE FOLDER
// One finger holds the key; a pen, another finger or the phone itself makes the gesture.
import assert from 'node:assert/strict';
import {mkdirSync, rmSync} from 'node:fs';
import {join} from 'node:path';
import {launch} from './browser.mjs';
import {app, check, report, showFailures, until, untilHere, watch} from './checks.mjs';
import {FakeRun} from './fake_run.mjs';
import {serveFake} from './fake_server.mjs';
import {Hand} from './hands.mjs';

const [pageFolder, folder] = process.argv.slice(2);
rmSync(folder, {recursive: true, force: true});
mkdirSync(folder, {recursive: true});

const run = new FakeRun(16, {real: 5});
run.state = 'paused';
run.may = [...new Set([...run.may, 'stop', 'release'])];
const server = await serveFake(pageFolder, run);
const browser = await launch();
const heard = (type, kind) =>
  server.heard.filter(
    (message) => message.type === type && (message.kind === kind || message.do === kind),
  );

/** Strokes about a point of the page; y downwards. */
const circle = ([x, y], r) =>
  Array.from({length: 25}, (_, i) => {
    const angle = -Math.PI / 2 - (2 * Math.PI * i) / 24;
    return [x + r * Math.cos(angle), y + r * Math.sin(angle)];
  });
const cross = ([x, y], r) => [
  [x - r, y - r],
  [x + r, y + r],
  [x + r, y - r],
  [x - r, y + r],
];
const tick = ([x, y], r) => [
  [x - r, y + 0.2 * r],
  [x - 0.3 * r, y + r],
  [x + r, y - r],
];
const line = ([x, y], r) => [
  [x - r, y],
  [x, y - 0.05 * r],
  [x + r, y - 0.1 * r],
];

try {
  for (const [name, width, height] of [
    ['phone', 390, 844],
    ['pen', 480, 640],
  ]) {
    const context = await browser.newContext({
      viewport: {width, height},
      hasTouch: true,
      isMobile: true,
    });
    const page = await context.newPage();
    const seen = watch(page, server.origin);
    showFailures(page, join(folder, `failure-${name}.png`));
    await page.goto(server.origin);
    await until(page, `${app}?.model?.poses?.newest != null && ${app}.model.drives.size === 16`);
    const gesture = page.locator('rave-gesture');
    const key = gesture.locator('.key');
    await key.waitFor();
    const client = await context.newCDPSession(page);
    const middleOf = async (locator) => {
      const box = await locator.boundingBox();
      return [box.x + box.width / 2, box.y + box.height / 2];
    };
    const thumb = await middleOf(key);
    const held = {x: thumb[0], y: thumb[1], id: 1};
    const touch = (type, points) =>
      client.send('Input.dispatchTouchEvent', {type, touchPoints: points});
    const hold = async () => {
      await touch('touchStart', [held]);
      await gesture.locator('.paper').waitFor();
    };
    const letGo = async () => {
      await touch('touchEnd', []);
      await gesture.locator('.paper').waitFor({state: 'detached'});
    };
    const tapWhileHeld = async (locator) => {
      const [x, y] = await middleOf(locator);
      const second = {x, y, id: 2};
      await touch('touchStart', [held, second]);
      // Chromium lifts those that are listed.
      await touch('touchEnd', [second]);
    };
    const pen = new Hand(page, 'pen');
    const world = await page.locator('rave-world .canvas').boundingBox();
    const centre = [world.x + world.width / 2, world.y + 0.4 * world.height];
    const radius = 0.3 * Math.min(world.width, world.height);
    const shown = (text) => gesture.locator('.card', {hasText: text}).waitFor();
    const asked = () => server.heard.filter(({type}) => type === 'order' || type === 'halt').length;

    await check(`${name}: a circle says what it means and is sent on request`, async () => {
      const before = asked();
      await hold();
      await pen.drag(circle(centre, radius));
      await shown('Circle: gather here');
      await page.screenshot({path: join(folder, `${name}-gather.png`)});
      assert.equal(asked(), before, 'nothing is sent yet');
      const send = gesture.getByRole('button', {name: /^Send to/});
      assert.ok((await send.boundingBox()).height >= 48);
      await tapWhileHeld(send);
      await untilHere(page, () => asked() === before + 1, 'the goals are sent');
      const {slots, points} = heard('order', 'goal').at(-1);
      assert.ok(slots.length > 1 && points.length === slots.length);
      const [x, y] = await page.evaluate(([px, py]) => {
        const {camera, element} = document.querySelector('rave-app').world.top;
        const box = element.getBoundingClientRect();
        return camera.toWorld(px - box.left, py - box.top);
      }, centre);
      const mean = [0, 1].map((k) => points.reduce((sum, p) => sum + p[k], 0) / points.length);
      assert.ok(Math.hypot(mean[0] - x, mean[1] - y) < 0.5, `${mean} is not about ${[x, y]}`);
      await letGo();
    });

    await check(`${name}: Cancel drops it, and so does letting go of the key`, async () => {
      const before = asked();
      await hold();
      await pen.drag(tick(centre, radius));
      await shown('Tick: go there');
      await tapWhileHeld(gesture.getByRole('button', {name: 'Cancel'}));
      await shown('Nothing was sent.');
      await pen.drag(tick(centre, radius));
      await shown('Tick: go there');
      await letGo();
      await shown('Nothing was sent.');
      assert.equal(await gesture.getByRole('button', {name: /^Send/}).count(), 0);
      assert.equal(asked(), before);
    });

    await check(`${name}: another finger draws as a pen does`, async () => {
      await hold();
      const points = tick(centre, radius);
      const [first, ...rest] = points.flatMap((to, i) =>
        i === 0
          ? [to]
          : [0.2, 0.4, 0.6, 0.8, 1].map((share) =>
              [0, 1].map((k) => points[i - 1][k] + share * (to[k] - points[i - 1][k])),
            ),
      );
      const at = ([x, y]) => [held, {x, y, id: 2}];
      await touch('touchStart', at(first));
      for (const point of rest) await touch('touchMove', at(point));
      const [x, y] = points[points.length - 1];
      await touch('touchEnd', [{x, y, id: 2}]);
      await shown('Tick: go there');
      await letGo();
    });

    await check(`${name}: what is none of the gestures is refused`, async () => {
      const before = asked();
      await hold();
      await pen.drag(line(centre, radius));
      await shown('None of your gestures');
      assert.equal(asked(), before);
      await letGo();
    });

    await check(`${name}: a cross stops all robots at once`, async () => {
      const before = heard('halt', 'stop').length;
      await hold();
      await pen.drag(cross(centre, radius));
      await untilHere(page, () => heard('halt', 'stop').length === before + 1, 'the stop is sent');
      assert.deepEqual(heard('halt', 'stop').at(-1), {type: 'halt', do: 'stop', slots: []});
      await letGo();
    });

    await check(`${name}: without the key a cross is none`, async () => {
      const before = asked();
      await pen.drag(cross(centre, radius));
      await page.waitForTimeout(200);
      assert.equal(asked(), before);
    });
    assert.deepEqual(seen.errors ?? [], []);
    if (name === 'phone')
      await checkMotion({page, gesture, hold, letGo, shown, asked, tapWhileHeld});
    await context.close();
  }
} finally {
  await browser.close();
  await server.end();
}
report();
process.exit(0);

/** Moves the phone for a second: `bend` tells one motion from another. */
async function shake(page, bend) {
  await page.evaluate(
    (kind) =>
      new Promise((done) => {
        const begun = performance.now();
        const timer = setInterval(() => {
          const t = (performance.now() - begun) / 1000;
          const a =
            t > 1
              ? [0, 0, 0]
              : kind === 'round'
                ? [6 * Math.cos(6.3 * t), 6 * Math.sin(6.3 * t), 1]
                : [t < 0.5 ? 8 : -8, 0, 3 * Math.sin(25 * t)];
          const acceleration = {x: a[0], y: a[1], z: a[2]};
          window.dispatchEvent(new DeviceMotionEvent('devicemotion', {acceleration, interval: 20}));
          if (t < 1.6) return;
          clearInterval(timer);
          done();
        }, 20);
      }),
    bend,
  );
}

async function checkMotion({page, gesture, hold, letGo, shown, asked, tapWhileHeld}) {
  const lesson = (name) => gesture.locator('.lesson', {hasText: name});
  await check(
    'motions of the phone are taught in half a minute, and mean something then',
    async () => {
      await shake(page, 'round');
      const begun = Date.now();
      await gesture.getByRole('button', {name: 'Teach'}).tap();
      for (const [name, bend] of [
        ['spread out', 'round'],
        ['gather here', 'bent'],
      ]) {
        await lesson(name).tap();
        await hold();
        for (let i = 1; i <= 5; ++i) {
          await shake(page, bend);
          await lesson(name)
            .locator('i', {hasText: String(i)})
            .waitFor();
        }
        await letGo();
      }
      assert.ok(Date.now() - begun < 60_000, `${Date.now() - begun} ms for two gestures`);
      await gesture.getByRole('button', {name: 'Teach'}).tap();
      const before = asked();
      await shake(page, 'round');
      assert.equal(asked(), before, 'who walks does not command');
      await hold();
      await shake(page, 'round');
      await shown('Spread out');
      await tapWhileHeld(gesture.getByRole('button', {name: /^Send to/}));
      await untilHere(page, () => asked() === before + 1, 'the order is sent');
      await letGo();
    },
  );

  await check('what was taught is there after the page is loaded again', async () => {
    await page.reload();
    await until(page, `${app}?.model?.poses?.newest != null`);
    await gesture.getByRole('button', {name: 'Teach'}).tap();
    await lesson('spread out').locator('i', {hasText: '5'}).waitFor();
    await lesson('go there').locator('i', {hasText: '0'}).waitFor();
    await page.screenshot({path: join(folder, 'teach.png')});
  });
}
