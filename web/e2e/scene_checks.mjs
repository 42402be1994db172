// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import {join} from 'node:path';
import {app, check, until, untilHere} from './checks.mjs';

/** Bodies and hosts that change while they are shown. */
export async function checkScene({page, server}) {
  await check('bodies come, move and go', async () => {
    server.say({
      type: 'scene_change',
      set: [
        {
          id: 9,
          name: 'cone',
          kind: 'virtual',
          pose: [1, 1, 0],
          shapes: [{disc: [0, 0, 0.2], z: [0, 0.4]}],
        },
      ],
      gone: [1],
    });
    await until(page, `${app}.model.bodies.has(9) && !${app}.model.bodies.has(1)`);
  });

  await check('hosts are listed', async () => {
    server.say({
      type: 'hosts',
      hosts: [
        {
          name: 'host-3',
          machine: 'lab-3',
          state: 'late',
          late_s: 2.9,
          real: 0,
          simulated: 5,
          step: 1461,
          steps_per_s: 0,
          delay_s: 0.000225,
          cpu: 0,
          lost: 2,
        },
      ],
    });
    await page.locator('.dv-tab', {hasText: 'Hosts'}).click();
    await page.getByText('late 2.9 s', {exact: true}).waitFor();
    await page.getByText('225 µs').waitFor();
  });
}

/** Rights, and who else is here. */
export async function checkPeople(at) {
  await checkRights(at);
  await checkFaces(at);
}

async function checkRights({page, server, heard}) {
  await check(
    'a super-user changes a right, takes it back, and sees as somebody else',
    async () => {
      server.run.role = 'super_user';
      server.run.seeAs(null);
      server.turnInto({});
      await page.getByRole('radio', {name: 'Conduct'}).click();
      const cell = page.getByRole('button', {name: /^Obstacles of carla/});
      await cell.click();
      await untilHere(page, () => heard('set_right').length === 1, 'set_right');
      assert.deepEqual(heard('set_right')[0], {
        type: 'set_right',
        user: 'carla',
        class: 'obstacles',
        reach: 'all',
      });
      await page.getByText(/in force after/).waitFor();
      await page.getByRole('button', {name: 'Undo'}).click();
      await untilHere(page, () => heard('set_right').length === 2, 'undo');
      assert.equal(heard('set_right')[1].reach, null);
      await page.getByRole('button', {name: 'See as carla'}).click();
      await page.getByText('This is what').waitFor();
      assert.equal(await page.evaluate(`${app}.model.rights`), null);
      await page.getByRole('button', {name: 'Back'}).click();
      await until(page, `${app}.model.rights !== null`);
    },
  );
}

async function checkFaces({page, server, folder}) {
  await check(
    'who else watches is in the top bar, and leads super-users to the list of people',
    async () => {
      const people = ['Ben K', 'carla', 'Dana Q', 'Emil', 'Fatima'].map((name) => ({
        name,
        role: 'observer',
      }));
      server.say({type: 'people', people: [{name: 'Ada N', role: 'super_user'}, ...people]});
      const faces = page.getByRole('button', {
        name: '6 people watch: you; Ben K, Observer; carla, Observer; Dana Q, Observer; Emil, Observer; Fatima, Observer. Open the list',
      });
      await faces.waitFor();
      assert.deepEqual(await faces.locator('.face').allInnerTexts(), ['BK', 'CA', 'DQ', '+2']);
      for (const layout of ['Watch', 'Conduct']) {
        await page.getByRole('radio', {name: layout}).click();
        await faces.focus();
        await page.keyboard.press('Enter');
        await page.getByRole('tab', {name: /^People/, selected: true}).waitFor();
        await page.getByRole('tab', {name: 'Audit log'}).click();
      }
      await page.screenshot({path: join(folder, 'faces.png')});
      server.turnInto({may: ['readings', 'log'], role: 'observer'});
      server.say({type: 'people', people: [{name: 'Ada N', role: 'observer'}, ...people]});
      await page.getByRole('img', {name: /^6 people watch: you; Ben K/}).waitFor();
      assert.equal(await page.locator('rave-top-bar button.people').count(), 0);
      // Who may not talk is told a new view of the run, and no names.
      server.say(server.run.hello());
      await page.locator('rave-top-bar .people').waitFor({state: 'detached'});
    },
  );
}
