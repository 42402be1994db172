// SPDX-License-Identifier: Apache-2.0
// Frames per second of the World View in headless Chromium with software GL, for made-up runs:
// node frame_rate.mjs PAGE [ROBOTS ...]. Prints one line of JSON for each number of robots, medians
// of RAVE_ROUNDS rounds. RAVE_VIEW=3d for the perspective. first_picture_ms counts from the begin
// of the navigation, and first_load_kb is all that was loaded, compressed.
import {loadavg} from 'node:os';
import {launch} from './browser.mjs';
import {FakeRun} from './fake_run.mjs';
import {serveFake} from './fake_server.mjs';
import {sizeOf, watchLoads} from './first_load.mjs';

const [built, ...counts] = process.argv.slice(2);
const kWarm_ms = 3000;
const kMeasured_ms = Number(process.env.RAVE_MEASURE_MS ?? 8000);
const kRounds = Number(process.env.RAVE_ROUNDS ?? 3);
const kViewport = {width: 1600, height: 1000};

/** Counts pictures of the World View, and how long the main thread worked on each. */
async function measure(page) {
  return page.evaluate(async (span_ms) => {
    const world = document.querySelector('rave-world');
    const app = document.querySelector('rave-app');
    const [painted, paint_ms] = [world.painted, world.paint_ms];
    let ticks = 0;
    let longest_ms = 0;
    const begin = performance.now();
    let last = begin;
    await new Promise((resolve) => {
      const tick = (now) => {
        ++ticks;
        longest_ms = Math.max(longest_ms, now - last);
        last = now;
        if (performance.now() - begin < span_ms) requestAnimationFrame(tick);
        else resolve();
      };
      requestAnimationFrame(tick);
    });
    const seconds = (performance.now() - begin) / 1000;
    const pictures = world.painted - painted;
    return {
      robots: app.model.robots.length,
      pictures_per_s: pictures / seconds,
      browser_frames_per_s: ticks / seconds,
      main_thread_ms: (world.paint_ms - paint_ms) / Math.max(pictures, 1),
      longest_ms,
      received_hz: app.link.rate_hz,
      first_picture_ms: world.first_ms,
      view: world.viewpoint().split(',')[0],
    };
  }, kMeasured_ms);
}

/** Seconds of processor time that each kind of the browser's processes has used. Unlike frames, it
 * does not depend on what else the machine does. */
async function processorTime(session) {
  const {processInfo} = await session.send('SystemInfo.getProcessInfo');
  const spent = {};
  for (const {type, cpuTime} of processInfo) spent[type] = (spent[type] ?? 0) + cpuTime;
  return spent;
}

const browser = await launch();
const session = await browser.newBrowserCDPSession();

/** One page of its own, with nothing in its cache. */
async function round(count) {
  const server = await serveFake(built, new FakeRun(count, {now_s: 20}));
  const context = await browser.newContext({viewport: kViewport});
  const page = await context.newPage();
  if (process.env.RAVE_VIEW)
    await page.addInitScript(
      (mode) => localStorage.setItem('rave.world.mode.Ada N.Watch', JSON.stringify(mode)),
      process.env.RAVE_VIEW,
    );
  const loaded = watchLoads(page);
  await page.goto(server.origin);
  await page.waitForTimeout(kWarm_ms);
  const before = await processorTime(session);
  const result = await measure(page);
  const after = await processorTime(session);
  result.first_load_kb = sizeOf(loaded, built) / 1000;
  const pictures = Math.max(1, (result.pictures_per_s * kMeasured_ms) / 1000);
  for (const [name, type] of [
    ['page_cpu_ms', 'renderer'],
    ['gpu_cpu_ms', 'GPU'],
    ['browser_cpu_ms', 'browser'],
  ]) {
    result[name] = (1000 * ((after[type] ?? 0) - (before[type] ?? 0))) / pictures;
  }
  result.load = loadavg()[0];
  await context.close();
  await server.end();
  return result;
}

for (const count of counts.length > 0 ? counts.map(Number) : [16, 1000, 10000]) {
  const rounds = [];
  while (rounds.length < kRounds) rounds.push(await round(count));
  const result = {...rounds[0], rounds: kRounds};
  for (const key of Object.keys(rounds[0])) {
    if (typeof result[key] !== 'number') continue;
    result[key] = Number(
      rounds
        .map((one) => one[key])
        .sort((a, b) => a - b)
        [Math.floor((kRounds - 1) / 2)].toFixed(1),
    );
  }
  console.log(JSON.stringify(result));
}
await browser.close();
process.exit(0);
