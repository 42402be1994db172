// SPDX-License-Identifier: Apache-2.0
// A scenario hands a team to another commander while both look on.
// node convoy_test.mjs RAVE SCENARIO FOLDER
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {mkdirSync, readFileSync, rmSync} from 'node:fs';
import {join} from 'node:path';
import {startServer} from './browser.mjs';
import {check, report, until, untilHere} from './checks.mjs';
import {happened, slotOf} from './commander.mjs';
import {goal, invited, linkIn} from './invited.mjs';

const [rave, scenario, folder] = process.argv.slice(2);
rmSync(folder, {recursive: true, force: true});
mkdirSync(folder, {recursive: true});
const run = join(folder, 'run');
const server = await startServer(rave, [
  'run',
  scenario,
  '--gui',
  '--paused',
  '--quiet',
  '--no-picture',
  '--pace',
  '4x',
  '--output',
  run,
]);
const people = {};
try {
  await untilHere(
    {waitForTimeout: (ms) => new Promise((resolve) => setTimeout(resolve, ms))},
    () => ['ann', 'bob', 'sue'].every((name) => linkIn(server.said(), name)),
    'a link for each',
  );
  for (const name of ['ann', 'bob'])
    people[name] = await invited(server, name, 4, join(folder, `failure-${name}.png`));
  const {ann, bob} = people;
  let said = '';
  const rear = await slotOf(ann.page, 'truck-3');
  const takesOrders = async (one) => {
    const answer = await goal(one, rear, [-4, 1]);
    said = answer.text;
    return answer.good;
  };

  await check('before, the rear team is of the first commander alone', async () => {
    assert.equal(await takesOrders(bob), false);
  });
  await check('the wall closes, and the team is given', async () => {
    execFileSync(rave, ['resume', `convoy-${server.child.pid}`]);
    await until(ann.page, happened('scenario', 'the front is through'));
    await until(bob.page, happened('team given', 'rear to bob'));
  });
  await check('then it is of the second commander alone', async () => {
    // The server looks at its accounts twice a second.
    while (!(await takesOrders(bob))) {
      assert.ok(/rights/.test(said), said);
      await bob.page.waitForTimeout(50);
    }
    assert.equal(await takesOrders(ann), false);
    await bob.page.screenshot({path: join(folder, 'bob.png')});
  });
  await check('the run ends by itself, with success', async () => {
    await until(bob.page, happened('scenario', 'the run ends: success'));
    server.child.kill('SIGINT');
    const exited = new Promise((resolve) => server.child.once('exit', resolve));
    assert.equal(await exited, 0);
    const result = JSON.parse(readFileSync(join(run, 'result.json'), 'utf8'));
    assert.equal(result.whole, true, JSON.stringify(result.problems));
  });
} finally {
  for (const {browser} of Object.values(people)) await browser.close();
  server.child.kill('SIGINT');
}
report();
