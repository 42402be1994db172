// SPDX-License-Identifier: Apache-2.0
// A WebSocket without a page: what the server sends to a person, and takes from them, whatever a
// page would show or send.
import {once} from 'node:events';
import WebSocket from 'ws';

const kPoses = 1;
const kReading = 2;
const kPast = 1;
const kLimit_ms = 10_000;

export class Wire {
  messages = [];
  /** Date.now() of each reading that came. */
  readingsAt_ms = [];
  closed = null;

  /** `cookie`: of a browser that has signed in. */
  static async open(origin, cookie) {
    const wire = new Wire();
    wire.socket = new WebSocket(`${origin.replace('http', 'ws')}/ws`, 'rave.gui.1', {
      headers: {Origin: origin, Cookie: cookie},
    });
    wire.socket.on('message', (data, binary) => wire.#take(data, binary));
    wire.socket.on('close', (code) => (wire.closed = code));
    await wire.until(() => wire.last('time'), 'the begin');
    return wire;
  }

  #take(data, binary) {
    if (!binary) {
      const message = JSON.parse(String(data));
      this.messages.push({...message, at_ms: Date.now()});
      if (message.type === 'hello' && this.messages.length > 1) this.look();
    } else if (data[0] === kReading) this.readingsAt_ms.push(Date.now());
    else if (data[0] === kPoses && (data[1] & kPast) === 0)
      this.send({type: 'ack', sequence: data.readUInt32LE(4)});
  }

  /** Looks at the first sensor of both robots, whether it is there or not. */
  look() {
    this.send({
      type: 'look',
      poses: true,
      true_poses: false,
      readings: [
        [0, 0],
        [1, 0],
      ],
      parts: false,
      max_hz: 30,
    });
  }

  send(message) {
    this.socket.send(JSON.stringify(message));
  }

  last(type) {
    return this.messages.findLast((message) => message.type === type);
  }

  async until(holds, what) {
    const limit = AbortSignal.timeout(kLimit_ms);
    for (let found = holds(); ; found = holds()) {
      if (found) return found;
      // What is waited for comes with a message, if it comes; the socket has taken it by then.
      await once(this.socket, 'message', {signal: limit}).catch(() => {
        throw new Error(`never on the wire: ${what}`);
      });
    }
  }

  /** Sends a request: whether the server does it, and what it says. `done` tells of a message of
   * the server whether it shows that. */
  async ask(request, done = () => false) {
    const before = this.messages.length;
    const names = [request.type, request.do, request.kind];
    const answers = (told) =>
      told.type === 'answer' &&
      (request.request === undefined ? names.includes(told.to) : told.request === request.request);
    const answer = (told) => (answers(told) ? told : done(told));
    this.send(request);
    const said = await this.until(
      () => this.messages.slice(before).map(answer).find(Boolean),
      `an answer to ${JSON.stringify(request)}`,
    );
    return said === true ? {good: true, text: ''} : said;
  }

  end() {
    this.socket.close();
  }
}
