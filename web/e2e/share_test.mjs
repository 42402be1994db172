// SPDX-License-Identifier: Apache-2.0
// People share a page over TLS, each with their rights: node share_test.mjs RAVE SCENARIO FOLDER
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {mkdirSync, rmSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';
import {launch, startServer} from './browser.mjs';
import {app, check, report, showFailures, until, untilHere, watch} from './checks.mjs';

const [rave, scenario, folder] = process.argv.slice(2);
rmSync(folder, {recursive: true, force: true});
mkdirSync(folder, {recursive: true});
const run = join(folder, 'run');
const keys = join(folder, 'keys');
const accounts = join(folder, 'accounts');
function call(words, input = '') {
  return execFileSync(rave, words, {input, encoding: 'utf8', stdio: ['pipe', 'pipe', 'inherit']});
}
call(['run', scenario, '--pace', 'max', '--quiet', '--no-picture', '--output', run]);
call(['keys', 'web', keys, '127.0.0.1']);
call(['people', 'add', 'ada', '--role', 'super_user', '--accounts', accounts], 'correct horse\n');
const gui = await startServer(rave, [
  'gui', run, '--certificate', join(keys, 'server.pem'), '--key', join(keys, 'server_key.pem'), '--accounts', accounts,
]);
const origin = new URL(gui.link).origin;
const browser = await launch();
const said = [];

/** A page with all messages that it got. The browser was not told of the authority. */
async function somebody() {
  const context = await browser.newContext({ignoreHTTPSErrors: true});
  const page = await context.newPage();
  const messages = [];
  page.on('websocket', (socket) => {
    socket.on('framereceived', ({payload}) => typeof payload === 'string' && messages.push(JSON.parse(payload)));
    for (const event of ['framereceived', 'framesent']) {
      socket.on(event, ({payload}) => typeof payload === 'string' && said.push(JSON.parse(payload)));
    }
  });
  const last = (type) => messages.filter((message) => message.type === type).at(-1);
  return {page, messages, last, ...watch(page, origin)};
}

/** A right is changed as a super-user's page does it. */
function setRight(page, change) {
  return page.evaluate(
    (request) =>
      new Promise((resolve) => {
        const socket = new WebSocket(`wss://${location.host}/ws`, 'rave.gui.1');
        socket.onopen = () => socket.send(JSON.stringify({type: 'set_right', ...request}));
        socket.onmessage = ({data}) => {
          const message = typeof data === 'string' ? JSON.parse(data) : {};
          if (message.to !== 'set_right') return;
          socket.close();
          resolve(message.good);
        };
      }),
    change,
  );
}

try {
  const boss = await somebody();
  const guest = await somebody();
  showFailures(guest.page, join(folder, 'failed.png'));

  await check('who is not signed in comes to the door, and a wrong password is told there', async () => {
    await boss.page.goto(`${origin}/`);
    assert.equal(new URL(boss.page.url()).pathname, '/login');
    await boss.page.fill('#name', 'ada');
    await boss.page.fill('#password', 'wrong horse');
    await boss.page.click('button');
    assert.match(await boss.page.textContent('[role=alert]'), /The name or the password is wrong/);
    assert.equal(await boss.page.inputValue('#name'), 'ada');
    await boss.page.screenshot({path: join(folder, 'sign-in.png')});
  });

  await check('the right password opens the page', async () => {
    await boss.page.fill('#password', 'correct horse');
    await boss.page.click('button');
    await until(boss.page, app);
    await untilHere(boss.page, () => boss.last('rights'), 'the rights of a super-user');
    assert.deepEqual(boss.last('hello').user, {name: 'ada', role: 'super_user'});
  });

  await check('an invitation opens it for a guest, who gets what the link says', async () => {
    const link = call(['people', 'invite', '--teams', 'green', '--accounts', accounts]).split('\n')[0];
    assert.ok(link.startsWith(origin), link);
    await guest.page.goto(link);
    await guest.page.fill('#name', 'eve');
    await guest.page.click('button');
    await untilHere(guest.page, () => guest.last('roster'), 'a roster');
    assert.deepEqual(guest.last('hello').user, {name: 'eve', role: 'observer'});
    assert.equal(guest.last('rights'), undefined);
    for (const robot of guest.last('roster').robots) {
      assert.equal(robot.sensors.length > 0, robot.team === 'green', robot.name);
    }
  });

  await check('rights that change are in force at once, without a reload', async () => {
    assert.equal(await setRight(boss.page, {role: 'observer', class: 'pose', reach: 'own'}), true);
    await untilHere(guest.page, () => guest.last('roster').robots.every(({team}) => team === 'green'), 'green alone');
    assert.equal(await setRight(guest.page, {role: 'observer', class: 'pose', reach: 'all'}), false);
    const before = guest.messages.length;
    assert.equal(await setRight(boss.page, {role: 'observer', class: 'obstacles', reach: 'none'}), true);
    await untilHere(guest.page, () => guest.last('scene').hidden.includes('virtual'), 'no obstacles');
    const since = JSON.stringify(guest.messages.slice(before));
    for (const {name, team} of boss.last('roster').robots) {
      if (team !== 'green') assert.ok(!since.includes(`"${name}"`), name);
    }
  });

  await check('who is removed is out', async () => {
    call(['people', 'remove', 'eve', '--accounts', accounts]);
    await until(guest.page, `${app}.shadowRoot.textContent.includes("signed out")`);
  });

  await check('every message is as the schema describes it', async () => {
    const types = new Set(said.map(({type}) => type));
    for (const type of ['hello', 'rights', 'set_right', 'answer']) assert.ok(types.has(type), type);
    const file = join(folder, 'messages.json');
    writeFileSync(file, JSON.stringify(said));
    execFileSync('python3', [new URL('check_messages.py', import.meta.url).pathname, file], {stdio: 'inherit'});
  });

  await check('nobody went elsewhere', async () => {
    assert.deepEqual([...boss.foreign, ...guest.foreign], []);
  });
  report();
} finally {
  await browser.close();
  await gui.end();
}
