// SPDX-License-Identifier: Apache-2.0
// Runs of several processes on the page: node hosts_test.mjs RAVE SCENARIO FOLDER
import assert from 'node:assert/strict';
import {execFileSync, spawn} from 'node:child_process';
import {cpSync, mkdirSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';
import {launch, startServer} from './browser.mjs';
import {app, check, report, until} from './checks.mjs';
import {checkRealTime} from './real_time_check.mjs';
import {watchUntouched} from './untouched.mjs';

const [rave, scenario, folder] = process.argv.slice(2);
const newest = `${app}.model.poses.newest`;
const kStopped = 4;
const stopped = `[...${newest}.flags].filter((flags) => flags & ${kStopped}).length`;
const say = (page, message) =>
  page.evaluate((what) => document.querySelector('rave-app').link.send(what), message);
// Of this test alone, whoever else is on the machine.
const tag = ['--run', `page-${process.pid}`];

rmSync(folder, {recursive: true, force: true});
mkdirSync(folder, {recursive: true});
const browser = await launch();
const servers = [];
const children = [];
try {
  const context = await browser.newContext({viewport: {width: 1400, height: 900}});
  const page = await context.newPage();
  const said = [];
  page.on('websocket', (socket) => {
    // The direct lines of hosts have messages of their own.
    if (new URL(socket.url()).host !== new URL(page.url()).host) return;
    socket.on(
      'framereceived',
      ({payload}) => typeof payload === 'string' && said.push(JSON.parse(payload)),
    );
  });

  await check('three processes in lock-step are one world on the page', async () => {
    const run = await startServer(rave, [
      'run',
      scenario,
      '--gui',
      '--processes',
      '3',
      '--quiet',
      '--no-picture',
      '--duration',
      '30',
      '--output',
      join(folder, 'run'),
      ...tag,
    ]);
    servers.push(run);
    await page.goto(run.link);
    await until(page, `${newest} != null && [...${newest}.flags].every((flags) => flags & 1)`);
    // Rights that were changed are kept by the name of the run.
    assert.equal(await page.evaluate(`${app}.model.hello.run.name`), 'flock');
    const before = await page.evaluate(`${newest}.time_s`);
    await until(page, `${newest}.time_s > ${before} + 1`);
    await until(page, `${app}.model.hosts.filter((host) => host.state === 'here').length === 4`);
  });

  await check('the scan of a robot that is looked at, of each process', async () => {
    for (const slot of [0, 5, 9]) {
      const name = await page.evaluate(`${app}.model.robots[${slot}].name`);
      await page.locator('rave-robots .row', {hasText: name}).first().click();
      await until(
        page,
        `(() => { const a = ${app}; if (a.selection.primary !== ${slot}) return false;
        const laser = a.model.robots[${slot}].sensors.findIndex((sensor) => sensor.kind === 'ranges');
        const reading = a.model.readings.of(${slot}, laser);
        return reading?.rows > 1 && ${newest}.time_s - reading.stamp_s < 1; })()`,
      );
    }
  });

  await check('they are stopped and released, held and go on', async () => {
    await say(page, {type: 'halt', do: 'stop', slots: []});
    await until(page, `${stopped} === ${app}.model.robots.length`);
    await until(
      page,
      `${app}.model.events.filter((event) => event.kind === 'stopped').length === ${app}.model.robots.length`,
    );
    await say(page, {type: 'halt', do: 'release', slots: []});
    await until(page, `${stopped} === 0`);
    await say(page, {type: 'transport', do: 'pause'});
    await until(page, `${app}.model.time.state === 'paused'`);
    await say(page, {type: 'transport', do: 'play'});
    await until(page, `${app}.model.time.state === 'running'`);
  });

  await check('an obstacle that somebody adds stands on the page, moves and goes', async () => {
    const edit = (...words) =>
      execFileSync(rave, ['edit', String(servers[0].child.pid), ...words], {
        stdio: ['ignore', 'ignore', 'inherit'],
      });
    const parcel = `[...${app}.model.bodies.values()].find((body) => body.name === 'parcel')`;
    edit('add', 'box', '--name', 'parcel', '--at', '4,4', '--size', '0.3x0.3');
    await until(page, `${parcel}?.kind === 'virtual' && ${parcel}.pose[0] === 4`);
    edit('move', 'parcel', '--at', '4.5,4');
    await until(page, `${parcel}?.pose[0] === 4.5`);
    const told = (kind) =>
      `${app}.model.events.filter((event) => event.kind === '${kind}' && event.count === 1).length`;
    await until(page, `${told('obstacle added')} === 1 && ${told('obstacle moved')} === 1`);
    edit('remove', 'parcel');
    await until(page, `${parcel} === undefined`);
  });

  await check(
    'the run that is over turns into its replay, merged from all recordings',
    async () => {
      await until(page, `${app}.model.hello.run.source === 'replay'`);
      assert.match(await page.evaluate(`${app}.model.hello.run.hash`), /^[0-9a-f]{16}$/);
      await until(page, `${newest} !== null && [...${newest}.flags].every((flags) => flags & 1)`);
      // Obstacles come, move and go again as they did.
      const at = (kind) =>
        page.evaluate(`${app}.model.events.find((event) => event.kind === 'obstacle ${kind}').t`);
      const [added, moved, removed] = [await at('added'), await at('moved'), await at('removed')];
      const parcel = `[...${app}.model.bodies.values()].find((body) => body.name === 'parcel')`;
      await say(page, {type: 'transport', do: 'pause'});
      await say(page, {type: 'transport', do: 'seek', value: (added + moved) / 2});
      await until(page, `${parcel}?.pose[0] === 4 && ${parcel}.shapes.length === 1`);
      await say(page, {type: 'transport', do: 'seek', value: (moved + removed) / 2});
      await until(page, `${parcel}?.pose[0] === 4.5`);
      await say(page, {type: 'transport', do: 'seek', value: removed + 0.1});
      await until(page, `${parcel} === undefined`);
      await say(page, {type: 'transport', do: 'seek', value: (added + moved) / 2});
      await until(page, `${parcel}?.pose[0] === 4`);
      await servers[0].end();
      assert.equal(JSON.parse(readFileSync(join(folder, 'run', 'result.json'))).whole, true);
    },
  );

  await check('three processes that are watched have the hash of three that are not', async () => {
    const kShort_s = 10;
    const run = (name, ...words) => [
      'run',
      scenario,
      '--processes',
      '3',
      '--quiet',
      '--no-picture',
      '--duration',
      String(kShort_s),
      '--output',
      join(folder, name),
      '--run',
      `${name}-${process.pid}`,
      ...words,
    ];
    const hash = (name) => JSON.parse(readFileSync(join(folder, name, 'result.json'))).hash;
    execFileSync(rave, run('unseen', '--pace', 'max'), {stdio: 'ignore'});
    const seen = await startServer(rave, run('seen', '--gui', '--pace', 'realtime'));
    servers.push(seen);
    const watcher = await context.newPage();
    console.log('watched', JSON.stringify(await watchUntouched(watcher, seen.link, kShort_s)));
    await seen.end();
    await watcher.close();
    assert.match(hash('unseen'), /^[0-9a-f]{16}$/);
    assert.equal(hash('seen'), hash('unseen'));
  });

  const shared = [
    '--processes',
    '2',
    '--quiet',
    '--no-picture',
    '--no-record',
    '--duration',
    '120',
    '--pace',
    'realtime',
    ...tag,
  ];
  await check('a server beside the run: it waits, sees it come, and stops robots', async () => {
    const gui = await startServer(rave, ['gui', scenario, '--processes', '2', ...tag]);
    servers.push(gui);
    const other = await context.newPage();
    await other.goto(gui.link);
    await until(other, `${app}?.model?.time?.state === 'waiting'`);
    for (const words of [['env'], ['robot', '--host', 'host-1'], ['robot', '--host', 'host-2']]) {
      const [command, ...more] = words;
      children.push(
        spawn(
          rave,
          [command, scenario, ...more, ...shared, '--output', join(folder, words.join('-'))],
          {stdio: 'ignore'},
        ),
      );
    }
    await until(
      other,
      `${app}.model.time.state === 'running' && ${newest} != null && ${newest}.time_s > 1`,
    );
    assert.equal(await other.evaluate(`${app}.model.may('play')`), true);
    await say(other, {type: 'halt', do: 'stop', slots: []});
    await until(other, `${stopped} === ${app}.model.robots.length`);
    // What it does is seen: nobody moves any more.
    await until(other, `[...${newest}.speed].every((speed) => Math.abs(speed) < 0.002)`);
    await say(other, {type: 'halt', do: 'release', slots: []});
    await until(other, `${stopped} === 0`);
  });

  await check('the manager is lost and comes back, and the page sees both', async () => {
    const other = context.pages().at(-1);
    const scan = `(() => { const a = ${app}; const slot = a.selection.primary;
      return a.model.readings.of(slot, a.model.robots[slot].sensors.findIndex((sensor) => sensor.kind === 'ranges'))?.stamp_s ?? -1; })()`;
    await other
      .locator('rave-robots .row', {hasText: await other.evaluate(`${app}.model.robots[7].name`)})
      .first()
      .click();
    await until(other, `${scan} > 0`);
    children[0].kill('SIGKILL');
    await until(
      other,
      `${app}.model.time.state === 'waiting' && ${app}.model.time.reason.includes('environment manager')`,
    );
    await until(
      other,
      `${app}.model.events.some((event) => event.kind === 'process lost' && event.level === 'alert')`,
    );
    const at = await other.evaluate(`${newest}.time_s`);
    children.push(
      spawn(rave, ['env', scenario, '--resume', ...shared, '--output', join(folder, 'env-again')], {
        stdio: 'ignore',
      }),
    );
    await until(
      other,
      `${app}.model.time.state === 'running' && ${newest}.time_s > ${at} + 1 && ${scan} > ${at} + 1`,
    );
    await until(other, `${app}.model.events.some((event) => event.kind === 'process back')`);
  });

  await check(
    'the server is killed and comes back, knows what was set before, and the run takes no notice',
    async () => {
      const other = context.pages().at(-1);
      const {key, value, range} = await other.evaluate(
        `${app}.model.robots[7].parameters.find(({kind, range}) => kind === 'number' && range !== undefined)`,
      );
      const set = value / 2 >= range[0] && value > 0 ? value / 2 : range[1];
      const answer = await other.evaluate(
        (what) => document.querySelector('rave-app').commands.ask(what),
        {type: 'set', slots: [7], key, value: set},
      );
      assert.ok(answer.good, answer.text);
      servers[1].child.kill('SIGKILL');
      const again = await startServer(rave, ['gui', scenario, '--processes', '2', ...tag]);
      servers.push(again);
      const third = await context.newPage();
      await third.goto(again.link);
      await until(
        third,
        `${app}?.model?.time?.state === 'running' && ${newest} != null && [...${newest}.flags].every((flags) => flags & 1)`,
      );
      await until(third, `${app}.model.drives.get(7)?.values?.['${key}'] === ${set}`);
      assert.deepEqual(
        children.slice(1).map((child) => child.exitCode),
        [null, null, null],
      );
      await again.end();
    },
  );

  await check(
    'a recording without the part of a host: its replay does not call itself whole',
    async () => {
      // Of the run of the first check.
      const torn = join(folder, 'torn');
      cpSync(join(folder, 'run'), torn, {recursive: true});
      rmSync(join(torn, 'run.mcap'), {force: true});
      rmSync(join(torn, 'hosts', 'host-2'), {recursive: true});
      const player = await startServer(rave, ['gui', torn]);
      servers.push(player);
      const last = await context.newPage();
      await last.goto(player.link);
      await until(last, `${app}?.model?.hello?.run.source === 'replay'`);
      const {hash, recording} = await last.evaluate(`${app}.model.hello.run`);
      assert.deepEqual([hash, recording.whole], [null, false]);
      await last.getByText(', incomplete').waitFor();
      await last.setViewportSize({width: 390, height: 844});
      await last.getByText('incomplete recording').waitFor();
      await player.end();
    },
  );

  await check(
    'beside a run that ends: its recordings turn into the replay, wherever its processes left them',
    async () => {
      const name = ['--run', `ends-${process.pid}`];
      const beside = await startServer(rave, ['gui', scenario, '--processes', '2', ...name]);
      servers.push(beside);
      const last = await context.newPage();
      await last.goto(beside.link);
      await until(last, `${app}?.model?.time?.state === 'waiting'`);
      // Unpaced it would be over before the server has found all of its processes.
      for (const words of [
        ['env', '--pace', '4x'],
        ['robot', '--host', 'host-1'],
        ['robot', '--host', 'host-2'],
      ]) {
        const [command, ...more] = words;
        children.push(
          spawn(
            rave,
            [
              command,
              scenario,
              ...more,
              '--processes',
              '2',
              '--quiet',
              '--no-picture',
              '--duration',
              '8',
              ...name,
              '--output',
              join(folder, `ends-${words.join('-')}`),
            ],
            {stdio: 'ignore'},
          ),
        );
      }
      await until(last, `${app}.model.hello.run.source === 'replay'`);
      // The hash needs the recordings of both hosts and of the manager.
      assert.match(await last.evaluate(`${app}.model.hello.run.hash`), /^[0-9a-f]{16}$/);
      await until(last, `${newest} !== null && [...${newest}.flags].every((flags) => flags & 1)`);
      await beside.end();
    },
  );

  await check('beside a run that ends without recordings: the page says so', async () => {
    const name = ['--run', `bare-${process.pid}`];
    const beside = await startServer(rave, ['gui', scenario, '--processes', '2', ...name]);
    servers.push(beside);
    const last = await context.newPage();
    await last.goto(beside.link);
    await until(last, `${app}?.model?.time?.state === 'waiting'`);
    children.push(
      spawn(
        rave,
        [
          'run',
          scenario,
          '--processes',
          '2',
          '--quiet',
          '--no-picture',
          '--no-record',
          '--duration',
          '5',
          ...name,
          '--output',
          join(folder, 'bare'),
        ],
        {stdio: 'ignore'},
      ),
    );
    await until(
      last,
      `${app}.model.time.state === 'ended' && ${app}.model.time.reason === 'The run left no recording.'`,
    );
    await last.getByText('The run left no recording.').first().waitFor();
    await beside.end();
  });

  await checkRealTime({rave, scenario, folder, context, servers, say});

  await check('every message is as the schema describes it', async () => {
    const file = join(folder, 'messages.json');
    writeFileSync(file, JSON.stringify(said));
    execFileSync('python3', [new URL('check_messages.py', import.meta.url).pathname, file], {
      stdio: 'inherit',
    });
    assert.ok(said.some((message) => message.type === 'hosts'));
  });
} finally {
  await browser.close();
  for (const server of servers) server.child.kill('SIGKILL');
  for (const child of children) child.kill('SIGKILL');
}
report();
process.exit(0);
