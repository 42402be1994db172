// SPDX-License-Identifier: Apache-2.0
// Where things stand on the page of who drives, at the sizes of laptops, phones and pens: node
// drive_layout_test.mjs PAGE FOLDER
import assert from 'node:assert/strict';
import {mkdirSync} from 'node:fs';
import {join} from 'node:path';
import {launch} from './browser.mjs';
import {app, check, report, showFailures, until, untilHere} from './checks.mjs';
import {FakeRun} from './fake_run.mjs';
import {serveFake} from './fake_server.mjs';
import {Hand} from './hands.mjs';

const [built, folder] = process.argv.slice(2);
mkdirSync(folder, {recursive: true});
const kClasses = [
  'pose',
  'true_pose',
  'readings',
  'hybrid_parts',
  'obstacles',
  'goals',
  'maps',
  'chat',
  'log',
  'video',
  'recording',
  'stop',
  'release',
  'run_control',
  'command',
  'edit',
  'probe',
];
const run = new FakeRun(16, {now_s: 24, duration_s: 100_000});
run.rights.classes = kClasses;
for (const row of run.rights.rows)
  row.cells = Object.fromEntries(kClasses.map((what) => [what, 'all']));
let server = await serveFake(built, run);
const {port} = new URL(server.origin);
const browser = await launch();
const choose = (page, ...slots) =>
  page.evaluate((what) => document.querySelector('rave-app').selection.set(what), slots);

async function opened(width, height, more = {}) {
  const page = await (await browser.newContext({viewport: {width, height}, ...more})).newPage();
  showFailures(page, join(folder, `failed-${width}x${height}.png`));
  await page.goto(server.origin);
  await until(page, `${app}?.model?.poses?.newest != null && ${app}.model.drives.size === 16`);
  await choose(page, 6);
  return page;
}

/** What of the stick's panel is cut, and where its parts are. */
const partsOf = (page) =>
  page.evaluate(() => {
    const root = document.querySelector('rave-app').joystick;
    const panel = root.getBoundingClientRect();
    const cut = [];
    const boxes = {};
    for (const part of [
      'header',
      'rave-lease',
      '.figures',
      '.middle > *',
      '.dial',
      '.pad.steering',
      '.pad.throttle',
      '.gears',
      '.notes',
      '.line',
      '.chip',
      '.delay',
    ]) {
      const element = root.renderRoot.querySelector(part);
      if (element === null) continue;
      const {left, top, right, bottom} = element.getBoundingClientRect();
      boxes[part] = [left, top, right, bottom].map(Math.round);
      if (
        left < panel.left - 1 ||
        right > panel.right + 1 ||
        top < panel.top - 1 ||
        bottom > panel.bottom + 1 ||
        bottom - top < 10
      )
        cut.push(part);
    }
    if (root.scrollHeight > root.clientHeight + 1 || root.scrollWidth > root.clientWidth + 1)
      cut.push('scrolls');
    return {cut, boxes};
  });

/** Everything that the panel can say, at once. */
async function sayMuch(page) {
  await page.evaluate(() => {
    const {model, joystick} = document.querySelector('rave-app');
    const t = model.poses.newest.time_s;
    const event = (i, text) => ({
      t,
      until: t + 5,
      count: 1,
      kind: 'guard slowed',
      level: 'warn',
      text,
      slots: [6],
    });
    model.takeMessage({
      type: 'events',
      first: model.events.length,
      events: [1, 2, 3].map((i) =>
        event(
          i,
          `walker-2: the crate stands 0.31 m ahead of it and a wall is on both sides of the way that was asked for, ${i}`,
        ),
      ),
    });
    joystick.loop.refusal =
      'The robot refuses this: its drive has not answered for four seconds, and its battery is nearly empty, so that it will not be moved.';
    joystick.requestUpdate();
  });
  run.drives.get(6).lease = 'Ada N';
  server.say(run.leases([6]));
  server.say(
    run.say(
      {
        to: 'all',
        text: 'A message that is much longer than the column in which it is to be shown, so it has to be cut.',
      },
      {name: 'Ben K', role: 'commander'},
    ),
  );
  await until(page, `${app}.model.drives.get(6).yours && ${app}.model.events.length >= 3`);
  await page.evaluate(`${app}.joystick.updateComplete`);
}

function forget() {
  run.drives.get(6).lease = '';
  run.lines = [];
}

/** Pixels below the top of the picture: its height, the driven robot and its way in two seconds,
 * and what the controls cover. */
function placesOf(page, controls) {
  return page.evaluate((part) => {
    const {world, joystick} = document.querySelector('rave-app');
    const stage = world.stage.element.getBoundingClientRect();
    const [x, y] = world.screenOf(6);
    const {scale} = world.top.camera;
    const top = (of) =>
      joystick.renderRoot.querySelector(of).getBoundingClientRect().top - stage.top;
    return {
      world: stage.height,
      x,
      y,
      lead: 2 * joystick.full_mps * scale,
      free: top(part),
      read: top('.says'),
    };
  }, controls);
}

try {
  for (const [width, height] of [
    [1366, 768],
    [1280, 800],
    [1600, 1000],
    [1000, 800],
    [820, 1100],
  ]) {
    await check(
      `${width}x${height}: stick, pedals and line are whole, and no message moves them`,
      async () => {
        const page = await opened(width, height);
        await page.getByRole('radio', {name: 'Drive', exact: true}).click();
        for (const layout of ['Stick', 'Pedals']) {
          await page.getByRole('radio', {name: layout, exact: true}).click();
          await until(
            page,
            `${app}.joystick.renderRoot.querySelector('${layout === 'Stick' ? '.stick' : '.car'}') !== null`,
          );
          const before = await partsOf(page);
          assert.deepEqual(before.cut, [], layout);
          await sayMuch(page);
          await page.screenshot({path: join(folder, `${width}x${height}-${layout}.png`)});
          const after = await partsOf(page);
          assert.deepEqual(after, before, layout);
          forget();
          server.say(run.leases([6]));
          await until(page, `!${app}.model.drives.get(6).yours`);
        }
        await page.context().close();
      },
    );
  }

  for (const [name, width, height] of [
    ['phone', 390, 844],
    ['pen', 480, 640],
  ]) {
    const shape = {hasTouch: true, isMobile: true};
    await check(
      `${name}: goal, path, drive, stop and lease are in a row, and who has selected nothing is told of it`,
      async () => {
        const page = await opened(width, height, shape);
        await choose(page);
        await page.locator('rave-robot-bar').getByText('Tap a robot').waitFor();
        await choose(page, 6);
        const buttons = page.locator('rave-robot-bar button');
        assert.deepEqual(await buttons.allInnerTexts(), [
          'Goal',
          'Path',
          'Drive',
          'Stop it',
          'Lease',
        ]);
        for (const button of await buttons.all())
          assert.equal((await button.boundingBox()).height, 58);
        await buttons.filter({hasText: 'Goal'}).click();
        await until(page, `${app}.world.tool === 'goal'`);
        await buttons.filter({hasText: 'Goal'}).click();
        await until(page, `${app}.world.tool === 'select'`);
        await buttons.filter({hasText: 'Lease'}).click();
        await page.locator('rave-robot-bar').getByRole('button', {name: 'Take control'}).click();
        await untilHere(page, () => run.drives.get(6).lease === 'Ada N', 'the lease is taken');
        await buttons.filter({hasText: 'Stop it'}).click();
        await untilHere(
          page,
          () => run.stopped.has(6) && run.stopped.size === 1,
          'it stops, and no other',
        );
        await buttons.filter({hasText: 'Release it'}).click();
        await untilHere(page, () => run.stopped.size === 0, 'it goes again');
        forget();
        await page.context().close();
      },
    );

    await check(
      `${name}: who drives sees the world, the robot and where it is in two seconds`,
      async () => {
        const page = await opened(width, height, shape);
        const buttons = page.locator('rave-robot-bar button');
        const before = await page.locator('rave-world').boundingBox();
        await buttons.filter({hasText: 'Drive'}).click();
        for (const layout of ['Stick', 'Pedals']) {
          await page.getByRole('radio', {name: layout, exact: true}).click();
          const controls = layout === 'Stick' ? '.stick' : '.car';
          await until(
            page,
            `${app}.joystick.renderRoot.querySelector('${controls}') !== null && ${app}.world.top.camera.covered.bottom === ${app}.joystick.covers_px`,
          );
          await until(page, `${app}.selection.following`);
          const seen = await placesOf(page, controls);
          assert.ok(seen.world >= before.height, `${seen.world} px of world`);
          assert.ok(
            seen.y + seen.lead < Math.min(seen.free, seen.read) &&
              seen.y - seen.lead > 0 &&
              seen.x - seen.lead > 0 &&
              seen.x + seen.lead < width,
            JSON.stringify(seen),
          );
          await page.screenshot({path: join(folder, `${name}-${layout}.png`)});
        }
        await page.getByRole('radio', {name: 'Stick', exact: true}).click();
        const box = await page.locator('rave-joystick .stick').boundingBox();
        const stop = await page.locator('rave-stop .stop').boundingBox();
        assert.ok(box.y + box.height <= stop.y, 'STOP is free');
        const hand = new Hand(page, 'touch');
        const middle = [box.x + box.width / 2, box.y + box.height / 2];
        await hand.drag([middle, [middle[0], middle[1] - box.height / 4]], false);
        await untilHere(page, () => run.driven.at(-1)?.[1] > 0.1, 'it drives');
        await sayMuch(page);
        assert.deepEqual(await page.locator('rave-joystick .stick').boundingBox(), box);
        await hand.send('up', middle);
        await untilHere(page, () => run.driven.at(-1)?.[1] === 0, 'it stands');
        await page.getByRole('button', {name: 'The stick for the other hand'}).click();
        await until(
          page,
          `${app}.joystick.renderRoot.querySelector('.stick').getBoundingClientRect().left > ${width / 2}`,
        );
        await buttons.filter({hasText: 'Drive'}).click();
        await page.locator('rave-joystick').waitFor({state: 'detached'});
        assert.equal(await page.evaluate(`${app}.world.top.camera.covered.bottom`), 0);
        forget();
        await page.context().close();
      },
    );
  }

  await check(
    'the selection outlives a reload; a speed of an old picture is not shown as driven',
    async () => {
      const page = await opened(1366, 768);
      await choose(page, 3, 6);
      await page.reload();
      await until(page, `${app}?.selection?.slots?.join() === '3,6'`);
      await page.getByRole('radio', {name: 'Drive', exact: true}).click();
      const driven = page.locator('rave-joystick .figures div').nth(1).locator('b');
      await driven.getByText('0.20').waitFor();
      await page.getByText(/^of 27:46:40 · step/).waitFor();
      await server.end();
      await until(page, `${app}.link.state === 'lost'`);
      await driven.getByText('–', {exact: true}).waitFor();
      await page
        .locator('rave-joystick .why')
        .getByText('No line to walker-2: the link is lost.')
        .waitFor();
      await page.context().close();
      server = await serveFake(built, run, Number(port));
    },
  );

  await check('STOP counts those that its person may stop, and names the only one', async () => {
    run.robots.forEach((robot, slot) => slot !== 6 && slot !== 7 && (robot.stoppable = false));
    const page = await opened(1366, 768);
    await page.getByText('2 of 16 robots', {exact: true}).waitFor();
    run.robots[7].stoppable = false;
    server.turnInto({});
    await page.getByText('only walker-2', {exact: true}).waitFor();
    await page.context().close();
    for (const robot of run.robots) delete robot.stoppable;
  });

  await check('at 1000 px layouts can be chosen and robots have their names', async () => {
    run.robots[6].name = 'a-walker-with-a-long-name';
    run.drives.get(6).lease = 'Ben K';
    run.stopped.add(6);
    const page = await opened(1000, 800);
    await page.getByRole('radio', {name: 'Watch', exact: true}).waitFor();
    const narrow = await page
      .locator('rave-robots .name')
      .evaluateAll((names) =>
        names.map((name) => [name.textContent, name.clientWidth]).filter(([, width]) => width < 56),
      );
    assert.deepEqual(narrow, []);
    await page.context().close();
    run.stopped.clear();
    forget();
    run.robots[6].name = 'walker-2';
  });

  for (const [width, height] of [
    [1600, 1000],
    [1366, 768],
  ]) {
    await check(`${width}x${height}: Conduct shows all classes of rights`, async () => {
      Object.assign(run, {role: 'super_user'});
      run.may.push('rights');
      const page = await opened(width, height);
      await page.getByRole('radio', {name: 'Conduct', exact: true}).click();
      const heads = page.locator('rave-rights thead th[scope=col]');
      await heads.first().waitFor();
      assert.equal(await heads.count(), kClasses.length);
      const hidden = await page.locator('rave-rights').evaluate((panel) => {
        const {right} = panel.getBoundingClientRect();
        return [...panel.renderRoot.querySelectorAll('thead th[scope=col]')]
          .filter((head) => head.getBoundingClientRect().right > right)
          .map((head) => head.textContent);
      });
      assert.deepEqual(hidden, []);
      await page.screenshot({path: join(folder, `conduct-${width}.png`)});
      await page.context().close();
      run.may.pop();
      run.role = 'commander';
    });
  }

  await check('scrollbars have the colours of the page', async () => {
    const page = await opened(1366, 768);
    for (const theme of ['dark', 'light']) {
      await page.evaluate((name) => document.querySelector('rave-app').palette.set(name), theme);
      const [colour, thin, wanted] = await page.evaluate(() => {
        const rows = document.querySelector('rave-robots').renderRoot.querySelector('.rows');
        const probe = Object.assign(document.createElement('i'), {style: 'color: var(--line-3)'});
        document.body.append(probe);
        const {color} = getComputedStyle(probe);
        probe.remove();
        const style = getComputedStyle(rows);
        return [style.scrollbarColor, style.scrollbarWidth, color];
      });
      assert.ok(colour.startsWith(wanted), `${colour}, not ${wanted}`);
      assert.equal(thin, 'thin');
    }
    await page.context().close();
  });
} finally {
  await browser.close();
  await server.end();
}
report();
process.exit(0);
