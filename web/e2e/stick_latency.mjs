// SPDX-License-Identifier: Apache-2.0
// From an event of the joystick in headless Chromium to the input of the actuator's driver, by a
// direct line: RAVE_PAGE=PAGE node stick_latency.mjs RAVE [--trials 200] [--rounds 3]. Prints one
// line of JSON. The time counts from the time stamp that the browser gives to a key until the page
// has the answer of the host that the drive counts from this step on; the driver gets it in that
// step. So the way back of the answer is in it, too.
import {execFileSync, spawn} from 'node:child_process';
import {mkdtempSync, rmSync} from 'node:fs';
import {loadavg, tmpdir} from 'node:os';
import {dirname, join} from 'node:path';
import {fileURLToPath} from 'node:url';
import {knowsHosts, launch, startServer} from './browser.mjs';
import {app, until} from './checks.mjs';
import {choose, newest, slotOf} from './commander.mjs';

const [rave, ...words] = process.argv.slice(2);
const option = (name, usual) =>
  words.includes(`--${name}`) ? Number(words[words.indexOf(`--${name}`) + 1]) : usual;
const [trials, rounds] = [option('trials', 200), option('rounds', 3)];
const scenario = join(dirname(fileURLToPath(import.meta.url)), 'alone/scenario.yaml');
const folder = mkdtempSync(join(tmpdir(), 'rave-stick-'));
const key = join(folder, 'line');
const bus = ['--run', `stick-${process.pid}`];
execFileSync(rave, ['keys', 'line', key], {stdio: 'ignore'});
const children = ['left', 'right'].map((host) =>
  spawn(
    rave,
    [
      'robot',
      scenario,
      '--host',
      host,
      '--web',
      '127.0.0.1:0',
      '--web-key',
      `${key}.pub`,
      '--quiet',
      '--no-picture',
      '--no-record',
      '--output',
      join(folder, host),
      ...bus,
    ],
    {stdio: ['ignore', 'ignore', 'inherit']},
  ),
);

const quantile = (values, share) =>
  [...values].sort((a, b) => a - b)[Math.min(values.length - 1, Math.floor(share * values.length))];
const median = (values) => Number(quantile(values, 0.5).toFixed(1));

/** Milliseconds of one press, once it is answered. */
async function press(page, letter) {
  const count = await page.evaluate('window.took.length');
  await page.keyboard.down(letter);
  await until(page, `window.took.length > ${count}`);
  await page.keyboard.up(letter);
  // Steps and presses come in no common time.
  await page.waitForTimeout(60 + 40 * Math.random());
}

try {
  const gui = await startServer(rave, ['gui', scenario, '--line-key', key, ...bus]);
  children.push(gui.child);
  await knowsHosts(gui.link, 2);
  const browser = await launch();
  const page = await (await browser.newContext({viewport: {width: 1400, height: 900}})).newPage();
  await page.goto(gui.link);
  await until(page, `${app}?.link?.direct?.open.length === 2 && ${newest} != null`, 60000);
  await choose(page, await slotOf(page, 'anna'));
  await page.getByRole('radio', {name: 'Drive', exact: true}).click();
  await page.locator('rave-joystick .stick').focus();
  await page.evaluate(() => {
    const {direct} = document.querySelector('rave-app').link;
    window.took = [];
    let pressed_ms = null;
    window.addEventListener(
      'keydown',
      (event) => {
        pressed_ms ??= event.timeStamp;
      },
      {capture: true},
    );
    const order = direct.order.bind(direct);
    direct.order = (what) => {
      const answer = order(what);
      if (what.kind !== 'drive' || what.v === 0 || pressed_ms === null) return answer;
      const from_ms = pressed_ms;
      pressed_ms = null;
      void answer?.then(({good, text}) => {
        if (!good) throw new Error(text);
        window.took.push(performance.now() - from_ms);
      });
      return answer;
    };
  });
  const results = [];
  for (let round = 0; round < rounds; ++round) {
    await page.evaluate('void (window.took = [])');
    for (let i = 0; i < trials; ++i) await press(page, i % 2 === 0 ? 'w' : 's');
    const took_ms = await page.evaluate('window.took');
    results.push({
      p50: quantile(took_ms, 0.5),
      p99: quantile(took_ms, 0.99),
      max: Math.max(...took_ms),
      load: loadavg()[0],
    });
  }
  const of = (name) => median(results.map((one) => one[name]));
  console.log(
    JSON.stringify({
      bench: 'stick',
      rounds,
      trials,
      step_ms: 20,
      p50_ms: of('p50'),
      p99_ms: of('p99'),
      max_ms: of('max'),
      load: of('load'),
    }),
  );
  await browser.close();
} finally {
  for (const child of children) child.kill('SIGKILL');
  rmSync(folder, {recursive: true, force: true});
}
process.exit(0);
