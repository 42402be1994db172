// SPDX-License-Identifier: Apache-2.0
// What a person does with mouse, finger, pen and gamepad, for tests of the page.
import {until} from './checks.mjs';

const kWorld =
  "(document.querySelector('rave-world') ?? document.querySelector('rave-app').renderRoot.querySelector('rave-world'))";

/** Where a place of the world is on the page. */
export async function placeOf(page, x, y) {
  return page.evaluate(`(() => {
    const world = ${kWorld};
    const box = world.renderRoot.querySelector('.canvas').getBoundingClientRect();
    const [px, py] = world.stage.screenAt(${x}, ${y});
    return [box.left + px, box.top + py];
  })()`);
}

/** A place of the world with nobody within `clear_m`, near the middle of the picture. */
export async function freePlace(page, clear_m = 0.6) {
  return page.evaluate(`(() => {
    const world = ${kWorld};
    const {camera} = world.stage;
    const {placed} = world;
    const bodies = [...document.querySelector('rave-app').model.bodies.values()];
    const taken = [...Array.from(placed.x, (x, i) => [x, placed.y[i]]), ...bodies.filter((body) => body.kind === 'virtual').map((body) => body.pose)];
    for (let i = 0; i < 2000; ++i) {
      const r = 0.02 * i * 90 / camera.scale;
      const [x, y] = [camera.x + r * Math.cos(i * 2.4), camera.y + r * Math.sin(i * 2.4)];
      if (taken.every(([ox, oy]) => Math.hypot(ox - x, oy - y) > ${clear_m})) return [x, y];
    }
    throw new Error('no free place');
  })()`);
}

/** A first click, on nothing. A page that was opened just before its hosts loads itself anew, but not
 * once a person has touched it: what comes after this is not lost in such a load. */
export async function touch(page) {
  await page.locator('rave-app .brand').first().click();
  await until(
    page,
    "performance.timeOrigin >= Number(sessionStorage.getItem('rave.reloaded') ?? 0)",
  );
}

export async function clickAt(page, x, y, options = {}) {
  await page.mouse.click(...(await placeOf(page, x, y)), options);
}

/** A drag through places of the world. */
export async function dragThrough(page, places) {
  const points = [];
  for (const [x, y] of places) points.push(await placeOf(page, x, y));
  await page.mouse.move(...points[0]);
  await page.mouse.down();
  for (const point of points.slice(1)) await page.mouse.move(...point, {steps: 6});
  await page.mouse.up();
}

/** A finger or a pen through points of the page; without `lift` it stays down. */
export class Hand {
  constructor(page, kind) {
    this.page = page;
    this.kind = kind;
  }

  async send(type, [x, y]) {
    this.client ??= await this.page.context().newCDPSession(this.page);
    if (this.kind === 'touch') {
      const word = {down: 'touchStart', move: 'touchMove', up: 'touchEnd'}[type];
      await this.client.send('Input.dispatchTouchEvent', {
        type: word,
        touchPoints: type === 'up' ? [] : [{x, y}],
      });
      return;
    }
    const word = {down: 'mousePressed', move: 'mouseMoved', up: 'mouseReleased'}[type];
    await this.client.send('Input.dispatchMouseEvent', {
      type: word,
      x,
      y,
      button: 'left',
      buttons: type === 'up' ? 0 : 1,
      clickCount: 1,
      pointerType: 'pen',
    });
  }

  async drag(points, lift = true) {
    await this.send('down', points[0]);
    for (let i = 1; i < points.length; ++i) {
      for (let k = 1; k <= 5; ++k) {
        const share = k / 5;
        await this.send(
          'move',
          [0, 1].map(
            (axis) => points[i - 1][axis] + share * (points[i][axis] - points[i - 1][axis]),
          ),
        );
      }
    }
    if (lift) await this.send('up', points[points.length - 1]);
  }

  async press(point, hold_ms) {
    await this.send('down', point);
    await this.page.waitForTimeout(hold_ms);
    await this.send('up', point);
  }
}

/** A gamepad that nobody has plugged in: `setPad(page, x, y)` moves its stick, y down. */
export async function stubPad(context) {
  await context.addInitScript(() => {
    window.padAxes = null;
    navigator.getGamepads = () =>
      window.padAxes === null
        ? []
        : [
            {
              id: 'Test pad',
              connected: true,
              axes: window.padAxes,
              buttons: window.padButtons ?? [],
            },
          ];
  });
}
/** Presses buttons of it, by number, to a share from 0 to 1. */
export const pressPad = (page, shares) =>
  page.evaluate((by) => {
    window.padAxes ??= [0, 0];
    window.padButtons = Array.from({length: 16}, (_, i) => ({
      pressed: (by[i] ?? 0) > 0.5,
      value: by[i] ?? 0,
    }));
  }, shares);
export const setPad = (page, x, y) =>
  page.evaluate(
    ([ax, ay]) => {
      window.padAxes = [ax, ay];
    },
    [x, y],
  );
