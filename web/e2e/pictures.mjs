// SPDX-License-Identifier: Apache-2.0
// Pictures of the page in docs/images, made from a recorded run and from a made-up one:
//     node pictures.mjs RAVE PAGE IMAGES FOLDER [--renew]
// Each is taken into FOLDER and compared, coarsely, with the one of the same name in IMAGES:
// another size, or a page that looks different by now, is a finding. With --renew it takes its
// place instead.
import {execFileSync} from 'node:child_process';
import {copyFileSync, existsSync, mkdirSync, readFileSync, rmSync} from 'node:fs';
import {dirname, join} from 'node:path';
import {fileURLToPath} from 'node:url';
import {launch, startServer} from './browser.mjs';
import {app, until} from './checks.mjs';
import {newest} from './commander.mjs';
import {FakeRun} from './fake_run.mjs';
import {serveFake} from './fake_server.mjs';
import {placeOf} from './hands.mjs';

const [rave, pageFolder, images, folder, ...more] = process.argv.slice(2);
const kRoot = join(dirname(fileURLToPath(import.meta.url)), '../..');
/** A picture is compared in cells of so many pixels, each by its mean colour. */
const kCell = 40;
/** So much of 255 may a cell differ, and so large a share of the cells may differ by more: hours,
 * texts and lines. */
const kAlike = 24;
const kMostOther = 0.06;

rmSync(folder, {recursive: true, force: true});
mkdirSync(folder, {recursive: true});
const browser = await launch();

async function opened(theme, [width, height], options = {}) {
  const page = await (await browser.newContext({viewport: {width, height}, ...options})).newPage();
  page.on('pageerror', (error) => console.error(String(error)));
  await page.addInitScript((value) => localStorage.setItem('rave.theme', value), theme);
  return page;
}

async function take(page, name) {
  await page.waitForTimeout(1000);
  await page.screenshot({path: join(folder, `${name}.png`)});
  await page.context().close();
}

/** A recorded run at a moment, with a robot that is looked at. */
async function ofRecording(gui, name, {theme, size, at_s, robot}) {
  const page = await opened(theme, size, {storageState: gui.signedIn});
  // The link lets in once; the next pages have the cookie of the first.
  await page.goto(gui.signedIn === undefined ? gui.link : new URL('/', gui.link).href);
  await until(page, `${app}?.model?.poses?.newest != null`, 60000);
  gui.signedIn ??= {cookies: await page.context().cookies(), origins: []};
  await page.evaluate((wanted) => {
    const shown = document.querySelector('rave-app');
    shown.selection.set([shown.model.robots.findIndex((known) => known.name === wanted)]);
    shown.link.send({type: 'transport', do: 'pause'});
  }, robot);
  await until(page, `${app}.model.time.state === 'paused'`);
  // The past for trails and plots is what came before.
  await page.evaluate(
    (to) =>
      document.querySelector('rave-app').link.send({type: 'transport', do: 'seek', value: to}),
    at_s,
  );
  await until(page, `Math.abs(${newest}.time_s - ${at_s}) < 0.02`);
  await take(page, name);
}

/** A run that stands still, in which a person commands. */
async function ofCommands(name, {theme, size, options}, act) {
  const run = new FakeRun(16, {real: 5, now_s: 24, name: 'mixed-reality'});
  run.advance = () => {};
  run.drives.get(9).lease = 'Ben K';
  run.drives.get(9).order = 'goal 2.00, 2.50';
  run.drives.get(6).lease = 'Ada N';
  run.say(
    {to: 'all', text: 'Can you look behind the crate? I have walker-5 in the corner.'},
    {name: 'Ben K', role: 'commander'},
  );
  run.say({
    to: 'team',
    name: 'east',
    text: 'Sending walker-2 around. Team: keep clear of the pond.',
  });
  run.events.push({
    t: 24,
    until: 24,
    count: 1,
    kind: 'said',
    level: 'info',
    text: 'walker-2: said, going to (1.2, 0.4), 2.7 m',
    slots: [6],
  });
  const server = await serveFake(pageFolder, run);
  const page = await opened(theme, size, options);
  await page.goto(server.origin);
  await until(page, `${app}?.model?.poses?.newest != null && ${app}.model.drives.size === 16`);
  await page.waitForTimeout(500);
  await page.evaluate(() => document.querySelector('rave-app').selection.set([6]));
  await act(page);
  await take(page, name);
  await server.end();
}

/** Share of cells of the two pictures whose mean colours differ; 1 if they have different sizes. */
async function compare(page, before, now) {
  const url = (file) => `data:image/png;base64,${readFileSync(file).toString('base64')}`;
  return page.evaluate(
    async ([a, b, cell, alike]) => {
      const cells = async (from) => {
        const image = new Image();
        image.src = from;
        await image.decode();
        const canvas = Object.assign(document.createElement('canvas'), {
          width: image.width,
          height: image.height,
        });
        const context = canvas.getContext('2d');
        context.drawImage(image, 0, 0);
        const across = Math.ceil(image.width / cell);
        const sums = Array.from({length: across * Math.ceil(image.height / cell)}, () => [
          0, 0, 0, 0,
        ]);
        const {data} = context.getImageData(0, 0, image.width, image.height);
        for (let i = 0; i < data.length; i += 4) {
          const x = (i / 4) % image.width;
          const y = Math.floor(i / 4 / image.width);
          const sum = sums[Math.floor(y / cell) * across + Math.floor(x / cell)];
          for (let k = 0; k < 3; ++k) sum[k] += data[i + k];
          ++sum[3];
        }
        return {
          size: `${image.width}x${image.height}`,
          means: sums.map(([r, g, b, n]) => [r / n, g / n, b / n]),
        };
      };
      const [first, second] = [await cells(a), await cells(b)];
      if (first.size !== second.size) return 1;
      const other = first.means.filter((mean, i) =>
        mean.some((value, k) => Math.abs(value - second.means[i][k]) > alike),
      );
      return other.length / first.means.length;
    },
    [url(before), url(now), kCell, kAlike],
  );
}

const recording = join(folder, 'run');
execFileSync(
  rave,
  [
    'run',
    join(kRoot, 'scenarios/mixed-reality'),
    '--pace',
    'max',
    '--quiet',
    '--no-picture',
    '--output',
    recording,
  ],
  {stdio: 'ignore'},
);
const gui = await startServer(rave, ['gui', recording, '--page', pageFolder]);
const kLarge = [1600, 1000];
await ofRecording(gui, 'page-dark', {theme: 'dark', size: kLarge, at_s: 19.25, robot: 'real-3'});
await ofRecording(gui, 'page-light', {theme: 'light', size: kLarge, at_s: 19.25, robot: 'real-3'});
await ofRecording(gui, 'watch-light', {
  theme: 'light',
  size: [1280, 800],
  at_s: 34,
  robot: 'hunter',
});
await gui.end();
await ofCommands('command-dark', {theme: 'dark', size: kLarge}, async (page) => {
  await page.getByRole('radio', {name: 'Drive', exact: true}).click();
  await page.waitForTimeout(400);
  await page.keyboard.press('w');
  await page.mouse.move(...(await placeOf(page, -1, -1)));
  await page.mouse.down();
  for (const [x, y] of [
    [-0.6, 0],
    [0, 0.8],
    [0.8, 1.2],
    [1.6, 1],
    [2.2, 0.2],
  ])
    await page.mouse.move(...(await placeOf(page, x, y)), {steps: 5});
  await page.mouse.up();
});
await ofCommands(
  'command-pen',
  {theme: 'light', size: [480, 640], options: {hasTouch: true}},
  async (page) => {
    await page.mouse.click(...(await placeOf(page, 0, 0)), {button: 'right'});
  },
);

const findings = [];
const bench = await (await browser.newContext()).newPage();
for (const name of ['page-dark', 'page-light', 'watch-light', 'command-dark', 'command-pen']) {
  const [kept, taken] = [join(images, `${name}.png`), join(folder, `${name}.png`)];
  if (more.includes('--renew')) copyFileSync(taken, kept);
  else if (!existsSync(kept)) findings.push(`${kept}: there is no such picture`);
  else {
    const other = await compare(bench, kept, taken);
    console.log(`# ${name}: ${(100 * other).toFixed(1)} % differ`);
    if (other > kMostOther)
      findings.push(
        `${kept}: the page looks different now (${(100 * other).toFixed(1)} % of it), see ${taken}`,
      );
  }
}
await browser.close();
for (const finding of findings)
  console.log(`${finding}; run tools/docs/pictures.py, and look at the pictures`);
process.exit(findings.length === 0 ? 0 : 1);
