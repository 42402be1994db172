// SPDX-License-Identifier: Apache-2.0
// How long an order takes over direct lines, as one line of JSON:
//
//     node bench/direct_line.mjs RAVE [--hosts 10] [--clients 50] [--trials 200] [--rate 250]
//
// Starts a manager, the hosts, and a GUI Server, each a process of its own, and takes the lines with a
// key of its own as a page does. `stop_ms`: from the moment that STOP is sent to all hosts until the
// last of them says that its robots are stopped. `drive_ms`: from a drive that is sent until its host
// says that the run has taken it; the actuator gets it in the same step, whose length is step_ms.
// Meanwhile `clients` other lines, in a process of their own, send `rate` orders a second each; a line
// may send 300.
import {execFileSync, spawn} from 'node:child_process';
import {webcrypto} from 'node:crypto';
import {mkdirSync, mkdtempSync, rmSync, writeFileSync} from 'node:fs';
import {createRequire} from 'node:module';
import {tmpdir} from 'node:os';
import {join, resolve} from 'node:path';
import {fileURLToPath} from 'node:url';

const {WebSocket} = createRequire(new URL('../web/package.json', import.meta.url))('ws');
const [rave, ...words] = process.argv.slice(2);
const option = (name, usual) => (words.includes(`--${name}`) ? Number(words[words.indexOf(`--${name}`) + 1]) : usual);
const hosts = option('hosts', 10);
const clients = option('clients', 50);
const trials = option('trials', 200);
const rate = option('rate', 250);
const kStep_s = 0.02;
/** How often the flood sends what has become due. */
const kFlood_ms = 20;

const b64 = (bytes) => Buffer.from(bytes).toString('base64url');

async function until(what, holds, limit_ms = 120_000) {
  const end = Date.now() + limit_ms;
  for (;;) {
    const value = await holds();
    if (value) return value;
    if (Date.now() > end) throw new Error(`never: ${what}`);
    await new Promise((done) => setTimeout(done, 50));
  }
}

/** What a page does to come in: the cookie of the link. */
async function signIn(link) {
  const response = await fetch(link, {redirect: 'manual'});
  return response.headers.get('set-cookie').split(';')[0];
}

class Page {
  static async make() {
    const page = new Page();
    page.pair = await webcrypto.subtle.generateKey({name: 'ECDSA', namedCurve: 'P-256'}, false, ['sign']);
    page.point = b64(await webcrypto.subtle.exportKey('raw', page.pair.publicKey));
    return page;
  }
  async tickets(origin, cookie) {
    const response = await fetch(`${origin}/ticket`, {method: 'POST', headers: {Origin: origin, Cookie: cookie}, body: JSON.stringify({key: this.point})});
    if (!response.ok) throw new Error(await response.text());
    return (await response.json()).lines;
  }
  line(ticket, origin) {
    const socket = new WebSocket(ticket.url, 'rave.line.1', {origin});
    const answers = new Map();
    let id = 0;
    return new Promise((done, failed) => {
      socket.on('error', failed);
      socket.on('close', (code, reason) => failed(new Error(`${code} ${reason}`)));
      socket.on('message', async (data) => {
        const message = JSON.parse(data);
        if (message.type === 'challenge') {
          const text = `rave line proof 1\n${message.challenge}\n${new URL(ticket.url).host}\n${ticket.ticket}\n`;
          const proof = await webcrypto.subtle.sign({name: 'ECDSA', hash: 'SHA-256'}, this.pair.privateKey, Buffer.from(text));
          socket.send(JSON.stringify({type: 'hello', ticket: ticket.ticket, proof: b64(proof)}));
        }
        if (message.type === 'answer') answers.get(message.id)?.(message);
        if (message.type === 'welcome') {
          done({
            robot: ticket.robots[0],
            order: (order) => new Promise((answered) => {
              answers.set(++id, answered);
              socket.send(JSON.stringify({type: 'order', id, ...order}));
            }),
          });
        }
      });
    });
  }
}

const quantile = (values, q) => [...values].sort((a, b) => a - b)[Math.min(values.length - 1, Math.floor(q * values.length))];
const figures = (values) => ({p50: Number(quantile(values, 0.5).toFixed(2)), p99: Number(quantile(values, 0.99).toFixed(2)), max: Number(Math.max(...values).toFixed(2))});

/** Others have pages of their own, so tickets of their own. Each page is another one to the run: drives of all but the
 * one that has the lease are refused, and cost the host no less. */
async function flood({origin, cookie}) {
  const others = [];
  for (let i = 0; i < clients; ++i) {
    const other = await Page.make();
    const [ticket] = (await other.tickets(origin, cookie)).slice(i % hosts);
    others.push(await other.line(ticket, origin));
  }
  let sent = 0;
  const began = performance.now();
  setInterval(() => {
    for (const due = (rate * (performance.now() - began)) / 1000; sent < due; ++sent) {
      for (const line of others) void line.order({kind: 'drive', robot: line.robot, v: 0.1, w: 0});
    }
  }, kFlood_ms);
  console.log('here');
  await new Promise(() => {});
}

if (process.env.RAVE_BENCH_FLOOD !== undefined) await flood(JSON.parse(process.env.RAVE_BENCH_FLOOD));

const folder = mkdtempSync(join(tmpdir(), 'rave-direct-'));
const key = join(folder, 'line');
const scenario = join(folder, 'lab');
const names = Array.from({length: hosts}, (_, i) => `h${i}`);
const robots = new URL('../robots/wanderer.yaml', import.meta.url).pathname;
mkdirSync(scenario);
writeFileSync(join(scenario, 'scenario.yaml'), [
  'name: direct-bench', 'clock: real_time', 'max_missed_pct: 100', 'duration_s: 3600', `step_s: ${kStep_s}`, 'hosts:',
  ...names.map((name) => `  - {name: ${name}, robots: [r${name}]}`), 'robots:',
  ...names.map((name, i) => `  - {name: r${name}, file: ${robots}, pose: {x_m: ${3 * i}, y_m: 0}}`), ''].join('\n'));

const children = [];
const start = (words, stdout = 'ignore') => {
  const child = spawn(resolve(rave), words, {stdio: ['ignore', stdout, 'inherit'], cwd: folder});
  children.push(child);
  return child;
};
const bus = ['--run', `bench-${process.pid}`];
try {
  execFileSync(resolve(rave), ['keys', 'line', key], {stdio: 'ignore'});
  start(['env', scenario, '--quiet', '--no-picture', '--no-record', ...bus]);
  for (const name of names) start(['robot', scenario, '--host', name, '--web', '127.0.0.1:0', '--web-key', `${key}.pub`, '--quiet', '--no-picture', '--no-record', ...bus]);
  const gui = start(['gui', scenario, '--line-key', key, '--no-open', '--port', '0', ...bus], 'pipe');
  let text = '';
  gui.stdout.on('data', (data) => (text += data));
  const link = await until('the link', () => /https?:\S+/.exec(text)?.[0]);
  const {origin} = new URL(link);
  const cookie = await signIn(link);
  const page = await Page.make();
  const tickets = await until('all lines', async () => {
    const found = await page.tickets(origin, cookie);
    return found.length === hosts ? found : null;
  });
  const lines = await Promise.all(tickets.map((ticket) => page.line(ticket, origin)));
  const flooding = spawn(process.execPath, [fileURLToPath(import.meta.url), ...process.argv.slice(2)], {
    stdio: ['ignore', 'pipe', 'inherit'], env: {...process.env, RAVE_BENCH_FLOOD: JSON.stringify({origin, cookie})}});
  children.push(flooding);
  let said = '';
  flooding.stdout.on('data', (data) => (said += data));
  await until('the others', () => said.includes('here'));
  const drive_ms = [];
  const stop_ms = [];
  let refused = 0;
  for (let i = 0; i < trials; ++i) {
    await lines[i % hosts].order({kind: 'take', robot: lines[i % hosts].robot, force: true});
    let began = performance.now();
    const driven = await lines[i % hosts].order({kind: 'drive', robot: lines[i % hosts].robot, v: 0.2, w: 0, echo: true});
    if (driven.good) drive_ms.push(performance.now() - began);
    else ++refused;
    began = performance.now();
    const stopped = await Promise.all(lines.map((line) => line.order({kind: 'stop'})));
    stop_ms.push(performance.now() - began);
    if (!stopped.every((answer) => answer.good)) ++refused;
    await Promise.all(lines.map((line) => line.order({kind: 'release'})));
    await new Promise((done) => setTimeout(done, 20));
  }
  if (flooding.exitCode !== null) throw new Error('the flood has ended');
  console.log(JSON.stringify({bench: 'direct_line', hosts, clients, rate, trials, step_ms: 1000 * kStep_s, refused, stop_ms: figures(stop_ms), drive_ms: drive_ms.length > 0 ? figures(drive_ms) : null}));
} finally {
  for (const child of children) child.kill('SIGKILL');
  rmSync(folder, {recursive: true, force: true});
}
process.exit(0);
