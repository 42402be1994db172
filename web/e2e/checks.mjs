// SPDX-License-Identifier: Apache-2.0
// What tests of the page share.

/** For what comes on any machine, however busy it is: a test waits for the thing itself, and this
 * long only for what never comes. */
export const kPatience_ms = 120_000;

export const app = 'document.querySelector("rave-app")';

/** Waits until an expression of the page is true. Asked from outside: the page's policy forbids
 * eval. */
export async function until(page, expression, timeout_ms = kPatience_ms) {
  const end = Date.now() + timeout_ms;
  // A page that loads again, as it does when its server is another one, is asked once it is there.
  const holds = () =>
    page.evaluate(`Boolean(${expression})`).catch((error) => {
      if (/Execution context was destroyed/.test(error.message)) return false;
      throw error;
    });
  while (!(await holds())) {
    if (Date.now() > end) throw new Error(`never true: ${expression}`);
    await page.waitForTimeout(25);
  }
}

/** Waits until `holds()` of this process is true. */
export async function untilHere(page, holds, what, timeout_ms = kPatience_ms) {
  const end = Date.now() + timeout_ms;
  while (!holds()) {
    if (Date.now() > end) throw new Error(`never: ${what}`);
    await page.waitForTimeout(25);
  }
}

let passed = 0;
let failed = async () => {};

/** Takes a picture of the page when a check fails. */
export function showFailures(page, file) {
  failed = () => page.screenshot({path: file}).catch(() => {});
}

export async function check(name, act) {
  await act().catch(async (error) => {
    console.log(`not ok ${name}`);
    await failed(error);
    throw error;
  });
  ++passed;
  console.log(`ok ${name}`);
}

export function report() {
  console.log(`${passed} passed, 0 failed`);
}

/** Errors of the page, and requests to other places than `origin`. */
export function watch(page, origin) {
  const seen = {errors: [], foreign: []};
  page.on(
    'console',
    (message) =>
      message.type() === 'error' &&
      seen.errors.push(
        /Failed to load/.test(message.text())
          ? `${message.text()}: ${message.location().url}`
          : message.text(),
      ),
  );
  page.on('pageerror', (error) => seen.errors.push(String(error)));
  page.on('request', (request) => {
    if (!/^(data|blob):/.test(request.url()) && new URL(request.url()).origin !== origin)
      seen.foreign.push(request.url());
  });
  return seen;
}
