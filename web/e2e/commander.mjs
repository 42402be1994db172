// SPDX-License-Identifier: Apache-2.0
// What a commander does with a robot on the page, for tests with real runs.
import {app, until} from './checks.mjs';
import {clickAt, Hand} from './hands.mjs';

export const newest = `${app}.model.poses.newest`;
export const speed = (slot) => `Math.abs(${newest}.speed[${slot}])`;
export const happened = (kind, text) =>
  `${app}.model.events.some((event) => event.kind === '${kind}' && event.text.includes('${text}'))`;

export const slotOf = (page, name) =>
  page.evaluate(`${app}.model.robots.findIndex((robot) => robot.name === '${name}')`);
export const placeOf = (page, slot) =>
  page.evaluate(`[${newest}.x[${slot}], ${newest}.y[${slot}]]`);
export const choose = (page, slot) =>
  page.evaluate((what) => document.querySelector('rave-app').selection.set([what]), slot);
/** Waits until a robot is near a place. */
export const near = (page, slot, x, y, m) =>
  until(page, `Math.hypot(${newest}.x[${slot}] - ${x}, ${newest}.y[${slot}] - ${y}) < ${m}`);

const world = "document.querySelector('rave-world')";

/** Waits until an expression has been the same in three pictures, one after the other. */
export async function standsStill(page, expression) {
  for (let same = 0, last = ''; same < 3; ) {
    const now = await page.evaluate(
      `new Promise((done) => requestAnimationFrame(() => done(JSON.stringify(${expression}))))`,
    );
    same = now === last ? same + 1 : 0;
    last = now;
  }
}

/** Sends a robot to a place by a click and waits until it is there. */
export async function sendByClick(page, name, x, y) {
  const slot = await slotOf(page, name);
  // Before, the picture still fits itself to who comes, and the place would be elsewhere.
  await until(page, `${newest}.flags.every((flags) => flags & 1)`);
  await standsStill(page, `[${world}.viewpoint(), ${world}.clientWidth, ${world}.clientHeight]`);
  await choose(page, slot);
  await page.keyboard.press('g');
  await clickAt(page, x, y);
  await until(page, happened('ordered', `goal`));
  await near(page, slot, x, y, 0.3);
  await page.keyboard.press('v');
}

/** Opens the stick of a robot: where it is on the page, and the robot in the world. */
async function atStick(page, name) {
  const slot = await slotOf(page, name);
  await choose(page, slot);
  await page.getByRole('radio', {name: 'Drive'}).click();
  await page.locator('rave-joystick .stick').waitFor();
  await standsStill(
    page,
    `(() => { const {x, y, width} = ${app}.joystick.renderRoot.querySelector('.stick').getBoundingClientRect(); return [x, y, width]; })()`,
  );
  return {
    slot,
    before: await placeOf(page, slot),
    box: await page.locator('rave-joystick .stick').boundingBox(),
  };
}

/** Waits until a robot has left its place and is on its way. */
async function goes(page, slot, [x, y]) {
  await until(page, `Math.hypot(${newest}.x[${slot}] - ${x}, ${newest}.y[${slot}] - ${y}) > 0.1`);
  await until(page, `${speed(slot)} > 0.05`);
}

/** Drives a robot by the mouse on the stick; it stands when the mouse lets go. `still_mps`: what
 * the measured speed of one that stands may be. */
export async function driveByMouse(page, name, still_mps = 0.001) {
  const {slot, box, before} = await atStick(page, name);
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x, y - box.height / 4, {steps: 3});
  await goes(page, slot, before);
  await page.mouse.up();
  await until(page, `${speed(slot)} < ${still_mps}`);
}

/** Drives a robot by a finger or a pen on the stick, which stands when it is lifted. */
export async function driveByHand(page, name, kind) {
  const {slot, box, before} = await atStick(page, name);
  const hand = new Hand(page, kind);
  const middle = [box.x + box.width / 2, box.y + box.height / 2];
  await hand.drag([middle, [middle[0], middle[1] - box.height / 4]], false);
  await goes(page, slot, before);
  await hand.send('up', middle);
  await until(page, `${speed(slot)} < 0.001`);
}

/** Drives a robot by keys on the stick. */
export async function driveByKeys(page, name, key = 'w') {
  const {slot, before} = await atStick(page, name);
  await page.locator('rave-joystick .stick').focus();
  await page.keyboard.down(key);
  await goes(page, slot, before);
  await page.keyboard.up(key);
  await until(page, `${speed(slot)} < 0.001`);
}

/** Holds the stick of a robot by a gamepad that is never quite still: a mouse moves when the
 * browser draws, and that is seldom on a machine without a graphics card. The robot goes on until
 * the page is gone, or `dropStick`. */
export async function holdStick(page, robot, least_mps = 0.05) {
  const slot = await slotOf(page, robot);
  await choose(page, slot);
  await page.getByRole('radio', {name: 'Drive'}).click();
  await page.locator('rave-joystick .stick').waitFor();
  await page.evaluate(() => {
    navigator.getGamepads = () => [
      {
        id: 'Test pad',
        connected: true,
        axes: [0, -0.5 - 0.3 * ((performance.now() / 97) % 1)],
        buttons: [],
      },
    ];
  });
  await until(page, `${speed(slot)} > ${least_mps}`);
}
export const dropStick = (page) =>
  page.evaluate(() => {
    navigator.getGamepads = () => [];
  });

/** Holds a button until it has acted, which takes it away or changes it. */
export async function holdDown(page, button) {
  await button.hover();
  await page.mouse.down();
  await button.waitFor({state: 'detached'});
  await page.mouse.up();
}
