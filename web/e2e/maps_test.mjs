// SPDX-License-Identifier: Apache-2.0
// Maps of two robots and of the world, in one process and over two hosts: node maps_test.mjs RAVE
// SCENARIO FOLDER
import assert from 'node:assert/strict';
import {execFileSync, spawnSync} from 'node:child_process';
import {mkdirSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';
import {launch, startServer} from './browser.mjs';
import {app, check, report, showFailures, until} from './checks.mjs';

const [rave, scenario, folder] = process.argv.slice(2);
const newest = `${app}.model.poses.newest`;
const maps = `${app}.model.maps`;
const kTile = 4;
const tag = ['--run', `maps-${process.pid}`];

/** Occupied cells of a map as places of the world, in centimetres. */
const occupied = (page, key) =>
  page.evaluate((of) => {
    const grid = document.querySelector('rave-app').model.maps.of(of);
    const places = [];
    for (const tile of grid?.tiles.values() ?? []) {
      tile.cells.forEach((cell, i) => {
        if (cell < 80 || cell > 100) return;
        const {x0, y0, resolution_m} = grid.frame;
        places.push([
          x0 + (tile.column * 64 + (i % tile.width) + 0.5) * resolution_m,
          y0 + (tile.row * 64 + Math.floor(i / tile.width) + 0.5) * resolution_m,
        ]);
      });
    }
    return places;
  }, key);

/** Share of places that lie within 15 cm of one of the others. */
function shareNear(places, others) {
  const taken = new Set();
  for (const [x, y] of others)
    for (let i = -3; i <= 3; ++i)
      for (let j = -3; j <= 3; ++j)
        taken.add(`${Math.floor(20 * x) + i} ${Math.floor(20 * y) + j}`);
  return (
    places.filter(([x, y]) => taken.has(`${Math.floor(20 * x)} ${Math.floor(20 * y)}`)).length /
    places.length
  );
}

/** What is drawn: pixels of the colour of walls, and a number for the whole picture. */
const drawn = (page) =>
  page.locator('rave-map canvas').evaluate((canvas) => {
    const {data} = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
    let walls = 0;
    let sum = 0;
    for (let i = 0; i < data.length; i += 4) {
      if (
        Math.abs(data[i] - 0x8c) + Math.abs(data[i + 1] - 0x7a) + Math.abs(data[i + 2] - 0x66) <
        24
      )
        ++walls;
      sum = (31 * sum + data[i] + 7 * data[i + 1] + 13 * data[i + 2]) % 1000003;
    }
    return {walls, sum};
  });

/** A number for the floor of the World View: what stands still, robots left out. */
const floor = (page) =>
  page
    .locator('rave-world .stage-top canvas')
    .first()
    .evaluate((canvas) => {
      const {data} = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
      let sum = 0;
      for (let i = 0; i < data.length; ++i) sum = (31 * sum + data[i]) % 1000003;
      return sum;
    });

async function openPanel(page) {
  await page.keyboard.press('Control+k');
  await page.getByLabel('Find', {exact: true}).fill('Map');
  await page.getByText('Map', {exact: true}).last().click();
  await page.locator('rave-map select').waitFor();
}

const choose = (page, label) => page.locator('rave-map select').selectOption({label});

/** The drop-down switches between two robots and the world, and the picture with it. */
async function switches(page) {
  const options = await page.locator('rave-map select option').allTextContents();
  assert.deepEqual(
    options.map((text) => text.trim()),
    ['local: anna', 'local: ben', 'global: world file'],
  );
  await choose(page, 'global: world file');
  await until(page, `${maps}.of('world file')?.tiles.size > 1`);
  const world = await occupied(page, 'world file');
  await until(
    page,
    `document.querySelector('rave-map').shadowRoot.querySelector('.waits') === null`,
  );
  const pictures = {world: await drawn(page)};
  assert.ok(pictures.world.walls > 500, `${pictures.world.walls} pixels of walls`);
  const places = {};
  for (const [slot, name] of [
    [0, 'anna'],
    [1, 'ben'],
  ]) {
    await choose(page, `local: ${name}`);
    await until(page, `${maps}.of(${slot})?.tiles.size > 0`);
    await page.waitForTimeout(1500);
    places[name] = await occupied(page, slot);
    pictures[name] = await drawn(page);
    assert.ok(
      places[name].length > 20 && pictures[name].walls > 30,
      `${name}: ${places[name].length} cells, ${pictures[name].walls} pixels`,
    );
    assert.ok(
      shareNear(places[name], world) > 0.9,
      `${name}: ${shareNear(places[name], world)} of its cells are walls`,
    );
    assert.match(
      await page.locator('rave-map .about').textContent(),
      /^0\.05 m cells · [0-9.]+ s old$/,
    );
  }
  assert.equal(new Set(Object.values(pictures).map(({sum}) => sum)).size, 3);
  // Each has mapped its own room.
  assert.ok(places.anna.every(([x]) => x < 0.3) && places.ben.every(([x]) => x > -0.3));
}

rmSync(folder, {recursive: true, force: true});
mkdirSync(folder, {recursive: true});
const browser = await launch();
const servers = [];
try {
  const context = await browser.newContext({viewport: {width: 1400, height: 900}});
  const page = await context.newPage();
  const errors = [];
  let tiles = 0;
  page.on('pageerror', (error) => errors.push(String(error)));
  const said = [];
  page.on('websocket', (socket) => {
    // The direct lines of hosts have messages of their own.
    if (new URL(socket.url()).host !== new URL(page.url()).host) return;
    socket.on('framereceived', ({payload}) => {
      if (typeof payload === 'string') said.push(JSON.parse(payload));
      else if (payload[0] === kTile) ++tiles;
    });
    socket.on(
      'framesent',
      ({payload}) => typeof payload === 'string' && said.push(JSON.parse(payload)),
    );
  });
  showFailures(page, join(folder, 'failed.png'));
  const shared = ['--gui', '--quiet', '--no-picture', '--no-record', '--pace', 'realtime'];

  await check('the drop-down switches between two robots and the world', async () => {
    const run = await startServer(rave, [
      'run',
      scenario,
      ...shared,
      '--output',
      join(folder, 'one'),
    ]);
    servers.push(run);
    await page.goto(run.link);
    await until(page, `${newest} != null && ${newest}.time_s > 1`);
    assert.equal(tiles, 0, 'no tile before somebody looks');
    await openPanel(page);
    await switches(page);
    await page.evaluate(`${app}.palette.set('dark')`);
    await page.waitForTimeout(300);
    await page.screenshot({path: join(folder, 'map-dark.png')});
  });

  await check('tiles that change come, and none while nobody looks', async () => {
    const before = tiles;
    await page.waitForTimeout(2500);
    assert.ok(tiles > before, 'the robot goes on, and its map with it');
    await page.evaluate(`${app}.showPanel('sensors')`);
    await page.waitForTimeout(1000);
    const hidden = tiles;
    await page.waitForTimeout(2000);
    assert.equal(tiles, hidden);
    await page.evaluate(`${app}.showPanel('map')`);
    await until(page, `${maps}.of(1)?.tiles.size > 0`);
  });

  await check('it is larger, smaller and moved', async () => {
    const scale = `document.querySelector('rave-map').camera.scale`;
    const fitted = await page.evaluate(scale);
    await page.getByRole('button', {name: 'Larger'}).click();
    assert.ok((await page.evaluate(scale)) > 1.3 * fitted);
    const box = await page.locator('rave-map canvas').boundingBox();
    await page.mouse.move(box.x + 100, box.y + 100);
    await page.mouse.wheel(0, 400);
    await until(page, `${scale} < ${1.3 * fitted}`);
    const x = await page.evaluate(`document.querySelector('rave-map').camera.x`);
    await page.mouse.down();
    await page.mouse.move(box.x + 160, box.y + 100, {steps: 3});
    await page.mouse.up();
    assert.ok((await page.evaluate(`document.querySelector('rave-map').camera.x`)) < x);
    await page.getByRole('button', {name: 'Show all of the map'}).click();
    await until(page, `Math.abs(${scale} / ${fitted} - 1) < 0.5`);
  });

  await check('it lies over the world, as strong as it is set', async () => {
    await choose(page, 'global: world file');
    await until(page, `${maps}.of('world file') !== null`);
    await page.evaluate(`${app}.palette.set('dark')`);
    await page.waitForTimeout(500);
    const bare = await floor(page);
    const over = page.getByRole('switch', {name: 'over the world'});
    await over.check();
    await until(page, `${maps}.overlay?.opacity === 0.6`);
    await page.waitForTimeout(300);
    const with60 = await floor(page);
    assert.notEqual(with60, bare);
    await page.getByLabel('Opacity over the world').fill('20');
    await page.waitForTimeout(300);
    assert.notEqual(await floor(page), with60);
    // It stays while the panel is hidden.
    await choose(page, 'local: anna');
    await page.evaluate(`${app}.showPanel('sensors')`);
    await until(page, `${maps}.of(0)?.tiles.size > 0`);
    await page.evaluate(`${app}.palette.set('light')`);
    await page.evaluate(`${app}.showPanel('map')`);
    await page.waitForTimeout(500);
    await page.screenshot({path: join(folder, 'map-light.png')});
    await over.uncheck();
    await page.evaluate(`${app}.palette.set('dark')`);
    await page.waitForTimeout(500);
    assert.equal(await floor(page), bare);
  });

  await check('it lies over the world in 3-D, where its tiles are', async () => {
    const world = 'document.querySelector("rave-world")';
    const plane = `${world}.perspective.maps.group.children`;
    await page.evaluate(`${world}.setMode('3d')`);
    await until(page, `${world}.perspective != null`);
    await choose(page, 'local: anna');
    await until(page, `${maps}.of(0)?.tiles.size > 0`);
    assert.equal(await page.evaluate(`${plane}.length`), 0);
    await page.getByRole('switch', {name: 'over the world'}).check();
    await until(page, `${plane}.length > 0 && ${plane}.length === ${maps}.of(0).tiles.size`);
    await page.getByLabel('Opacity over the world').fill('100');
    await until(page, `${plane}.every((mesh) => mesh.material.opacity === 1)`);
    assert.ok(
      await page.evaluate(`(() => {
      const {frame, tiles} = ${maps}.of(0);
      const middle = (from, tile, cells) => from + (64 * tile + cells / 2) * frame.resolution_m;
      return [...tiles.values()].every(({column, row, width, height}) => ${plane}.some(({position}) =>
        Math.abs(position.x - middle(frame.x0, column, width)) < 1e-6 && Math.abs(position.y - middle(frame.y0, row, height)) < 1e-6));
    })()`),
      'each tile has its rectangle',
    );
    await page.waitForTimeout(1500);
    await page.screenshot({path: join(folder, 'map-3d-dark.png')});
    await page.evaluate(`${app}.palette.set('light')`);
    await page.waitForTimeout(1500);
    await page.screenshot({path: join(folder, 'map-3d-light.png')});
    await page.evaluate(`${app}.palette.set('dark')`);
    await page.getByRole('switch', {name: 'over the world'}).uncheck();
    await until(page, `${plane}.length === 0`);
    await page.evaluate(`${world}.setMode('top')`);
  });

  await check(
    'the menu of layers lays a map over the world, whatever the panel shows',
    async () => {
      const over = page.getByRole('switch', {name: 'over the world'});
      await page
        .getByRole('button', {name: /^Layers/})
        .first()
        .click();
      await page.getByLabel('Map over the world').selectOption({label: 'ben'});
      await until(page, `${maps}.overlay?.key === 1 && ${maps}.of(1)?.tiles.size > 0`);
      await page.getByLabel('Opacity of the map').fill('80');
      await until(page, `${maps}.overlay.opacity === 0.8`);
      await page.screenshot({path: join(folder, 'map-menu.png')});
      assert.equal(await over.isChecked(), false, 'the panel shows anna');
      await choose(page, 'local: ben');
      await until(
        page,
        `document.querySelector('rave-map').renderRoot.querySelector('.over input').checked`,
      );
      await page.getByLabel('Map over the world').selectOption({label: 'none'});
      await until(page, `${maps}.overlay === null`);
      await page
        .getByRole('button', {name: /^Layers/})
        .first()
        .click();
    },
  );

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
    await hand.evaluate(`${app}.showPanel('map')`);
    await until(hand, `${maps}.of(0)?.tiles.size > 0`);
    const width = await hand.locator('rave-map .head').evaluate((head) => head.scrollWidth);
    assert.ok(width <= 390, `the bar is ${width} px wide`);
    await hand.waitForTimeout(500);
    await hand.screenshot({path: join(folder, 'map-phone.png')});
    await phone.close();
    await servers[0].end();
  });

  await check('the same over two hosts', async () => {
    const run = await startServer(rave, [
      'run',
      scenario,
      ...shared,
      '--processes',
      '2',
      '--output',
      join(folder, 'two'),
      ...tag,
    ]);
    servers.push(run);
    await page.goto(run.link);
    await until(
      page,
      `${newest} != null && ${newest}.time_s > 1 && ${app}.model.hosts.length >= 3`,
      60000,
    );
    await openPanel(page);
    await switches(page);
  });

  await check(
    'a map that is looked at changes nothing of the run; its replay has the map of the world file alone',
    async () => {
      const seconds = ['--quiet', '--no-picture', '--duration', '12'];
      const alone = join(folder, 'alone');
      spawnSync(
        rave,
        ['run', scenario, ...seconds, '--pace', 'max', '--no-record', '--output', alone],
        {stdio: 'ignore'},
      );
      servers.push(
        await startServer(rave, [
          'run',
          scenario,
          '--gui',
          ...seconds,
          '--output',
          join(folder, 'watched'),
        ]),
      );
      await page.goto(servers.at(-1).link);
      await until(page, `${newest} != null`);
      await openPanel(page);
      await choose(page, 'local: ben');
      await until(page, `${maps}.of(1)?.tiles.size > 0`);
      await until(
        page,
        `${app}.model.hello.run.source === 'replay' && ${maps}.names.length > 0`,
        40000,
      );
      assert.equal(
        await page.evaluate(`${app}.model.hello.run.hash`),
        JSON.parse(readFileSync(join(alone, 'result.json'))).hash,
      );
      assert.deepEqual(await page.evaluate(`${maps}.names`), [{name: 'world file'}]);
      await until(page, `${maps}.of('world file')?.tiles.size > 1`);
      assert.deepEqual(errors, []);
    },
  );

  await check('every message is as the schema describes it', async () => {
    const file = join(folder, 'messages.json');
    writeFileSync(file, JSON.stringify(said));
    for (const type of ['maps', 'look_maps'])
      assert.ok(
        said.some((message) => message.type === type),
        type,
      );
    execFileSync('python3', [new URL('check_messages.py', import.meta.url).pathname, file], {
      stdio: 'inherit',
    });
  });
  report();
} finally {
  for (const server of servers) server.child.kill('SIGTERM');
  await browser.close();
}
