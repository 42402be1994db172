// SPDX-License-Identifier: Apache-2.0
// Debian's Chromium and Firefox for tests, and `rave gui` in a process of its own.
import {spawn} from 'node:child_process';
import playwright, {chromium} from 'playwright-core';
import {kPatience_ms} from './checks.mjs';

/** Headless Chromium as a machine without a graphics card runs it: pages are drawn by the
 * processor, and WebGL by SwiftShader. With `--use-angle=swiftshader` the whole page would go
 * through an emulated card, which takes twenty times as long. */
const kChromium = {
  executablePath: process.env.RAVE_CHROMIUM ?? '/usr/bin/chromium',
  args: ['--no-sandbox', '--enable-unsafe-swiftshader'],
};

export async function launch(...args) {
  const browser = await chromium.launch({...kChromium, args: [...kChromium.args, ...args]});
  const make = browser.newContext.bind(browser);
  browser.newContext = async (options) => {
    const context = await make(options);
    context.setDefaultTimeout(kPatience_ms);
    return context;
  };
  return browser;
}

/** One whose processes, all of one group, can be sent a signal. */
export async function launchServed() {
  const server = await chromium.launchServer(kChromium);
  const {pid} = server.process();
  return {
    browser: await chromium.connect(server.wsEndpoint()),
    signal: (name) => {
      try {
        process.kill(-pid, name);
      } catch (error) {
        // It is gone already.
        if (error.code !== 'ESRCH') throw error;
      }
    },
  };
}

export const whereFirefox = process.env.RAVE_FIREFOX ?? '/usr/bin/firefox-esr';

/** Debian's Firefox through WebDriver BiDi: the Firefox that Playwright would drive otherwise is a
 * build of its own. */
export function launchFirefox() {
  return playwright._bidiFirefox.launch({executablePath: whereFirefox, headless: true});
}

/** Waits until the policy of the page lists `hosts` hosts of a run in real time. A page that comes
 * earlier is refused their lines, and loads again. */
export async function knowsHosts(link, hosts, timeout_ms = 30000) {
  const policy = async () =>
    (await (
      await fetch(new URL('/', link), {redirect: 'manual'})
    ).headers.get('content-security-policy')) ?? '';
  const end = Date.now() + timeout_ms;
  for (let last = ''; (last.match(/wss?:\/\/127/g) ?? []).length < hosts; last = await policy()) {
    if (Date.now() > end) throw new Error(`never ${hosts} hosts in the policy: ${last}`);
    await new Promise((resolve) => setTimeout(resolve, 25));
  }
}

/**
 * Starts a process that serves the page (`gui RECORDING`, `run SCENARIO --gui`) and waits for its link.
 * `options` are those of spawn(). `end()` stops it and gives its exit code.
 */
export async function startServer(rave, words, options = {}) {
  // Another page than the one that was built with the program, while the page is worked on.
  const page = process.env.RAVE_PAGE ? ['--page', process.env.RAVE_PAGE] : [];
  const port = words.includes('--port') ? [] : ['--port', '0'];
  const child = spawn(rave, [...words, '--no-open', ...port, ...page], {
    stdio: ['ignore', 'pipe', 'inherit'],
    ...options,
  });
  let text = '';
  const exited = new Promise((resolve) => child.once('exit', resolve));
  const link = await new Promise((resolve, reject) => {
    child.stdout.on('data', (data) => {
      text += data;
      const found = /https?:\S+/.exec(text);
      if (found) resolve(found[0]);
    });
    exited.then((code) => reject(new Error(`rave ended with ${code}: ${text}`)));
  });
  return {
    link,
    child,
    /** What it has printed so far. */
    said: () => text,
    end: () => {
      child.kill('SIGTERM');
      return exited;
    },
  };
}
