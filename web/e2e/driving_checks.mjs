// SPDX-License-Identifier: Apache-2.0
// A robot that is driven from the page: by the mouse, keys, a gamepad and pedals.
import assert from 'node:assert/strict';
import {join} from 'node:path';
import {check, untilHere} from './checks.mjs';
import {pressPad, setPad} from './hands.mjs';

async function checkMouse({page, server, stick, drive, stands, choose, folder}) {
  await check('the mouse drives, and letting go stops', async () => {
    await choose(page, 6);
    const box = await stick.boundingBox();
    const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move(x, y - box.height / 4, {steps: 3});
    await untilHere(
      page,
      () => drive()?.[1] > 0.2 && Math.abs(drive()[2]) < 0.05,
      'it goes forward',
    );
    assert.equal(drive()[0], 6);
    const before = server.run.driven.length;
    await untilHere(
      page,
      () => server.run.driven.length >= before + 10,
      'it is said again and again',
    );
    await page.screenshot({path: join(folder, 'drive.png')});
    await page.mouse.up();
    await stands('the mouse');
  });
}

async function checkAsked({page, folder}) {
  await check('the Robot panel shows what was asked beside what was driven', async () => {
    await page.evaluate(() => document.querySelector('rave-app').context.show('robot'));
    const plot = page.locator('rave-robot .trace');
    await plot.first().waitFor();
    assert.equal(await plot.count(), 2);
    await page
      .locator('rave-robot .trace')
      .first()
      .locator('polyline.asked')
      .first()
      .waitFor({state: 'attached'});
    await page.screenshot({path: join(folder, 'asked.png')});
  });
}

async function checkKeys({page, stick, drive, stands}) {
  await check('keys drive, and a page that is left stops', async () => {
    await stick.focus();
    await page.keyboard.down('w');
    await page.keyboard.down('a');
    await untilHere(
      page,
      () => drive()?.[1] > 0.1 && drive()[2] > 0.1,
      'it goes forward and turns left',
    );
    await page.keyboard.up('a');
    await page.keyboard.up('w');
    await stands('the keys');
    await page.keyboard.down('ArrowDown');
    await untilHere(page, () => drive()?.[1] < -0.1, 'it goes backwards');
    await page.evaluate(() => window.dispatchEvent(new Event('blur')));
    await stands('a blur');
    await page.keyboard.up('ArrowDown');
    await page.locator('rave-world .canvas').focus();
    await page.keyboard.down('Shift');
    await page.keyboard.down('ArrowUp');
    await untilHere(page, () => drive()?.[1] > 0.1, 'Shift and an arrow from anywhere');
    await page.keyboard.up('Shift');
    await page.keyboard.up('ArrowUp');
    await stands('Shift and an arrow');
  });
}

async function checkGamepad({page, drive, stands}) {
  await check('a gamepad drives while its stick is moved', async () => {
    await setPad(page, 0.02, 0.03);
    await page.waitForTimeout(100);
    await setPad(page, -0.5, -0.8);
    await untilHere(page, () => drive()?.[1] > 0.2 && drive()[2] > 0.2, 'it drives');
    await setPad(page, 0, 0.05);
    await stands('the gamepad');
    await setPad(page, 0, -0.8);
    await untilHere(page, () => drive()?.[1] > 0.2, 'it drives again');
    await page.evaluate(() => window.dispatchEvent(new Event('blur')));
    await stands('a blur, with the stick of the gamepad held');
    await setPad(page, 0, 0);
    await page.waitForTimeout(100);
  });
}

async function checkPedals({page, server, drive, stands, folder}) {
  await check(
    'pedals drive: gear, throttle, steering and brake, by mouse, keys and triggers',
    async () => {
      await page.evaluate(() => {
        window.padAxes = null;
      });
      await page.getByRole('radio', {name: 'Pedals'}).click();
      const car = page.locator('rave-joystick .car');
      const throttle = await car.locator('[data-control=throttle]').boundingBox();
      const half = [throttle.x + throttle.width / 2, throttle.y + throttle.height / 2];
      const count = server.run.driven.length;
      await page.mouse.move(...half);
      await page.mouse.down();
      await page.waitForTimeout(150);
      await page.mouse.up();
      assert.equal(server.run.driven.length, count, 'neutral moves nothing');
      await car.getByRole('radio', {name: 'Forward'}).click();
      await page.mouse.move(...half);
      await page.mouse.down();
      await untilHere(
        page,
        () => Math.abs((drive()?.[1] ?? 0) - 0.2) < 0.05 && server.run.driven.length > count,
        'half throttle',
      );
      await page.keyboard.down('d');
      await untilHere(page, () => drive()[2] < -0.5, 'it turns right');
      await page.screenshot({path: join(folder, 'pedals.png')});
      await page.keyboard.down('s');
      await untilHere(page, () => drive()[1] === 0, 'the brake goes before the throttle');
      await page.keyboard.up('s');
      await page.keyboard.up('d');
      await page.mouse.up();
      await stands('the pedals');
      await car.getByRole('radio', {name: 'Reverse'}).click();
      await pressPad(page, {7: 1});
      await untilHere(page, () => drive()[1] < -0.3, 'the trigger drives backwards');
      await page.evaluate(() => window.dispatchEvent(new Event('blur')));
      await stands('a blur, with the trigger pressed');
      await pressPad(page, {});
      await page.waitForTimeout(100);
      await pressPad(page, {5: 1});
      await page
        .locator('rave-joystick')
        .getByRole('radio', {name: 'Forward', checked: true})
        .waitFor();
      await page.evaluate(() => {
        window.padAxes = null;
      });
      await page.getByRole('radio', {name: 'Stick'}).click();
      await page.locator('rave-joystick .stick').waitFor();
    },
  );
}

/** Radius of the arc in the dial; null: there is none. */
const arcOf = (page) =>
  page.evaluate(() => {
    const d = document
      .querySelector('rave-joystick')
      .renderRoot.querySelector('.dial .guard')
      ?.getAttribute('d');
    return d === undefined ? null : Number(d.split(' A ')[1].split(' ')[0]);
  });

async function checkGuard({page, server, drive, stands, choose, folder}) {
  await check(
    'the limit of the guard is an arc in the dial, as wide as what it lets through, and the Robot panel says why',
    async () => {
      const {run} = server;
      await choose(page, 6);
      assert.equal(await arcOf(page), null, 'nothing is held back');
      // An event alone, and the speed that is driven: 0.2 of 0.4 m/s.
      const event = {
        t: run.now_s,
        until: run.now_s + 60,
        count: 4,
        kind: 'guard slowed',
        level: 'warn',
        text: 'walker-2: crate 0.31 m ahead',
        slots: [6],
      };
      run.events.push(event);
      server.say({type: 'events', reset: false, first: run.events.length - 1, events: [event]});
      await setPad(page, 0, -1);
      await untilHere(page, () => drive()?.[1] > 0.35, 'it is asked for more');
      const arc = page.locator('rave-joystick .dial .guard');
      await arc.waitFor({state: 'attached'});
      const half = await arcOf(page);
      assert.ok(Math.abs(half - 43) < 2, `an arc of ${half}`);
      await page.locator('rave-joystick .guarded').getByText('crate 0.31 m ahead').waitFor();
      assert.match(await page.locator('rave-joystick .guarded').innerText(), /guard 0\.20 m\/s/);
      await page.locator('rave-robot .guard').getByText('crate 0.31 m ahead').waitFor();
      // What the host tells goes before what can be guessed.
      run.told.set(6, [0.4, 0, 0.1, 0]);
      await page.locator('rave-robot .guard', {hasText: '0.10 m/s'}).waitFor();
      assert.ok((await arcOf(page)) < 30, 'the arc is narrower');
      await page.screenshot({path: join(folder, 'guard.png')});
      run.told.set(6, [0.4, 0, 0.4, 0]);
      await arc.waitFor({state: 'detached'});
      await page
        .locator('rave-robot')
        .getByText(/Lets it drive\. \d+ s ago: crate 0\.31 m ahead/)
        .waitFor();
      await setPad(page, 0, 0);
      await stands('the guard');
      run.told.delete(6);
      event.until = event.t;
      server.say({type: 'events', reset: true, first: 0, events: run.events});
      await page.evaluate(() => {
        window.padAxes = null;
      });
    },
  );
}

/** What drives, against a made-up run. Further checks of driving may use what it returns. */
export async function checkDriving(page, server, choose, folder) {
  await page.getByRole('radio', {name: 'Drive'}).click();
  await page.waitForTimeout(500);
  const stick = page.locator('rave-joystick .stick');
  const drive = () => server.run.driven.at(-1);
  const stands = async (what, of = page) => {
    await untilHere(of, () => drive()?.[1] === 0 && drive()?.[2] === 0, `it stands after ${what}`);
    const count = server.run.driven.length;
    await of.waitForTimeout(150);
    assert.equal(server.run.driven.length, count, `nothing comes after ${what}`);
  };

  const at = {page, server, stick, drive, stands, choose, folder};
  await checkMouse(at);
  await checkAsked(at);
  await checkKeys(at);
  await checkGamepad(at);
  await checkGuard(at);
  await checkPedals(at);
  return {stick, drive, stands};
}
