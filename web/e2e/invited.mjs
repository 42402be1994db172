// SPDX-License-Identifier: Apache-2.0
// People who follow the links that `rave run` prints for the users of a scenario.
import {launch} from './browser.mjs';
import {app, showFailures, until} from './checks.mjs';
import {newest} from './commander.mjs';
import {touch} from './hands.mjs';

/** The link of a person in what a terminal said. */
export const linkIn = (said, name) => new RegExp(`^${name} +(\\S+)`, 'm').exec(said)?.[1];

/** Somebody with a browser of their own, who follows the link of the terminal, and every text that
 * the server sent them. */
export async function invited(server, name, robots, failure) {
  const browser = await launch();
  const context = await browser.newContext({viewport: {width: 1400, height: 900}});
  const page = await context.newPage();
  const texts = [];
  page.on('websocket', (socket) =>
    socket.on('framereceived', ({payload}) => typeof payload === 'string' && texts.push(payload)),
  );
  showFailures(page, failure);
  await page.goto(linkIn(server.said(), name));
  await page.getByRole('button', {name: 'Join'}).click();
  await touch(page);
  await until(page, `${app}?.model?.robots?.length === ${robots} && ${newest} != null`);
  const cookie = (await context.cookies()).map((kept) => `${kept.name}=${kept.value}`).join('; ');
  const heard = (text) => texts.filter((line) => line.includes(text));
  return {name, browser, page, heard, cookie};
}

/** Sends a robot to a place in the way of a page: the answer of who has it. */
export const goal = ({page}, slot, point) =>
  page.evaluate(
    ([to, at]) => document.querySelector('rave-app').commands.goal([to], [at]),
    [slot, point],
  );
