// SPDX-License-Identifier: Apache-2.0
// Serves the built page and a made-up run, with the policy of the GUI Server. For tests and for
// measuring the page: node fake_server.mjs PAGE [ROBOTS] [PORT]
import {createServer} from 'node:http';
import {readFileSync, existsSync} from 'node:fs';
import {extname, join, normalize} from 'node:path';
import {fileURLToPath} from 'node:url';
import {WebSocketServer} from 'ws';
import {FakeRun} from './fake_run.mjs';

const kTypes = {
  '.html': 'text/html',
  '.js': 'text/javascript',
  '.css': 'text/css',
  '.svg': 'image/svg+xml',
  '.woff2': 'font/woff2',
};
const kPolicy =
  "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; " +
  "font-src 'self'; connect-src 'self'; manifest-src 'self'; worker-src 'self'; base-uri 'none'; form-action 'self'; frame-ancestors 'none'";
const kFrame_ms = 1000 / 30;
const kInFlight = 2;
/** Code of the close frame of a server without a run. */
const kNoRun = 4404;

/** One page that looks. */
class Viewer {
  constructor(socket, server) {
    this.socket = socket;
    this.server = server;
    this.look = null;
    this.sequence = 0;
    this.acknowledged = 0;
    for (const message of server.run.opening()) this.say(message);
    socket.on('message', (data) => this.take(JSON.parse(String(data))));
  }

  say(message) {
    this.socket.send(JSON.stringify(message));
  }

  take(message) {
    this.server.heard.push(message);
    if (message.type === 'look') this.look = message;
    if (message.type === 'ack') this.acknowledged = Math.max(this.acknowledged, message.sequence);
    if (message.type === 'transport') this.server.transport(message);
    if (message.type === 'order' || message.type === 'lease' || message.type === 'set') {
      this.say(this.server.run.command(message));
      if (message.kind !== 'drive') this.server.say(this.server.run.leases(message.slots));
    }
    if (message.type === 'edit') {
      this.server.say(this.server.run.edit(message));
      this.say({
        type: 'answer',
        to: message.do,
        good: true,
        text: 'done',
        request: message.request,
      });
    }
    if (message.type === 'say') {
      this.server.say(this.server.run.say(message));
      this.say({type: 'answer', to: 'say', good: true, text: 'Said.', request: message.request});
    }
    if (message.type === 'halt') this.server.halt(this, message);
    if (message.type === 'set_right') {
      this.server.run.setRight(message);
      this.say(this.server.run.rights);
    }
    if (['account', 'invitation', 'audit'].includes(message.type))
      for (const told of this.server.run.people(message)) this.say(told);
    if (message.type === 'see_as') {
      this.server.run.seeAs(
        message.role || message.user
          ? {name: message.user ?? message.role, role: message.role ?? 'observer'}
          : null,
      );
      this.server.turnInto({});
    }
  }

  show(run) {
    if (!this.look?.poses || this.sequence - this.acknowledged >= kInFlight) return;
    this.socket.send(run.frame(++this.sequence));
    for (const [slot, sensor] of this.look.readings) this.socket.send(run.reading(slot, sensor));
  }
}

class FakeServer {
  constructor(page, run) {
    this.page = page;
    this.run = run;
    this.viewers = new Set();
    this.heard = [];
    /** Text of modules by path, such as `/components/0/heat.js`. */
    this.components = new Map();
  }

  async listen(port) {
    this.http = createServer((request, response) => this.answer(request, response));
    this.sockets = new WebSocketServer({
      server: this.http,
      path: '/ws',
      handleProtocols: () => 'rave.gui.1',
      perMessageDeflate: false,
    });
    this.sockets.on('connection', (socket) => {
      if (this.run === null) {
        socket.close(kNoRun, 'no run');
        return;
      }
      const viewer = new Viewer(socket, this);
      this.viewers.add(viewer);
      socket.on('close', () => this.viewers.delete(viewer));
    });
    await new Promise((resolve) => this.http.listen(port, '127.0.0.1', resolve));
    this.origin = `http://127.0.0.1:${this.http.address().port}`;
    let last = performance.now();
    this.timer = setInterval(() => {
      const now = performance.now();
      this.run?.advance((now - last) / 1000);
      last = now;
      for (const viewer of this.viewers) viewer.show(this.run);
    }, kFrame_ms);
    this.clock = setInterval(() => this.run && this.say(this.run.time()), 1000);
  }

  answer(request, response) {
    const path = normalize(new URL(request.url, 'http://x').pathname);
    const component = this.components.get(path);
    if (component !== undefined) {
      response
        .writeHead(200, {'Content-Type': 'text/javascript', 'Content-Security-Policy': kPolicy})
        .end(component);
      return;
    }
    if (path === '/ticket') {
      response.writeHead(200, {'Content-Type': 'application/json'});
      response.end('{"relay":true,"lines":[]}');
      return;
    }
    const file = join(this.page, path === '/' ? 'index.html' : path);
    if (!existsSync(file)) {
      response.writeHead(404).end();
      return;
    }
    response.writeHead(200, {
      'Content-Type': kTypes[extname(file)] ?? 'application/octet-stream',
      'Content-Security-Policy': kPolicy,
    });
    response.end(readFileSync(file));
  }

  say(message) {
    for (const viewer of this.viewers) viewer.say(message);
  }

  /** The same run under another name, source or rights, on the sockets that are open. */
  turnInto(change) {
    Object.assign(this.run, change);
    for (const message of this.run.opening()) this.say(message);
  }

  transport({do: what, value}) {
    const {run} = this;
    if (what === 'play') run.state = 'running';
    else if (what === 'pause') run.state = 'paused';
    else if (what === 'pace') run.pace = value;
    else if (what === 'step') run.now_s += 0.01 * value;
    else if (what === 'seek') run.now_s = value;
    this.say(run.time());
  }

  halt(viewer, {do: what, slots}) {
    const meant = slots.length > 0 ? slots : this.run.robots.map((_, i) => i);
    for (const slot of meant) {
      if (what === 'stop') this.run.stopped.add(slot);
      else this.run.stopped.delete(slot);
    }
    viewer.say({type: 'answer', to: what, good: true, text: ''});
  }

  async end() {
    clearInterval(this.timer);
    clearInterval(this.clock);
    for (const socket of this.sockets.clients) socket.terminate();
    this.http.closeAllConnections();
    await new Promise((resolve) => this.http.close(resolve));
  }
}

export async function serveFake(page, run, port = 0) {
  const server = new FakeServer(page, run);
  await server.listen(port);
  return server;
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const [page, robots = '16', port = '8090'] = process.argv.slice(2);
  const server = await serveFake(page, new FakeRun(Number(robots)), Number(port));
  console.log(server.origin);
}
