// SPDX-License-Identifier: Apache-2.0
// World View and Sensor Display at work: node world_test.mjs RAVE SCENARIO CROWD FOLDER
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {mkdirSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';
import {launch, startServer} from './browser.mjs';
import {app, check, report, showFailures, until, watch} from './checks.mjs';
import {boxIn3d} from './world/box_in_3d.mjs';
import {crowdChecks, varianceCheck} from './world/crowd_checks.mjs';
import {hold, layer, openLayers, settled, switches} from './world/layer_hands.mjs';
import {
  differ,
  inside,
  keep,
  noteTexts,
  robotAt,
  stageBox,
  texts,
  withFlags,
} from './world/look.mjs';

const [rave, scenario, crowd, folder] = process.argv.slice(2);
rmSync(folder, {recursive: true, force: true});
mkdirSync(folder, {recursive: true});
const world = "document.querySelector('rave-world')";
const browser = await launch();
const said = [];
/** Flags of frames of poses. */
const [kStale, kUnarmed] = [2, 8];

/** A page that looks at a run of its own. */
async function open(file, name) {
  const gui = await startServer(rave, [
    'run',
    file,
    '--gui',
    '--quiet',
    '--no-picture',
    '--no-record',
    '--output',
    join(folder, name),
  ]);
  const page = await (await browser.newContext({viewport: {width: 1400, height: 900}})).newPage();
  showFailures(page, join(folder, 'failed.png'));
  const seen = watch(page, new URL(gui.link).origin);
  page.on('websocket', (socket) =>
    socket.on(
      'framesent',
      ({payload}) => typeof payload === 'string' && said.push(JSON.parse(payload)),
    ),
  );
  await noteTexts(page);
  await page.goto(gui.link);
  await until(page, `${app}?.model?.poses?.newest?.time_s > 1.5`);
  return {
    gui,
    page,
    ...seen,
    slot: (robot) =>
      page.evaluate(
        (robot) =>
          document.querySelector('rave-app').model.robots.findIndex(({name}) => name === robot),
        robot,
      ),
  };
}

const mixed = await open(scenario, 'mixed');
const servers = [mixed.gui];
try {
  const {page, slot} = mixed;
  const [real, simulated] = [await slot('real-3'), await slot('walker-1')];
  await until(page, `${app}.model.poses.newest.time_s > 3`);

  await check('Ctrl K leads to a robot: it is selected, and followed', async () => {
    await page.keyboard.press('Control+k');
    await page.keyboard.type('real-3');
    await page.keyboard.press('Enter');
    await until(page, `${app}.selection.primary === ${real} && ${app}.selection.following`);
    const begin = await page.evaluate(`${app}.model.poses.newest.time_s`);
    await until(page, `${app}.model.poses.newest.time_s > ${begin} + 0.5`);
    const {left, top, width, height} = await stageBox(page);
    const [x, y] = await robotAt(page, real);
    assert.ok(Math.hypot(x - left - width / 2, y - top - height / 2) < 2, `${x}, ${y}`);
    await page.keyboard.press('Escape');
    await until(page, `!${app}.selection.following && ${app}.selection.primary === ${real}`);
    await page.keyboard.press('f');
  });

  await check(
    'the Sensor Display has a camera beside its twin, and its course in three fields',
    async () => {
      const panel = page.locator('rave-sensors');
      await panel.getByRole('radio', {name: 'camera', exact: true}).click();
      await panel.getByText(/camera_twin expects [1-9]/).waitFor();
      for (const field of ['bearing', 'count', 'nearest range']) {
        await panel.getByRole('radio', {name: field, exact: true}).click();
        await panel.getByRole('img', {name: new RegExp(`^${field} of camera`)}).waitFor();
      }
      // Both lines are there: of the camera, and of its twin.
      await until(
        page,
        `(() => { const {plot} = document.querySelector('rave-sensors').course; return plot?.data.length === 3 && [1, 2].every((i) => plot.data[i].some((value) => value > 0)); })()`,
      );
      await page.screenshot({path: join(folder, 'camera.png')});
    },
  );

  await check(
    'ranges have a table with the age of the reading, and the course of a chosen beam',
    async () => {
      const panel = page.locator('rave-sensors');
      await panel.getByRole('radio', {name: 'laser', exact: true}).click();
      await panel.getByText(/121 rays · 240° · 10 Hz · age \d+ ms/).waitFor();
      await panel.getByRole('button', {name: 'Show the numbers'}).click();
      assert.equal(await panel.locator('tbody tr').count(), 121);
      assert.match(
        await panel.locator('tbody tr').first().innerText(),
        /^−?120\.0\s+(\d+\.\d+|\d+|no return)$/,
      );
      await panel.getByRole('button', {name: 'Show the numbers'}).click();
      await panel.getByRole('radio', {name: 'beam', exact: true}).click();
      const beam = panel.getByRole('slider', {name: 'Beam'});
      await beam.focus();
      await page.keyboard.press('Home');
      await panel.getByText('120° right').waitFor();
      await panel.getByRole('radio', {name: 'nearest', exact: true}).click();
      await until(
        page,
        `(() => { const {plot} = document.querySelector('rave-sensors').course; return plot?.data[1]?.at(-1) > 0 && plot.data[0].at(0) < -1; })()`,
      );
      const line = await panel.locator('.course .u-over').boundingBox();
      await page.mouse.move(line.x + line.width - 4, line.y + 10);
      await panel.getByText(/\d m, \d\.\d s ago/).waitFor();
    },
  );

  await hold(page);

  await check('real is filled, simulated is hollow', async () => {
    await openLayers(page);
    await page.getByRole('combobox', {name: 'Scans'}).selectOption('off');
    for (const [robot, token] of [
      [real, 'fill'],
      [simulated, 'sim-fill'],
    ]) {
      const {is, wanted} = await inside(page, robot, token);
      assert.deepEqual(is, wanted, `robot ${robot}`);
    }
    await page.getByRole('combobox', {name: 'Scans'}).selectOption('real');
    await settled(page);
  });

  await check('each layer is drawn, from above and in perspective', async () => {
    for (const [name, least] of [
      ['Trails', 150],
      ['Camera sightings', 80],
      ['Where readings hit', 40],
      ['Names', 400],
      ['Grid', 300],
    ])
      await switches(page, name, least);
    await keep(page);
    await page.getByRole('combobox', {name: 'Scans'}).selectOption('off');
    assert.ok((await differ(page)) > 5000, 'scans');
    await page.getByRole('combobox', {name: 'Scans'}).selectOption('real');
    await page.screenshot({path: join(folder, 'top.png')});
    await page.getByRole('radio', {name: '3-D'}).click();
    // What stands is drawn finely, also without a graphics card.
    await until(page, `${world}.viewpoint().startsWith('3d') && ${world}.stage.ratio >= 1`);
    await settled(page);
    for (const [name, least] of [
      ['Trails', 60],
      ['Camera sightings', 60],
      ['Where readings hit', 30],
      ['Names', 300],
      ['Grid', 300],
    ])
      await switches(page, name, least);
  });

  await check(
    'a stale robot is a ghost with its age, and one that waits says so, in both views',
    async () => {
      for (const mode of ['3d', 'top']) {
        await page.evaluate(`${world}.setMode('${mode}')`);
        await settled(page);
        const plain = await withFlags(page, []);
        assert.ok(!plain.texts.some((text) => /(^|  )(arm|0\.0 s)$/.test(text)));
        const {texts: shown, pixels} = await withFlags(page, [
          [real, kUnarmed],
          [simulated, kStale],
        ]);
        assert.ok(
          shown.some((text) => /(^|  )arm$/.test(text)) &&
            shown.some((text) => /(^|  )0\.0 s$/.test(text)),
          `${mode}: ${shown}`,
        );
        assert.ok(pixels > plain.pixels + 100, `${mode}: ${pixels}`);
      }
    },
  );

  await check('the shadow of a real robot has its gap in both views, and a switch', async () => {
    await page.evaluate((real) => {
      const {drives} = document.querySelector('rave-app').model;
      drives.set(real, {...drives.get(real), shadow: {running: true, offset: [0.3, 0.1, 0.5]}});
    }, real);
    for (const mode of ['3d', 'top']) {
      await page.evaluate(`${world}.setMode('${mode}')`);
      await settled(page);
      assert.ok((await texts(page)).includes('31.6 cm'), mode);
      await switches(page, 'Shadows of real robots', 60);
      await page.screenshot({path: join(folder, `shadow-${mode}.png`)});
    }
    await page.evaluate(
      (real) => (document.querySelector('rave-app').model.drives.get(real).shadow = undefined),
      real,
    );
  });

  await check('who is pointed at has a name, also where names are off', async () => {
    await layer(page, 'Names').click();
    assert.ok(!(await texts(page)).includes('walker-1'));
    await page.mouse.move(...(await robotAt(page, simulated)));
    await until(page, `${app}.selection.hovered === ${simulated}`);
    const shown = await texts(page);
    assert.ok(shown.includes('walker-1') && !shown.includes('real-3'), `${shown}`);
    await layer(page, 'Names').click();
    await page.getByRole('button', {name: 'Layers'}).click();
  });

  await check('the legend hides a kind; with Alt it is alone', async () => {
    const legend = page.locator('rave-world .legend');
    await settled(page);
    const hidden = () => page.evaluate(`${world}.layers.hidden.join()`);
    const [x, y] = await robotAt(page, simulated);
    const {left, top} = await stageBox(page);
    const box = [x - left - 10, y - top - 10, x - left + 10, y - top + 10];
    await keep(page);
    await legend.getByRole('button', {name: '11 simulated'}).click();
    assert.equal(await hidden(), 'simulated');
    assert.ok((await differ(page, box)) > 20);
    await legend.getByRole('button', {name: '11 simulated'}).click();
    await legend.getByRole('button', {name: '5 real'}).click({modifiers: ['Alt']});
    assert.equal(await hidden(), 'simulated,virtual,landmark,wall');
    const shown = await texts(page);
    assert.ok(
      shown.includes('real-3') && !shown.some((text) => /walker|hunter|wedge/.test(text)),
      `${shown}`,
    );
    await legend.getByRole('button', {name: '5 real'}).click({modifiers: ['Alt']});
    assert.equal(await hidden(), '');
    await settled(page);
  });

  await check('Z held is a lens on what lies below the pointer', async () => {
    const {left, top, width, height} = await stageBox(page);
    const corner = [width - 360, height - 290, width - 20, height - 60];
    await page.mouse.move(left + 200, top + 200);
    await keep(page);
    await page.keyboard.down('z');
    await until(page, `${world}.top.lens.on`);
    assert.ok((await differ(page, corner)) > 4000);
    assert.ok((await texts(page)).includes('Lens 3.5×  hold Z'));
    await page.screenshot({path: join(folder, 'lens.png')});
    await page.keyboard.up('z');
    await until(page, `!${world}.top.lens.on`);
    assert.equal(await differ(page), 0);
  });

  await check('M measures between two places', async () => {
    await page.keyboard.press('m');
    const {left, top} = await stageBox(page);
    const ends = await page.evaluate(
      `[${world}.stage.screenAt(1, 1), ${world}.stage.screenAt(2, 1)]`,
    );
    await page.mouse.move(left + ends[0][0], top + ends[0][1]);
    await page.mouse.down();
    await page.mouse.move(left + ends[1][0], top + ends[1][1], {steps: 4});
    await page.mouse.up();
    assert.match(
      (await texts(page)).find((text) => / m, /.test(text)),
      /^(1\.0[01]|0\.99) m, −?0°$/,
    );
    await page.keyboard.press('Escape');
    await until(page, `!${world}.top.measure.on`);
  });

  await check('Shift and a drag select all in a box', async () => {
    const {left, top, width, height} = await stageBox(page);
    await page.keyboard.down('Shift');
    await page.mouse.move(left + 4, top + 4);
    await page.mouse.down();
    await page.mouse.move(left + width - 4, top + height - 4, {steps: 4});
    await page.mouse.up();
    await page.keyboard.up('Shift');
    assert.equal(await page.evaluate(`${app}.selection.slots.length`), 16);
    await page.evaluate(`${app}.selection.set([${real}])`);
  });

  await boxIn3d(page, real, folder);

  await check('the picture moves, zooms, turns and measures at the keyboard alone', async () => {
    const look = async () =>
      (await page.evaluate(`${world}.viewpoint()`)).split(',').slice(1).map(Number);
    await page.getByRole('button', {name: 'Save a picture'}).focus();
    await page.keyboard.press('Tab');
    const ring = await page.evaluate(
      `(() => { const canvas = ${world}.renderRoot.querySelector('.canvas'); return [canvas.matches(':focus-visible'), getComputedStyle(canvas, '::after').borderTopWidth]; })()`,
    );
    assert.deepEqual(ring, [true, '2px']);
    const [x, y, scale] = await look();
    await page.keyboard.press('ArrowRight');
    await page.keyboard.press('ArrowUp');
    const moved = await look();
    assert.ok(
      Math.abs(moved[0] - x - 48 / scale) < 0.01 && Math.abs(moved[1] - y - 48 / scale) < 0.01,
      `${moved}`,
    );
    await page.keyboard.press('+');
    assert.ok(Math.abs((await look())[2] / scale - 1.25) < 0.01);
    await page.keyboard.press('-');
    await page.keyboard.press('m');
    for (let i = 0; i < 4; ++i) await page.keyboard.press('ArrowLeft');
    await page
      .locator('rave-world [role=status]', {hasText: `${(192 / scale).toFixed(2)} m, 180°`})
      .waitFor({state: 'attached'});
    assert.deepEqual(await look(), moved);
    await page.screenshot({path: join(folder, 'keyboard.png')});
    await page.keyboard.press('Escape');
    await page.keyboard.press('t');
    await until(page, `${world}.viewpoint().startsWith('3d')`);
    const before = await look();
    await page.keyboard.press('Control+ArrowLeft');
    await page.keyboard.press('ArrowDown');
    const after = await look();
    assert.ok(
      Math.abs(after[3] - before[3]) > 0.1 &&
        Math.hypot(after[0] - before[0], after[1] - before[1]) > 0.1,
      `${after}`,
    );
    await page.keyboard.press('t');
  });

  await check('P saves what is shown as a picture', async () => {
    const [download] = await Promise.all([page.waitForEvent('download'), page.keyboard.press('p')]);
    assert.match(download.suggestedFilename(), /^mixed-reality-\d+\.\d\ds\.png$/);
    const png = readFileSync(await download.path());
    assert.equal(png.subarray(1, 4).toString(), 'PNG');
    const {width, height} = await stageBox(page);
    assert.deepEqual(
      [png.readUInt32BE(16), png.readUInt32BE(20)],
      [Math.round(width), Math.round(height)],
    );
    assert.ok(png.length > 30000, `${png.length} bytes`);
  });

  await check(
    'in all of that nothing was complained of, and no other origin was asked',
    async () => {
      assert.deepEqual(mixed.errors, []);
      assert.deepEqual(mixed.foreign, []);
    },
  );
  await page.close();
  mixed.gui.child.kill('SIGKILL');

  const many = await open(crowd, 'crowd');
  servers.push(many.gui);
  await crowdChecks({...many, folder});
  await varianceCheck({...many, folder});

  await check('every message is as the schema describes it', async () => {
    assert.ok(said.some((message) => message.type === 'look' && message.variances.length > 0));
    const file = join(folder, 'messages.json');
    writeFileSync(file, JSON.stringify(said));
    execFileSync('python3', [new URL('check_messages.py', import.meta.url).pathname, file], {
      stdio: 'inherit',
    });
  });
} finally {
  await browser.close();
  for (const gui of servers) gui.child.kill('SIGKILL');
}
report();
process.exit(0);
