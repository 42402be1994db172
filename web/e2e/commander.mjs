// SPDX-License-Identifier: Apache-2.0
// What a commander does with a robot on the page, for tests with real runs.
import {app, until} from './checks.mjs';
import {clickAt} from './hands.mjs';

export const newest = `${app}.model.poses.newest`;
export const speed = (slot) => `Math.abs(${newest}.speed[${slot}])`;
export const happened = (kind, text) => `${app}.model.events.some((event) => event.kind === '${kind}' && event.text.includes('${text}'))`;

export const slotOf = (page, name) => page.evaluate(`${app}.model.robots.findIndex((robot) => robot.name === '${name}')`);
export const placeOf = (page, slot) => page.evaluate(`[${newest}.x[${slot}], ${newest}.y[${slot}]]`);
export const choose = (page, slot) => page.evaluate((what) => document.querySelector('rave-app').selection.set([what]), slot);
/** Waits until a robot is near a place. */
export const near = (page, slot, x, y, m) => until(page, `Math.hypot(${newest}.x[${slot}] - ${x}, ${newest}.y[${slot}] - ${y}) < ${m}`, 30000);

/** Sends a robot to a place by a click and waits until it is there. */
export async function sendByClick(page, name, x, y) {
  const slot = await slotOf(page, name);
  await choose(page, slot);
  await page.keyboard.press('g');
  await clickAt(page, x, y);
  await until(page, happened('ordered', `goal`));
  await near(page, slot, x, y, 0.3);
  await page.keyboard.press('v');
}

/** Drives a robot by the mouse on the stick; it stands when the mouse lets go. `still_mps`: what the measured speed of one that stands may be. */
export async function driveByMouse(page, name, still_mps = 0.001) {
  const slot = await slotOf(page, name);
  await choose(page, slot);
  await page.getByRole('radio', {name: 'Drive'}).click();
  await page.waitForTimeout(300);
  const before = await placeOf(page, slot);
  const box = await page.locator('rave-joystick .stick').boundingBox();
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x, y - box.height / 4, {steps: 3});
  await until(page, `Math.hypot(${newest}.x[${slot}] - ${before[0]}, ${newest}.y[${slot}] - ${before[1]}) > 0.1`);
  await until(page, `${speed(slot)} > 0.05`);
  await page.mouse.up();
  await until(page, `${speed(slot)} < ${still_mps}`, 3000);
}
