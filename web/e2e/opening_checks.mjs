// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import {app, check, until} from './checks.mjs';
import {FakeRun} from './fake_run.mjs';
import {serveFake} from './fake_server.mjs';

/** While the parts of a run have not all come. */
export async function checkOpening({browser, built}) {
  await check(
    'before the data come the page says that it loads, not that there is nothing',
    async () => {
      const late = new FakeRun(3, {name: 'late'});
      const opening = late.opening.bind(late);
      late.opening = () => [late.hello()];
      const other = await serveFake(built, late);
      clearInterval(other.clock);
      const early = await (
        await browser.newContext({viewport: {width: 1400, height: 900}})
      ).newPage();
      await early.goto(other.origin);
      await early.getByText('late', {exact: true}).waitFor();
      await early.getByText('Loading the robots ...').waitFor();
      await early.getByText('Loading the run ...').waitFor();
      assert.equal(await early.getByText('No robots in this run.').count(), 0);
      assert.equal(await early.locator('rave-robots .chip').count(), 0);
      assert.equal(await early.locator('rave-run-bar .clock b').count(), 0);
      late.opening = opening;
      for (const message of opening()) other.say(message);
      await early.locator('rave-robots .row').first().waitFor();
      await early.locator('rave-run-bar .clock b').waitFor();
      assert.equal(await early.getByText('Loading').count(), 0);
      await early.close();
      await other.end();
    },
  );

  await check(
    'the World View shows robots whose poses come after the world, host by host',
    async () => {
      const slow = new FakeRun(16, {name: 'slow', known: 0});
      const other = await serveFake(built, slow);
      const early = await (
        await browser.newContext({viewport: {width: 1400, height: 900}})
      ).newPage();
      await early.goto(other.origin);
      await until(early, `${app}?.model?.bodies?.size > 0 && ${app}.model.poses.newest !== null`);
      const inside = `(() => {
      const world = document.querySelector('rave-world');
      const {placed, stage} = world;
      const {clientWidth, clientHeight} = world.renderRoot.querySelector('.canvas');
      return Array.from(placed.x, (x, i) => [placed.flags[i] & 1, ...stage.screenAt(x, placed.y[i])])
        .filter(([known, x, y]) => known && x > 0 && y > 0 && x < clientWidth && y < clientHeight).length;
    })()`;
      for (const known of [5, 16]) {
        slow.known = known;
        await until(early, `${inside} === ${known}`);
      }
      await early.close();
      await other.end();
    },
  );
}
