// SPDX-License-Identifier: Apache-2.0
// People share a page over TLS, each with their rights: node share_test.mjs RAVE SCENARIO FOLDER
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {mkdirSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
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
  'gui',
  run,
  '--certificate',
  join(keys, 'server.pem'),
  '--key',
  join(keys, 'server_key.pem'),
  '--accounts',
  accounts,
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
    socket.on(
      'framereceived',
      ({payload}) => typeof payload === 'string' && messages.push(JSON.parse(payload)),
    );
    for (const event of ['framereceived', 'framesent']) {
      socket.on(
        event,
        ({payload}) => typeof payload === 'string' && said.push(JSON.parse(payload)),
      );
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

  await check(
    'who is not signed in comes to the door, and a wrong password is told there',
    async () => {
      await boss.page.goto(`${origin}/`);
      assert.equal(new URL(boss.page.url()).pathname, '/login');
      await boss.page.fill('#name', 'ada');
      await boss.page.fill('#password', 'wrong horse');
      await boss.page.click('button');
      assert.match(
        await boss.page.textContent('[role=alert]'),
        /The name or the password is wrong/,
      );
      assert.equal(await boss.page.inputValue('#name'), 'ada');
      await boss.page.screenshot({path: join(folder, 'sign-in.png')});
    },
  );

  await check('the right password opens the page', async () => {
    await boss.page.fill('#password', 'correct horse');
    await boss.page.click('button');
    await until(boss.page, app);
    await untilHere(boss.page, () => boss.last('rights'), 'the rights of a super-user');
    assert.deepEqual(boss.last('hello').user, {name: 'ada', role: 'super_user'});
  });

  await check('an invitation opens it for a guest, who gets what the link says', async () => {
    const link = call(['people', 'invite', '--teams', 'green', '--accounts', accounts]).split(
      '\n',
    )[0];
    assert.ok(link.startsWith(origin), link);
    await guest.page.goto(link);
    await guest.page.fill('#name', 'eva');
    await guest.page.click('button');
    await untilHere(guest.page, () => guest.last('roster'), 'a roster');
    assert.deepEqual(guest.last('hello').user, {name: 'eva', role: 'observer'});
    assert.equal(guest.last('rights'), undefined);
    for (const robot of guest.last('roster').robots) {
      assert.equal(robot.sensors.length > 0, robot.team === 'green', robot.name);
    }
  });

  await check('rights that change are in force at once, without a reload', async () => {
    assert.equal(await setRight(boss.page, {role: 'observer', class: 'pose', reach: 'own'}), true);
    await untilHere(
      guest.page,
      () => guest.last('roster').robots.every(({team}) => team === 'green'),
      'green alone',
    );
    assert.equal(
      await setRight(guest.page, {role: 'observer', class: 'pose', reach: 'all'}),
      false,
    );
    const before = guest.messages.length;
    assert.equal(
      await setRight(boss.page, {role: 'observer', class: 'obstacles', reach: 'none'}),
      true,
    );
    await untilHere(
      guest.page,
      () => guest.last('scene').hidden.includes('virtual'),
      'no obstacles',
    );
    // The words of the server and those of the page are about the same.
    await until(guest.page, `${app}.model.whyNot('obstacles').includes('ada')`);
    const why = await guest.page.evaluate(`${app}.model.whyNot('obstacles')`);
    assert.equal(
      why,
      'You may not see virtual obstacles. By default observers, commanders and super-users have this right. Ask a super-user who is here: ada.',
    );
    await guest.page.getByRole('button', {name: 'virtual obstacles'}).waitFor();
    const since = JSON.stringify(guest.messages.slice(before));
    for (const {name, team} of boss.last('roster').robots) {
      if (team !== 'green') assert.ok(!since.includes(`"${name}"`), name);
    }
  });

  /** The part of the Super-User panel with this name. */
  async function part(name) {
    await boss.page.getByRole('tab', {name, exact: false}).last().click();
  }

  await check(
    'a super-user makes an invitation in the page; its link is shown once and lets somebody in',
    async () => {
      await boss.page.setViewportSize({width: 1500, height: 950});
      await boss.page.keyboard.press('Control+k');
      await boss.page.keyboard.type('super-user');
      await boss.page.keyboard.press('Enter');
      await part('Invitations');
      await boss.page.getByText('There are no open invitations').waitFor();
      await boss.page.getByLabel('Role').selectOption('commander');
      await boss.page.getByLabel('People', {exact: true}).fill('2');
      await boss.page.getByRole('button', {name: 'Make a link'}).click();
      const link = await boss.page.locator('rave-invitations code').textContent();
      assert.ok(link.startsWith(`${origin}/join?invite=`), link);
      await boss.page.getByText('2 uses left').waitFor();
      await boss.page.getByRole('button', {name: 'Put the link away'}).click();
      const secret = link.split('=')[1];
      assert.equal(
        boss.messages.filter((message) => JSON.stringify(message).includes(secret)).length,
        1,
      );
      await guest.page.goto(link);
      await guest.page.fill('#name', 'ben');
      await guest.page.click('button');
      await untilHere(guest.page, () => guest.last('hello')?.user.name === 'ben', 'a commander');
      await boss.page.getByText('for one person').waitFor();
      await boss.page.getByRole('button', {name: /Withdraw/}).click();
      await boss.page.getByText('There are no open invitations').waitFor();
      assert.doesNotMatch(readFileSync(join(accounts, 'audit.jsonl'), 'utf8'), new RegExp(secret));
    },
  );

  await check(
    'people are listed with who is here, and another role is on their page without a reload',
    async () => {
      await part('People');
      await boss.page.locator('rave-people tr', {hasText: 'ben'}).getByText('now').waitFor();
      await boss.page.screenshot({path: join(folder, 'people.png')});
      await boss.page.getByRole('button', {name: 'Change ben'}).click();
      await boss.page.locator('rave-people').getByLabel('Role').selectOption('observer');
      await boss.page.evaluate('window.mark = 1');
      await guest.page.evaluate('window.mark = 2');
      await boss.page.getByRole('button', {name: 'Change', exact: true}).click();
      await untilHere(
        guest.page,
        () => guest.last('hello').user.role === 'observer',
        'an observer',
      );
      await until(guest.page, `${app}.model.hello.user.role === 'observer'`);
      assert.equal(await guest.page.evaluate('window.mark'), 2);
      await boss.page
        .locator('rave-people tr', {hasText: 'ben'})
        .getByText('observer', {exact: true})
        .waitFor();
    },
  );

  await check('the audit log tells it, and can be filtered', async () => {
    await part('Audit log');
    await boss.page.getByText('changed ben: observer').waitFor();
    await boss.page.getByLabel('Kind').selectOption('invitation');
    await boss.page.getByText('invitation made: commander').waitFor();
    await until(
      boss.page,
      '![...document.querySelectorAll("rave-super-user")].some((panel) => panel.shadowRoot.querySelector("rave-audit").shadowRoot.textContent.includes("changed ben"))',
    );
    await boss.page.getByLabel('Filter the audit log').fill('withdrawn');
    await until(
      boss.page,
      'document.querySelector("rave-super-user").shadowRoot.querySelector("rave-audit").shadowRoot.querySelectorAll(".line").length === 1',
    );
    await boss.page.screenshot({path: join(folder, 'audit.png')});
  });

  await check('who is disabled is out, and keeps the name', async () => {
    await part('People');
    await boss.page.getByRole('button', {name: 'Change ben'}).click();
    await boss.page.getByRole('button', {name: 'Disable'}).click();
    await until(guest.page, `${app}.shadowRoot.textContent.includes("signed out")`);
    await boss.page.locator('rave-people tr', {hasText: 'ben'}).getByText('disabled').waitFor();
    const link = call(['people', 'invite', '--teams', 'green', '--accounts', accounts]).split(
      '\n',
    )[0];
    await guest.page.goto(link);
    await guest.page.fill('#name', 'ben');
    await guest.page.click('button');
    await guest.page.getByText('is taken').waitFor();
    await guest.page.fill('#name', 'eve');
    await guest.page.click('button');
    await untilHere(guest.page, () => guest.last('hello')?.user.name === 'eve', 'eve');
  });

  await check('who is removed is out', async () => {
    call(['people', 'remove', 'eve', '--accounts', accounts]);
    await until(guest.page, `${app}.shadowRoot.textContent.includes("signed out")`);
  });

  await check('every message is as the schema describes it', async () => {
    const types = new Set(said.map(({type}) => type));
    for (const type of [
      'hello',
      'rights',
      'set_right',
      'accounts',
      'account',
      'invitation',
      'invited',
      'audit',
      'audit_lines',
      'audit_written',
      'answer',
    ])
      assert.ok(types.has(type), type);
    const file = join(folder, 'messages.json');
    writeFileSync(file, JSON.stringify(said));
    execFileSync('python3', [new URL('check_messages.py', import.meta.url).pathname, file], {
      stdio: 'inherit',
    });
  });

  await check('nobody went elsewhere', async () => {
    assert.deepEqual([...boss.foreign, ...guest.foreign], []);
  });
  report();
} finally {
  await browser.close();
  await gui.end();
}
