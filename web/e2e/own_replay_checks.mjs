// SPDX-License-Identifier: Apache-2.0
// Replays of runs that the test makes: with panels of their own, and with words.
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {mkdirSync, rmSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';
import {startServer} from './browser.mjs';
import {app, check, until} from './checks.mjs';

export async function checkOwnReplays(at) {
  await checkPanels(at);
  await checkWords(at);
}

async function checkPanels({rave, folder, browser}) {
  await check(
    'a panel of the scenario is there in the replay, and a module that is gone is no error',
    async () => {
      const home = join(folder, 'panels');
      mkdirSync(home);
      writeFileSync(
        join(home, 'count.mjs'),
        `class Count extends HTMLElement { connectedCallback() { this.textContent = this.context.model.robots.length + ' robot counted'; } }
      export const component = {api: 1, name: 'count', version: '1', panels: [{id: 'count', title: 'Counted', element: Count}]};`,
      );
      writeFileSync(join(home, 'lost.mjs'), 'export const component = {};');
      writeFileSync(
        join(home, 'scenario.yaml'),
        `name: counted
duration_s: 1
gui: {components: [{module: lost.mjs, roles: [observer]}, {module: count.mjs, roles: [observer]}]}
robots: [{name: r, pose: {x_m: 0, y_m: 0}, robot: {body: {shapes: [{disc_radius_m: 0.2, z_m: [0, 0.3]}]}}}]
`,
      );
      execFileSync(
        rave,
        [
          'run',
          join(home, 'scenario.yaml'),
          '--pace',
          'max',
          '--quiet',
          '--no-picture',
          '--output',
          join(home, 'run'),
        ],
        {stdio: ['ignore', 'ignore', 'inherit']},
      );
      rmSync(join(home, 'lost.mjs'));
      const other = await startServer(rave, ['gui', join(home, 'run')]);
      const replay = await (
        await browser.newContext({viewport: {width: 1400, height: 900}})
      ).newPage();
      await replay.goto(other.link);
      await replay.locator('.dv-tab', {hasText: 'Counted'}).click();
      await replay.getByText('1 robot counted').waitFor();
      assert.equal(await replay.locator('.dv-tab', {hasText: 'lost'}).count(), 0);
      await replay.close();
      await other.end();
    },
  );
}

async function checkWords({rave, folder, browser, openPanel}) {
  await check(
    'what was said in a run is read in its replay, and nothing can be said there',
    async () => {
      const home = join(folder, 'chat');
      mkdirSync(home);
      writeFileSync(
        join(home, 'scenario.yaml'),
        `name: talked
duration_s: 120
robots: [{name: r, pose: {x_m: 0, y_m: 0}, robot: {body: {shapes: [{disc_radius_m: 0.2, z_m: [0, 0.3]}]}}}]
`,
      );
      const live = await startServer(rave, [
        'run',
        join(home, 'scenario.yaml'),
        '--gui',
        '--quiet',
        '--no-picture',
        '--output',
        join(home, 'run'),
      ]);
      const talking = await (
        await browser.newContext({viewport: {width: 1400, height: 900}})
      ).newPage();
      await talking.goto(live.link);
      await until(talking, `${app}?.model?.robots?.length === 1`);
      const chat = talking.locator('rave-chat');
      await openPanel(talking, 'Chat');
      for (const role of ['Commanders', 'Observers', 'Super-users'])
        await chat.getByRole('radio', {name: role}).waitFor();
      await chat.getByRole('radio', {name: 'Super-users'}).click();
      await chat.locator('textarea').fill('Watch the red robot');
      await chat.locator('textarea').press('Enter');
      await chat.locator('article', {hasText: 'Watch the red robot'}).waitFor();
      await chat.getByText('The chat is recorded with the run.').waitFor();
      await talking.close();
      await live.end();

      const other = await startServer(rave, ['gui', join(home, 'run')]);
      const replay = await (
        await browser.newContext({viewport: {width: 1400, height: 900}})
      ).newPage();
      await replay.goto(other.link);
      await until(replay, `${app}?.model?.robots?.length === 1`);
      await openPanel(replay, 'Chat');
      const shown = replay.locator('rave-chat');
      await shown.locator('article', {hasText: 'Watch the red robot'}).waitFor();
      await shown.getByText('to super-users').waitFor();
      assert.equal(await shown.locator('textarea').count(), 0);
      assert.equal(await shown.getByRole('radio').count(), 0);
      await replay.screenshot({path: join(folder, 'chat.png')});
      await replay.close();
      await other.end();
    },
  );
}
