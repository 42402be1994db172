// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import {join} from 'node:path';
import {app, check, until} from './checks.mjs';

/** Panels that a run brings along. */
export async function checkComponents(at) {
  await checkPanels(at);
  await checkKeptLayout(at);
}

async function checkPanels({page, server, folder}) {
  await check(
    'a component has its panel and draws over the world; a broken one harms nothing',
    async () => {
      server.components.set(
        '/components/0/heat.js',
        `
      class Heat extends HTMLElement { connectedCallback() { this.textContent = this.context.model.robots.length + ' robots are warm'; } }
      export const component = {api: 1, name: 'heat', version: '1.2', panels: [{id: 'heat', title: 'Heat map', element: Heat}],
        extend(context) { const layer = () => { globalThis.layers = (globalThis.layers ?? 0) + 1; }; context.worldLayers.add(layer); return () => context.worldLayers.delete(layer); }};`,
      );
      server.components.set(
        '/components/1/broken.js',
        `
      class Broken extends HTMLElement { connectedCallback() { cells.draw(); } }
      export const component = {api: 1, name: 'broken', version: '0.1', panels: [{id: 'broken', title: 'Broken', element: Broken}]};`,
      );
      server.run.components = [
        {name: 'heat', url: 'components/0/heat.js'},
        {name: 'broken', url: 'components/1/broken.js'},
        {name: 'gone', url: 'components/2/gone.js'},
      ];
      server.turnInto({});
      await page.locator('.dv-tab', {hasText: 'Heat map'}).click();
      await page.getByText('16 robots are warm').waitFor();
      await until(page, 'globalThis.layers > 3');
      await page.locator('.dv-tab', {hasText: 'Broken'}).click();
      await page.getByText('This panel stopped').first().waitFor();
      await page.getByText('cells is not defined').first().waitFor();
      await page.screenshot({path: join(folder, 'broken.png')});
      const before = await page.evaluate(`${app}.model.poses.newest.time_s`);
      await until(page, `${app}.model.poses.newest.time_s > ${before}`);
      await page.locator('.dv-tab', {hasText: 'gone'}).click();
      await page
        .getByText(/Failed to fetch|error/)
        .first()
        .waitFor();
    },
  );
}

async function checkKeptLayout({browser, server}) {
  await check(
    'a layout that was kept has its component in its place, and outlives a run without it',
    async () => {
      const own = await (
        await browser.newContext({viewport: {width: 1500, height: 950}})
      ).newPage();
      const errors = [];
      own.on('console', (message) => message.type() === 'error' && errors.push(message.text()));
      const kept = () =>
        own.evaluate(() => JSON.parse(localStorage.getItem('rave.layout.Ada N.wide.Watch')).layout);
      server.run.components = [{name: 'heat', url: 'components/0/heat.js'}];
      await own.goto(server.origin);
      await own.locator('.dv-tab', {hasText: 'Heat map'}).waitFor();
      // Among the tabs of the log, where no layout of the page has it.
      await own
        .locator('.dv-tab', {hasText: 'Heat map'})
        .dragTo(own.locator('.dv-tab', {hasText: 'Log'}));
      await own
        .locator('.dv-groupview', {has: own.locator('.dv-tab', {hasText: 'Heat map'})})
        .locator('.dv-tab', {hasText: 'Log'})
        .waitFor();
      const before = Object.keys((await kept()).panels).sort();
      await own.reload();
      await own
        .locator('.dv-groupview', {has: own.locator('.dv-tab', {hasText: 'Heat map'})})
        .locator('.dv-tab', {hasText: 'Log'})
        .waitFor();
      await own.getByText('16 robots are warm').waitFor();
      assert.deepEqual(Object.keys((await kept()).panels).sort(), before);
      await own.locator('.dv-tab', {hasText: 'Hosts'}).click();
      await own.locator('.dv-tab', {hasText: 'Hosts'}).locator('.dv-default-tab-action').click();
      await own.locator('.dv-tab', {hasText: 'Hosts'}).waitFor({state: 'detached'});
      server.run.components = [];
      await own.reload();
      await until(own, `${app}?.model?.poses?.newest != null`);
      await own.locator('.dv-tab', {hasText: 'Heat map'}).waitFor({state: 'detached'});
      assert.equal(
        await own.locator('.dv-tab', {hasText: 'Hosts'}).count(),
        0,
        'what was closed stays closed',
      );
      assert.equal(await own.locator('.dv-tab', {hasText: 'World View'}).count(), 1);
      assert.deepEqual(errors, []);
      await own.close();
    },
  );
}
