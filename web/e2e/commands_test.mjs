// SPDX-License-Identifier: Apache-2.0
// A commander and real runs: node commands_test.mjs RAVE SCENARIO FOLDER
// The same page commands a run of one process, and one of three in lock-step.
import assert from 'node:assert/strict';
import {execFileSync, spawnSync} from 'node:child_process';
import {mkdirSync, rmSync} from 'node:fs';
import {join} from 'node:path';
import {launch, startServer} from './browser.mjs';
import {app, check, report, showFailures, until, untilHere} from './checks.mjs';
import {
  choose,
  driveByHand,
  driveByKeys,
  driveByMouse,
  happened,
  newest,
  sendByClick,
  slotOf,
} from './commander.mjs';
import {clickAt, dragThrough, touch} from './hands.mjs';

const [rave, scenario, folder] = process.argv.slice(2);
rmSync(folder, {recursive: true, force: true});
mkdirSync(folder, {recursive: true});

const browser = await launch();
const servers = [];
try {
  for (const [what, more] of [
    ['one process', []],
    ['three processes', ['--processes', '3']],
  ]) {
    const context = await browser.newContext({viewport: {width: 1500, height: 950}});
    const page = await context.newPage();
    const output = join(folder, what.replace(' ', '-'));
    const server = await startServer(rave, [
      'run',
      scenario,
      '--gui',
      '--quiet',
      '--no-picture',
      '--pace',
      'realtime',
      '--duration',
      '100000',
      '--output',
      output,
      ...more,
    ]);
    servers.push(server);
    showFailures(page, join(folder, `failure-${what.replace(' ', '-')}.png`));

    await check(`${what}: the page may command`, async () => {
      await page.goto(server.link);
      await touch(page);
      await until(page, `${app}?.model?.robots?.length === 3 && ${newest} !== null`);
      await until(page, `${app}.model.may('command')`);
    });

    await check(
      `${what}: a goal by click arrives, for a program that takes goals and for a controller alone`,
      async () => {
        await sendByClick(page, 'carl', 3.5, -2.5);
        await sendByClick(page, 'bert', -2.5, -2.5);
      },
    );

    await check(`${what}: a goal inside a wall is refused beside the goal`, async () => {
      await choose(page, await slotOf(page, 'bert'));
      await page.keyboard.press('g');
      await clickAt(page, 1, 1);
      const card = page.locator('rave-world .beside.refused');
      await card.waitFor();
      assert.match(await card.innerText(), /inside the obstacle `post`/);
      await card.getByRole('button', {name: 'Drop'}).click();
      await page.keyboard.press('Escape');
    });

    await check(`${what}: the mouse drives a robot, and letting go stops it`, () =>
      driveByMouse(page, 'bert'),
    );

    await check(`${what}: keys drive it backwards, and letting go stops it`, () =>
      driveByKeys(page, 'bert', 's'),
    );
    for (const hand of ['touch', 'pen']) {
      await check(
        `${what}: a ${hand === 'touch' ? 'finger' : 'pen'} drives it, and lifting it stops it`,
        () => driveByHand(page, 'bert', hand),
      );
    }

    await check(
      `${what}: whoever drives holds the lease, which another commander is told of`,
      async () => {
        // After driving it ends within 3 s, which is less than a busy machine needs to open a page.
        const bert = await slotOf(page, 'bert');
        const lease = (what) =>
          page.evaluate(
            ([doing, slot]) => document.querySelector('rave-app').commands.lease(doing, [slot]),
            [what, bert],
          );
        assert.equal((await lease('take')).good, true);
        const other = await context.newPage();
        await other.goto(new URL(server.link).origin);
        await until(other, `${app}?.model?.drives?.get(${bert})?.lease?.length > 0`);
        assert.equal((await lease('give')).good, true);
        await other.close();
      },
    );

    await check(`${what}: a robot is told something, and answers`, async () => {
      await page.evaluate(
        (slot) =>
          document
            .querySelector('rave-app')
            .link.send({type: 'say', request: 900, to: 'robot', slot, text: 'hello'}),
        await slotOf(page, 'carl'),
      );
      await until(page, happened('said', 'not texts'));
    });

    if (more.length === 0) {
      await check(`${what}: an obstacle is drawn, and stands in the run`, async () => {
        await page
          .getByRole('radio', {name: 'Watch'})
          .click()
          .catch(() => {});
        await page.keyboard.press('o');
        await dragThrough(page, [
          [-1.4, 1.0],
          [-0.9, 1.4],
        ]);
        await until(page, happened('obstacle added', ''));
        const list = execFileSync(rave, ['edit', String(server.child.pid), 'list'], {
          encoding: 'utf8',
        });
        assert.match(list, /-1\.1/);
        await page.keyboard.press('v');
      });
    }

    await check(`${what}: the robots stop, and are released`, async () => {
      await page.evaluate(() =>
        document.querySelector('rave-app').link.send({type: 'halt', do: 'stop', slots: []}),
      );
      await until(page, `[...${newest}.flags].filter((flags) => flags & 4).length === 3`);
      await page.evaluate(() =>
        document.querySelector('rave-app').link.send({type: 'halt', do: 'release', slots: []}),
      );
      await until(page, `[...${newest}.flags].filter((flags) => flags & 4).length === 0`);
    });

    await check(`${what}: rave verify does the orders again`, async () => {
      server.child.kill('SIGINT');
      await untilHere(
        page,
        () =>
          server.child.exitCode !== null ||
          spawnSync('test', ['-s', join(output, 'result.json')]).status === 0,
        'the run ends',
      );
      server.child.kill('SIGINT');
      await server.end();
      const records =
        more.length === 0
          ? [output]
          : ['host-1', 'host-2', 'host-3'].map((host) => join(output, 'hosts', host));
      for (const record of records) {
        const {status, stdout, stderr} = spawnSync(rave, ['verify', record], {encoding: 'utf8'});
        assert.equal(status, 0, stdout + stderr);
        assert.match(stdout, /^equal: /m);
      }
    });
    await context.close();
  }
} finally {
  await browser.close();
  for (const server of servers) server.child.kill('SIGKILL');
}
report();
process.exit(0);
