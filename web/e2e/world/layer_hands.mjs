// SPDX-License-Identifier: Apache-2.0
// What tests do with the layers of the World View.
import assert from 'node:assert/strict';
import {app, until} from '../checks.mjs';
import {differ, keep} from './look.mjs';

/** Holds the run, so that pictures differ only by what the test does. */
export async function hold(page) {
  await page.evaluate(`${app}.link.send({type: 'transport', do: 'pause'})`);
  await until(page, `${app}.model.time.state === 'paused'`);
  await settled(page);
}

/** Until two pictures in a row are the same. */
export async function settled(page) {
  for (let same = 0; same < 3; same = (await differ(page)) === 0 ? same + 1 : 0) {
    await keep(page);
    await page.waitForTimeout(60);
  }
}

export const layer = (page, name) => page.getByRole('switch', {name});
export const openLayers = async (page) => {
  if ((await layer(page, 'Names').count()) === 0)
    await page.getByRole('button', {name: 'Layers'}).click();
};

/** A switch of the menu takes so many pixels out of the picture at least, and brings them back. */
export async function switches(page, name, least) {
  await keep(page);
  await layer(page, name).click();
  const gone = await differ(page);
  assert.ok(gone >= least, `${name}: ${gone} pixels`);
  await layer(page, name).click();
  // What the layer needs may have to come again.
  let left = await differ(page);
  for (
    const end = Date.now() + 20000;
    left >= least / 4 && Date.now() < end;
    left = await differ(page)
  )
    await page.waitForTimeout(25);
  assert.ok(left < least / 4, `${name} came back but for ${left} pixels`);
}
