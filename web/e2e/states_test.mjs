// SPDX-License-Identifier: Apache-2.0
// All states of a page, of a made-up run: node states_test.mjs PAGE FOLDER
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {mkdirSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';
import {launch} from './browser.mjs';
import {app, check, report, showFailures, until, untilHere, watch} from './checks.mjs';
import {FakeRun} from './fake_run.mjs';
import {serveFake} from './fake_server.mjs';
import {checkOpening} from './opening_checks.mjs';
import {checkPeople, checkScene} from './scene_checks.mjs';
import {sizeOf, watchLoads} from './first_load.mjs';

const [built, folder] = process.argv.slice(2);
mkdirSync(folder, {recursive: true});
const run = new FakeRun(16, {now_s: 5});
let server = await serveFake(built, run);
const port = Number(new URL(server.origin).port);
const browser = await launch();
const heard = (type, what) =>
  server.heard.filter(
    (message) => message.type === type && (what === undefined || message.do === what),
  );
try {
  const page = await (await browser.newContext({viewport: {width: 1400, height: 900}})).newPage();
  showFailures(page, join(folder, 'failed.png'));
  const seen = watch(page, server.origin);
  const said = [];
  page.on('websocket', (socket) => {
    for (const way of ['framereceived', 'framesent'])
      socket.on(way, ({payload}) => typeof payload === 'string' && said.push(JSON.parse(payload)));
  });
  const loaded = watchLoads(page);
  await page.goto(server.origin);
  await until(page, `${app}?.model?.poses?.newest !== null`);

  await check(
    'the first load is small: the renderer of the perspective comes when it is asked for',
    async () => {
      const all = sizeOf(loaded, built);
      assert.ok(all < 400e3, `${all} bytes`);
      assert.ok(![...loaded].some((path) => path.includes('perspective')));
    },
  );

  await check('a live run goes on by itself, without a knob', async () => {
    await page.getByText('Live', {exact: true}).waitFor();
    assert.equal(await page.locator('rave-timeline .knob').count(), 0);
    assert.equal(await page.locator('rave-timeline .head').count(), 1);
    const before = await page.evaluate(`${app}.model.poses.newest.time_s`);
    await until(page, `${app}.model.poses.newest.time_s > ${before} + 0.3`);
  });

  await check('the time of a live run cannot be chosen', async () => {
    const box = await page.locator('rave-timeline .line').boundingBox();
    await page.mouse.click(box.x + 20, box.y + 30);
    await page.waitForTimeout(100);
    assert.deepEqual(heard('transport', 'seek'), []);
    assert.equal(
      await page.locator('rave-timeline .line').getAttribute('title'),
      'A live run cannot be moved in time.',
    );
  });

  await check(
    'one click stops all robots; a short press releases nobody, a long one does',
    async () => {
      await page.getByText('STOP', {exact: true}).click();
      await untilHere(page, () => run.stopped.size === 16, 'all stopped');
      const release = page.getByRole('button', {name: 'Hold to release 16 robots'});
      await release.waitFor();
      await release.click({delay: 100});
      await page.waitForTimeout(200);
      assert.equal(run.stopped.size, 16);
      await release.hover();
      await page.mouse.down();
      await untilHere(page, () => run.stopped.size === 0, 'released');
      await page.mouse.up();
      await page.getByText('STOP', {exact: true}).waitFor();
    },
  );

  await check('one Space does nothing, two stop', async () => {
    await page.locator('rave-world .canvas').focus();
    await page.keyboard.press(' ');
    await page.getByText('Space again').waitFor();
    await page.waitForTimeout(900);
    assert.equal(run.stopped.size, 0);
    await page.keyboard.press(' ');
    await page.keyboard.press(' ');
    await untilHere(page, () => run.stopped.size === 16, 'all stopped');
    await page.getByText(/stopped by you at/).waitFor();
    run.stopped.clear();
  });

  await check(
    'a plot over time says where it has no readings, and keeps those that it had',
    async () => {
      const fresh = await (
        await browser.newContext({viewport: {width: 1400, height: 900}})
      ).newPage();
      await fresh.goto(server.origin);
      const plot = (name) => fresh.locator('rave-sensors').getByRole('img', {name}).waitFor();
      await plot(/^nearest of laser in the last 15 seconds; no readings \d+ to \d s ago$/);
      await until(fresh, `${app}.model.readings.course(0, 0).length > 5`);
      // Nothing looks at the sensor while the panel is hidden and the world shows no scans.
      await fresh.evaluate(
        `${app}.context.kept.write('world', {scans: 'off', hits: false}); ${app}.context.kept.changed.emit(); ${app}.context.show('map')`,
      );
      await until(fresh, `${app}.link.lastLook.includes('"readings":[]')`);
      const before = await fresh.evaluate(`${app}.model.readings.course(0, 0).length`);
      await until(
        fresh,
        `${app}.model.poses.newest.time_s - ${app}.model.readings.course(0, 0).at(-1).time_s > 2`,
      );
      await fresh.evaluate(`${app}.context.show('sensors')`);
      await until(fresh, `${app}.model.readings.course(0, 0).length > ${before}`);
      await plot(/; no readings \d+ to \d+ s ago, \d+ to \d s ago$/);
      await fresh.screenshot({path: join(folder, 'gaps.png')});
      await fresh.close();
    },
  );

  await check('a stop of somebody else says who and when, and is one row of the log', async () => {
    for (let slot = 0; slot < 16; ++slot) run.stopped.add(slot);
    await page.evaluate(() => {
      const {model} = document.querySelector('rave-app');
      const events = model.robots.map(({name}, slot) => ({
        t: 83,
        until: 83,
        count: 1,
        kind: 'stopped',
        level: 'warn',
        text: `${name}: stopped, by hand: Ben K`,
        slots: [slot],
      }));
      model.takeMessage({type: 'events', first: model.events.length, events});
    });
    await page.getByText('16 robots, stopped by Ben K at 01:23').waitFor();
    const row = page.locator('rave-log .row', {hasText: 'stopped, by hand: Ben K'});
    assert.equal(await row.count(), 1);
    assert.match(
      (await row.innerText()).replace(/\s+/g, ' '),
      /real-1 … walker-11: stopped, by hand: Ben K ×16/,
    );
    await page.screenshot({path: join(folder, 'stopped-by-another.png')});
    run.stopped.clear();
    await page.evaluate(() => {
      const {model} = document.querySelector('rave-app');
      model.takeMessage({type: 'events', first: 0, reset: true, events: []});
    });
    await page.getByText('STOP', {exact: true}).waitFor();
  });

  await check('the top bar says how old the picture is', async () => {
    await page.evaluate(() => {
      const {link} = document.querySelector('rave-app');
      const buffer = new ArrayBuffer(48);
      const view = new DataView(buffer);
      view.setUint8(0, 1);
      const wall_ms = performance.timeOrigin + performance.now();
      view.setUint32(44, Math.floor((wall_ms - 420) * 1000) % 2 ** 32, true);
      link.age.take(buffer, wall_ms);
      link.age.take = () => {};
      link.changed.emit();
    });
    await page.locator('rave-top-bar .rate.slow .age', {hasText: '420 ms'}).waitFor();
  });

  await check(
    'a live run has a link to the moment; on narrow pages pace and link are in a menu',
    async () => {
      await page.getByRole('button', {name: 'Link', exact: true}).click();
      await until(page, `/#t=[0-9.]+/.test(location.hash)`);
      for (const [width, height] of [
        [820, 900],
        [390, 844],
      ]) {
        const narrow = await (await browser.newContext({viewport: {width, height}})).newPage();
        await narrow.goto(server.origin);
        await until(narrow, `${app}?.model?.poses?.newest !== null`);
        assert.equal(await narrow.getByRole('radio', {name: '4×'}).count(), 0);
        await narrow.getByRole('button', {name: 'Pace and link'}).click();
        await narrow.getByRole('radio', {name: '4×'}).waitFor();
        await narrow.getByRole('button', {name: 'Link', exact: true}).waitFor();
        assert.ok(
          await narrow.locator('rave-run-bar .card').evaluate((card) => {
            const box = card.getBoundingClientRect();
            return box.left >= 0 && box.right <= innerWidth && box.top >= 0;
          }),
        );
        await narrow.screenshot({path: join(folder, `menu-${width}.png`)});
        await narrow.keyboard.press('Escape');
        await narrow.getByRole('radio', {name: '4×'}).waitFor({state: 'detached'});
        await narrow.close();
      }
    },
  );

  await check(
    'beside the tools of a commander the legend keeps its words, and so do the tools',
    async () => {
      for (const width of [1600, 1280, 900]) {
        const wide = await (await browser.newContext({viewport: {width, height: 900}})).newPage();
        await wide.goto(server.origin);
        await until(wide, `${app}?.model?.poses?.newest !== null`);
        const legend = wide.locator('rave-world .legend');
        for (const word of ['real', 'simulated', 'virtual', 'tube', 'wall'])
          await legend.getByText(word, {exact: true}).waitFor();
        assert.ok(
          await legend.evaluate(
            (all) =>
              all.scrollWidth <= all.clientWidth &&
              all.getBoundingClientRect().right <=
                all.getRootNode().host.getBoundingClientRect().right,
          ),
        );
        if (width === 1600) await wide.locator('rave-world .tool').getByText('Obstacle').waitFor();
        await wide.close();
      }
    },
  );

  await check(
    'the closed sheet of a phone has a plot of the selected robot, its nearest value and its speed',
    async () => {
      const phone = await (
        await browser.newContext({
          viewport: {width: 390, height: 844},
          hasTouch: true,
          isMobile: true,
        })
      ).newPage();
      await phone.goto(server.origin);
      await until(phone, `${app}?.model?.poses?.newest !== null`);
      await phone.evaluate(`${app}.selection.set([2])`);
      const glance = phone.locator('rave-glance');
      await glance.getByText('1.00 m').waitFor();
      await glance.getByText('0.20 m/s').waitFor();
      const looks = `[...${app}.link.interests].filter(([owner]) => owner.localName === 'rave-glance').map(([, sensors]) => sensors.join()).join(' ')`;
      assert.equal(await phone.evaluate(looks), '2,0');
      const painted = await glance.locator('canvas').evaluate((canvas) => {
        const {data} = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
        return data.filter((value, i) => i % 4 === 3 && value > 0).length / (data.length / 4);
      });
      assert.ok(painted > 0.2, `${painted}`);
      await phone.screenshot({path: join(folder, 'phone.png')});
      await phone.locator('rave-sheet .more').tap();
      await phone.locator('rave-sheet rave-sensors').waitFor();
      assert.equal(await phone.evaluate(looks), '');
      await phone.close();
    },
  );

  await check('pause, step and pace reach the server', async () => {
    await page.keyboard.press('k');
    await page.getByText('Paused', {exact: true}).waitFor();
    await page.keyboard.press('.');
    await untilHere(page, () => heard('transport', 'step').length === 1, 'step');
    await page.getByRole('radio', {name: 'Max'}).click();
    await untilHere(
      page,
      () => heard('transport', 'pace').some((message) => message.value === 0),
      'pace',
    );
    run.pace = 1;
    await page.keyboard.press('k');
    await page.getByText('Live', {exact: true}).waitFor();
  });

  await check('a run that waits says for whom', async () => {
    Object.assign(run, {
      state: 'waiting',
      reason: 'Waiting for host-3: no answer for 2.9 s (limit 10 s).',
    });
    server.say(run.time());
    await page.getByText('Waiting for host-3').waitFor();
    Object.assign(run, {state: 'running', reason: ''});
    server.say(run.time());
  });

  await checkScene({page, server});

  await check('T shows the world in perspective, and a click picks there, too', async () => {
    await page.keyboard.press('Escape');
    await page.keyboard.press('t');
    await until(page, `document.querySelector('rave-world').viewpoint().startsWith('3d')`);
    await page.keyboard.press('k');
    await page.waitForTimeout(500);
    await page.evaluate(`document.querySelector('rave-world').lookFrom('3d,0,0,9,-1.6,1.3')`);
    await page.waitForTimeout(1000);
    const at = await page.evaluate(() => {
      const world = document.querySelector('rave-world');
      const box = world.renderRoot.querySelector('.canvas').getBoundingClientRect();
      const [x, y] = world.screenOf(2);
      return [box.left + x, box.top + y];
    });
    await page.mouse.click(...at);
    await until(page, `${app}.selection.primary === 2`);
    await page.keyboard.press('k');
    await page.keyboard.press('t');
    await until(page, `document.querySelector('rave-world').viewpoint().startsWith('top')`);
  });

  await check('the end of the run turns into its replay; selection and camera stay', async () => {
    await page.evaluate(`${app}.selection.set([3])`);
    await page.mouse.move(700, 400);
    await page.mouse.wheel(0, -300);
    const scale = await page.evaluate(`document.querySelector('rave-world').viewpoint()`);
    const robots = [...run.robots].reverse();
    server.turnInto({
      source: 'replay',
      robots,
      may: ['play', 'seek', 'pace', 'step', 'readings', 'log', 'recording', 'obstacles'],
    });
    await page.getByText('Replay', {exact: true}).waitFor();
    await page.getByText('this is a recording').waitFor();
    assert.equal(await page.locator('rave-timeline .knob').count(), 1);
    assert.equal(await page.evaluate(`${app}.selection.primary`), 12);
    assert.equal(await page.evaluate(`document.querySelector('rave-world').viewpoint()`), scale);
    await page.keyboard.press('Control+k');
    await page.keyboard.type('3.5');
    await page.keyboard.press('Enter');
    await untilHere(
      page,
      () => heard('transport', 'seek').some((message) => message.value === 3.5),
      'seek',
    );
  });

  await check('a server that comes back is reached without a reload', async () => {
    const mark = await page.evaluate('window.mark = 7');
    await server.end();
    await page
      .getByText(/Link lost/)
      .first()
      .waitFor();
    const again = new FakeRun(16, {now_s: 50, may: ['readings', 'log'], role: 'observer'});
    server = await serveFake(built, again, port);
    await page.getByText('Live', {exact: true}).waitFor();
    assert.equal(await page.evaluate('window.mark'), mark);
    await page.getByText('observers cannot stop').waitFor();
    assert.equal(await page.locator('rave-stop button').count(), 0);
    await page.getByText('virtual obstacles').waitFor();
  });

  await check('a server without a run says so, and the next run is shown by itself', async () => {
    await server.end();
    await page
      .getByText(/Link lost/)
      .first()
      .waitFor();
    server = await serveFake(built, null, port);
    await page.getByText('No run in progress').waitFor();
    server.run = new FakeRun(8, {name: 'next'});
    await page.getByText('next', {exact: true}).waitFor();
    await until(page, `${app}.model.robots.length === 8`);
    await page.keyboard.press('2');
    await page.locator('rave-robots .row').first().waitFor();
  });

  await checkOpening({browser, built});
  await checkPeople({page, server, heard, folder});

  await check('every message is as the schema describes it', async () => {
    const file = join(folder, 'messages.json');
    writeFileSync(file, JSON.stringify(said));
    execFileSync('python3', [new URL('check_messages.py', import.meta.url).pathname, file], {
      stdio: 'inherit',
    });
  });

  await check('nothing was asked of another origin, and nothing was complained of', async () => {
    assert.deepEqual(seen.foreign, []);
    assert.deepEqual(
      seen.errors.filter((text) => !/WebSocket|ERR_CONNECTION_REFUSED/.test(text)),
      [],
    );
  });
} finally {
  await browser.close();
}
report();
process.exit(0);
