// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import {join} from 'node:path';
import {app, check, until} from '../checks.mjs';
import {hold, layer, openLayers, settled, switches} from './layer_hands.mjs';
import {differ, keep, texts} from './look.mjs';

const world = "document.querySelector('rave-world')";

/** More than 200 robots: arrowheads, density, plates, histograms. */
export async function crowdChecks({page, folder}) {
  await until(page, `${app}.model.poses.past.length > 6`);
  await hold(page);

  await check(
    'a crowd is seen from afar: arrowheads, density, plates of teams, a small map',
    async () => {
      assert.ok(!(await page.evaluate(`${world}.top.swarm.empty`)));
      const shown = await texts(page);
      assert.ok(
        shown.some((text) => /^north/.test(text)) &&
          shown.some((text) => /150 · 0\.\d\d m\/s/.test(text)),
        `${shown}`,
      );
      assert.ok(!shown.includes('north-1'), 'no names of a crowd');
      await openLayers(page);
      for (const [name, least] of [
        ['Density of crowds', 200],
        ['Small map', 1000],
        ['Trails', 60],
      ])
        await switches(page, name, least);
      await page.screenshot({path: join(folder, 'crowd.png')});
    },
  );

  await check('near enough each of them is an outline with its name', async () => {
    const at = await page.evaluate(
      `(() => { const {placed} = ${world}; return [placed.x[5], placed.y[5]]; })()`,
    );
    const before = await page.evaluate(`${world}.viewpoint()`);
    await page.evaluate(`${world}.lookFrom('top,${at[0]},${at[1]},120')`);
    await settled(page);
    assert.ok(await page.evaluate(`${world}.top.swarm.empty`));
    const name = await page.evaluate(`${app}.model.robots[5].name`);
    assert.ok((await texts(page)).includes(name), name);
    await page.evaluate(`${world}.lookFrom('${before}')`);
    await settled(page);
  });

  await check('colour by team tints the crowd, and the legend has its scale', async () => {
    await keep(page);
    await page.getByRole('combobox', {name: 'Colour by'}).selectOption('team');
    assert.ok((await differ(page)) > 2000);
    await page.locator('rave-world .ramp').getByText('south').waitFor();
    await page.getByRole('combobox', {name: 'Colour by'}).selectOption('kind');
    assert.equal(await differ(page), 0);
  });

  await check('a team of many is a histogram of speeds, with rows on demand', async () => {
    const robots = page.locator('rave-robots');
    assert.equal(await robots.getByRole('img', {name: /^Speeds from 0 to/}).count(), 3);
    assert.equal(await robots.locator('.row').count(), 0);
    assert.ok((await robots.locator('.team.many rect').count()) > 10);
    await robots.locator('.team.many', {hasText: 'south'}).click();
    await robots.locator('.row', {hasText: 'south-1'}).first().waitFor();
  });
}

/** One robot of the crowd is not sure where it is. */
export async function varianceCheck({page, slot, folder}) {
  await check(
    'how sure a robot is needs no reading: the ellipse is there without scans, in both views',
    async () => {
      const anna = await slot('anna');
      await page.getByRole('combobox', {name: 'Scans'}).selectOption('off');
      await page.evaluate(`${app}.selection.set([${anna}])`);
      await until(page, `${app}.model.variances.get(${anna})?.xy_m2 > 0.05`);
      await page.evaluate(`${world}.lookFrom('top,0,0,90')`);
      await settled(page);
      await switches(page, 'Uncertainty of reported poses', 3000);
      await page.screenshot({path: join(folder, 'variance-top.png')});
      await page.evaluate(`${world}.lookFrom('3d,0,0,6,-1.8,0.7')`);
      await until(page, `${world}.viewpoint().startsWith('3d')`);
      await settled(page);
      await switches(page, 'Uncertainty of reported poses', 1000);
      await page.screenshot({path: join(folder, 'variance-3d.png')});
      await layer(page, 'Uncertainty of reported poses').click();
      await until(page, `!${app}.model.variances.has(${anna})`);
    },
  );
}
