// SPDX-License-Identifier: Apache-2.0
// Runs of several processes on the page: node hosts_test.mjs RAVE SCENARIO FOLDER
import assert from 'node:assert/strict';
import {spawn} from 'node:child_process';
import {mkdirSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';
import {launch, startServer} from './browser.mjs';
import {app, check, report, until} from './checks.mjs';

const [rave, scenario, folder] = process.argv.slice(2);
const newest = `${app}.model.poses.newest`;
const kStopped = 4;
const stopped = `[...${newest}.flags].filter((flags) => flags & ${kStopped}).length`;
const say = (page, message) => page.evaluate((what) => document.querySelector('rave-app').link.send(what), message);
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
  page.on('websocket', (socket) => socket.on('framereceived', ({payload}) => typeof payload === 'string' && said.push(JSON.parse(payload))));

  await check('three processes in lock-step are one world on the page', async () => {
    const run = await startServer(rave, ['run', scenario, '--gui', '--processes', '3', '--quiet', '--no-picture', '--duration', '30', '--output', join(folder, 'run'), ...tag]);
    servers.push(run);
    await page.goto(run.link);
    await until(page, `${newest} != null && [...${newest}.flags].every((flags) => flags & 1)`, 60000);
    const before = await page.evaluate(`${newest}.time_s`);
    await until(page, `${newest}.time_s > ${before} + 1`);
    await until(page, `${app}.model.hosts.filter((host) => host.state === 'here').length === 4`);
  });

  await check('they are stopped and released, held and go on', async () => {
    await say(page, {type: 'halt', do: 'stop', slots: []});
    await until(page, `${stopped} === ${app}.model.robots.length`);
    await say(page, {type: 'halt', do: 'release', slots: []});
    await until(page, `${stopped} === 0`);
    await say(page, {type: 'transport', do: 'pause'});
    await until(page, `${app}.model.time.state === 'paused'`);
    await say(page, {type: 'transport', do: 'play'});
    await until(page, `${app}.model.time.state === 'running'`);
  });

  await check('the run that is over turns into its replay, merged from all recordings', async () => {
    await until(page, `${app}.model.hello.run.source === 'replay'`, 90000);
    assert.match(await page.evaluate(`${app}.model.hello.run.hash`), /^[0-9a-f]{16}$/);
    await until(page, `${newest} !== null && [...${newest}.flags].every((flags) => flags & 1)`);
    await servers[0].end();
    assert.equal(JSON.parse(readFileSync(join(folder, 'run', 'result.json'))).whole, true);
  });

  await check('a server beside the run: it waits, sees it come, and stops robots', async () => {
    const gui = await startServer(rave, ['gui', scenario, '--processes', '2', ...tag]);
    servers.push(gui);
    const other = await context.newPage();
    await other.goto(gui.link);
    await until(other, `${app}?.model?.time?.state === 'waiting'`);
    const shared = ['--processes', '2', '--quiet', '--no-picture', '--no-record', '--duration', '60', '--pace', 'realtime', ...tag];
    for (const words of [['env'], ['robot', '--host', 'host-1'], ['robot', '--host', 'host-2']]) {
      const [command, ...more] = words;
      children.push(spawn(rave, [command, scenario, ...more, ...shared, '--output', join(folder, words.join('-'))], {stdio: 'ignore'}));
    }
    await until(other, `${app}.model.time.state === 'running' && ${newest} != null && ${newest}.time_s > 1`, 60000);
    assert.equal(await other.evaluate(`${app}.model.may('play')`), false);
    await say(other, {type: 'halt', do: 'stop', slots: []});
    await until(other, `${stopped} === ${app}.model.robots.length`);
    // What it does is seen: nobody moves any more.
    await until(other, `[...${newest}.speed].every((speed) => Math.abs(speed) < 0.002)`);
    await gui.end();
    assert.equal(children[0].exitCode, null);
  });

  await check('every message is as the schema describes it', async () => {
    const file = join(folder, 'messages.json');
    writeFileSync(file, JSON.stringify(said));
    const {execFileSync} = await import('node:child_process');
    execFileSync('python3', [new URL('check_messages.py', import.meta.url).pathname, file], {stdio: 'inherit'});
    assert.ok(said.some((message) => message.type === 'hosts'));
  });
} finally {
  await browser.close();
  for (const server of servers) server.child.kill('SIGKILL');
  for (const child of children) child.kill('SIGKILL');
}
report();
process.exit(0);
