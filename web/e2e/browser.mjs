// SPDX-License-Identifier: Apache-2.0
// Debian's Chromium for tests, and `rave gui` in a process of its own.
import {spawn} from 'node:child_process';
import {chromium} from 'playwright-core';

/** Headless Chromium with software WebGL. */
export function launch() {
  return chromium.launch({
    executablePath: process.env.RAVE_CHROMIUM ?? '/usr/bin/chromium',
    args: ['--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'],
  });
}

/** Waits until an expression of the page is true. Asked from outside: the page's policy forbids eval. */
export async function until(page, expression, timeout_ms = 20000) {
  const end = Date.now() + timeout_ms;
  while (!(await page.evaluate(`Boolean(${expression})`))) {
    if (Date.now() > end) throw new Error(`never true: ${expression}`);
    await page.waitForTimeout(25);
  }
}

/** Counts checks, and says which one has passed. */
export class Checks {
  passed = 0;

  async check(name, act) {
    await act();
    ++this.passed;
    console.log(`ok ${name}`);
  }

  end() {
    console.log(`${this.passed} passed, 0 failed`);
  }
}

/**
 * Starts a process that serves the page (`gui RECORDING`, `run SCENARIO --gui`) and waits for its link.
 * `end()` stops it and gives its exit code; `exited` is that code, `text()` what it has printed.
 */
export async function startServer(rave, words) {
  const port = words.includes('--port') ? [] : ['--port', '0'];
  const child = spawn(rave, [...words, '--no-open', ...port], {stdio: ['ignore', 'pipe', 'inherit']});
  let text = '';
  const exited = new Promise((resolve) => child.once('exit', resolve));
  const link = await new Promise((resolve, reject) => {
    child.stdout.on('data', (data) => {
      text += data;
      const found = /http:\S+/.exec(text);
      if (found) resolve(found[0]);
    });
    exited.then((code) => reject(new Error(`rave ${words[0]} ended with ${code}: ${text}`)));
  });
  return {
    link,
    child,
    exited,
    text: () => text,
    end: () => {
      child.kill('SIGTERM');
      return exited;
    },
  };
}
