// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import {join} from 'node:path';
import {check, showFailures, untilHere} from './checks.mjs';
import {freePlace, Hand, placeOf} from './hands.mjs';

/** Orders and the stick by finger and pen, on a small screen. */
export async function checkHand(at) {
  const {name, width, height, browser, server, folder, opened, choose, heard, seriousOf} = at;
  await check(
    `${name}: long press opens the menu, a drag draws a path, finger and pen drive`,
    async () => {
      server.run.components = [];
      server.run.state = 'paused';
      const small = await browser.newContext({
        viewport: {width, height},
        hasTouch: true,
        isMobile: true,
      });
      const hand = await opened(small);
      showFailures(hand, join(folder, `failure-${name}.png`));
      const stop = await hand.locator('rave-stop .stop').boundingBox();
      assert.deepEqual([stop.width, stop.height], name === 'pen' ? [132, 64] : [140, 60]);
      await choose(hand, 6);
      const finger = new Hand(hand, 'touch');
      const place = await placeOf(hand, ...(await freePlace(hand, 0.5)));
      await finger.press(place, 600);
      await hand.locator('rave-ring').getByRole('menuitem', {name: 'Goal'}).waitFor();
      await hand.screenshot({path: join(folder, `${name}-ring.png`)});
      const goals = heard('order', 'goal').length;
      await hand.locator('rave-ring').getByRole('menuitem', {name: 'Goal'}).tap();
      await hand.touchscreen.tap(...place);
      await hand.locator('rave-world .beside.draft').waitFor();
      assert.equal(heard('order', 'goal').length, goals, 'a finger looks before it sends');
      await hand.locator('rave-world .beside.draft').getByRole('button', {name: 'Send'}).tap();
      await untilHere(hand, () => heard('order', 'goal').length === goals + 1, 'the goal is sent');
      await hand.evaluate(() =>
        document
          .querySelector('rave-app')
          .renderRoot.querySelector('rave-world')
          .chooseTool('select'),
      );
      const paths = heard('order', 'path').length;
      const pen = new Hand(hand, 'pen');
      const send = hand.locator('rave-world .beside.draft').getByRole('button', {name: 'Send'});
      // On a busy machine a pen may stand still for so long that it is a long press: again then.
      for (let tries = 0; tries < 5 && !(await send.isVisible()); ++tries) {
        if (tries > 0) await hand.keyboard.press('Escape');
        await choose(hand, 6);
        const [x, y] = await placeOf(hand, ...(await freePlace(hand, 0.5)));
        await pen.drag([
          [x, y],
          [x + 40, y - 50],
          [x + 80, y],
        ]);
        await send.waitFor({timeout: 5000}).catch(() => {});
      }
      await send.tap();
      await untilHere(hand, () => heard('order', 'path').length === paths + 1, 'the path is sent');
      await driveByHand(hand, finger, pen, at);
      assert.deepEqual(await seriousOf(hand), []);
      await small.close();
    },
  );
}

async function driveByHand(hand, finger, pen, {name, folder, drive, stands}) {
  await hand.evaluate(() => document.querySelector('rave-app').showPanel('joystick'));
  const box = await hand.locator('rave-joystick .stick').boundingBox();
  assert.ok(box.width >= 130, `a stick of ${box.width} px`);
  const middle = [box.x + box.width / 2, box.y + box.height / 2];
  await finger.drag([middle, [middle[0], middle[1] - box.height / 4]], false);
  await untilHere(hand, () => drive()?.[1] > 0.1, 'a finger drives');
  await hand.screenshot({path: join(folder, `${name}-stick.png`)});
  await finger.send('up', middle);
  await stands('the finger', hand);
  await pen.drag([middle, [middle[0], middle[1] + box.height / 4]], false);
  await untilHere(hand, () => drive()?.[1] < -0.1, 'a pen drives');
  await pen.send('up', middle);
  await stands('the pen', hand);
}
