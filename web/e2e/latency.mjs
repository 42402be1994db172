// SPDX-License-Identifier: Apache-2.0
// How old a state is when it is on the screen, of real runs in headless Chromium with software GL:
// RAVE_PAGE=PAGE node latency.mjs RAVE [ROBOTS ...]. Prints one line of JSON for each number of
// robots. The age is measured from the moment when the server takes a state from the run to the
// beginning of the browser's frame behind the one in which it was painted, and counts the page's
// interpolation.
import {mkdtempSync, rmSync, writeFileSync} from 'node:fs';
import {loadavg, tmpdir} from 'node:os';
import {dirname, join} from 'node:path';
import {fileURLToPath} from 'node:url';
import {launch, startServer} from './browser.mjs';

const [rave, ...counts] = process.argv.slice(2);
const kWarm_ms = 5000;
const kMeasured_ms = Number(process.env.RAVE_MEASURE_MS ?? 8000);
const kRounds = Number(process.env.RAVE_ROUNDS ?? 3);
const kViewport = {width: 1600, height: 1000};
const robot = join(dirname(fileURLToPath(import.meta.url)), '../../robots/wanderer.yaml');

function writeScenario(folder, robots) {
  const half = Math.max(5, Math.round(Math.sqrt(robots)));
  const file = join(folder, `crowd-${robots}.yaml`);
  writeFileSync(
    file,
    `name: crowd\nduration_s: 100000\nstep_s: 0.01\nrobots:\n  - name: walker\n    file: ${robot}\n    team: crowd\n` +
      `    scatter: {count: ${robots}, x_m: [-${half}, ${half}], y_m: [-${half}, ${half}], clearance_m: 0.4}\n`,
  );
  return file;
}

/** In the page: ages in milliseconds of all pictures of a span. */
async function measure(span_ms) {
  const world = document.querySelector('rave-world');
  const {model} = document.querySelector('rave-app');
  const wall_us = () => (performance.timeOrigin + performance.now()) * 1000;
  /** When the server took the states, by time of the run. */
  const taken = [];
  const takeFrame = model.takeFrame;
  model.takeFrame = function (buffer, now_ms) {
    const view = new DataView(buffer);
    if (view.getUint8(0) === 1 && view.getUint8(1) === 0) {
      const now = wall_us();
      const age_us = (Math.floor(now) - view.getUint32(44, true)) | 0;
      taken.push([view.getFloat64(8, true), now - age_us]);
    }
    return takeFrame.call(this, buffer, now_ms);
  };
  const ages = [];
  const paint = world.paint;
  world.paint = function () {
    paint.call(this);
    const shown_s = this.placed.time_s;
    const next = taken.findIndex(([time_s]) => time_s >= shown_s - 1e-9);
    if (next < 1) return;
    const [[t0, us0], [t1, us1]] = [taken[next - 1], taken[next]];
    const at_us = t1 > t0 ? us0 + ((us1 - us0) * (shown_s - t0)) / (t1 - t0) : us1;
    requestAnimationFrame(() => ages.push((wall_us() - at_us) / 1000));
  };
  await new Promise((resolve) => setTimeout(resolve, span_ms));
  world.paint = paint;
  model.takeFrame = takeFrame;
  return ages;
}

const folder = mkdtempSync(join(tmpdir(), 'rave-latency-'));
const browser = await launch();
const quantile = (sorted, share) => sorted[Math.floor(share * (sorted.length - 1))];
const median = (values) =>
  quantile(
    [...values].sort((a, b) => a - b),
    0.5,
  );
for (const count of counts.length > 0 ? counts.map(Number) : [16, 1000]) {
  const rounds = [];
  for (let round = 0; round < kRounds; ++round) {
    const gui = await startServer(rave, [
      'run',
      writeScenario(folder, count),
      '--gui',
      '--quiet',
      '--no-record',
      '--no-picture',
      '--output',
      join(folder, `run-${count}-${round}`),
    ]);
    const page = await (await browser.newContext({viewport: kViewport})).newPage();
    await page.goto(gui.link);
    await page.waitForTimeout(kWarm_ms);
    const ages = (await page.evaluate(measure, kMeasured_ms)).sort((a, b) => a - b);
    const rate = await page.evaluate(() => document.querySelector('rave-app').link.rate_hz);
    rounds.push({
      load: loadavg()[0],
      pictures_per_s: (1000 * ages.length) / kMeasured_ms,
      received_hz: rate,
      age_ms_median: quantile(ages, 0.5),
      age_ms_p99: quantile(ages, 0.99),
    });
    await page.close();
    await gui.end();
  }
  const result = {robots: count, rounds: kRounds};
  for (const key of Object.keys(rounds[0]))
    result[key] = Number(median(rounds.map((one) => one[key])).toFixed(1));
  console.log(JSON.stringify(result));
}
await browser.close();
rmSync(folder, {recursive: true, force: true});
process.exit(0);
