// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import {join} from 'node:path';
import {app, check, until} from '../checks.mjs';
import {stageBox, texts} from './look.mjs';

const world = "document.querySelector('rave-world')";

/** A box and the lens in 3-D, of a run that is held. `real`: slot of the robot around which the box
 * is drawn. */
export async function boxIn3d(page, real, folder) {
  await check('so they do in 3-D, without turning it, and Z goes to the top view', async () => {
    await page.keyboard.press('t');
    await until(page, `${world}.viewpoint().startsWith('3d')`);
    await page.evaluate(`${world}.fit(false)`);
    await page.evaluate(`${world}.paint()`);
    const looked = await page.evaluate(`${world}.viewpoint()`);
    const {left, top} = await stageBox(page);
    const places = await page.evaluate(
      `${app}.model.robots.map((_, slot) => ${world}.screenOf(slot))`,
    );
    const drag = async (box) => {
      await page.keyboard.down('Shift');
      await page.mouse.move(left + box[0], top + box[1]);
      await page.mouse.down();
      await page.mouse.move(left + box[2], top + box[3], {steps: 4});
      await page.screenshot({path: join(folder, 'box-3d.png')});
      await page.mouse.up();
      await page.keyboard.up('Shift');
    };
    const [x, y] = places[real];
    const box = [x - 90, y - 90, x + 90, y + 90];
    const inside = places.flatMap(([px, py], slot) =>
      px >= box[0] && px <= box[2] && py >= box[1] && py <= box[3] ? [slot] : [],
    );
    assert.ok(inside.length > 0 && inside.length < places.length, `${inside}`);
    await drag(box);
    assert.deepEqual(
      (await page.evaluate(`${app}.selection.slots`)).toSorted((a, b) => a - b),
      inside,
    );
    assert.equal(await page.evaluate(`${world}.viewpoint()`), looked);
    await page.keyboard.down('z');
    await until(page, `${world}.viewpoint().startsWith('top')`);
    await until(page, `${world}.top.lens.on`);
    assert.ok((await texts(page)).includes('Lens 3.5×  hold Z'));
    await page.keyboard.up('z');
    await until(page, `!${world}.top.lens.on`);
    await page.evaluate(`${app}.selection.set([${real}])`);
  });
}
