// SPDX-License-Identifier: Apache-2.0
import {
  kLineProtocol,
  proofText,
  type HostMessage,
  type LineAnswer,
  type LineOrder,
  type LineTicket,
} from '../protocol/line';
import {Signal} from './signal';
import {SilenceWatch} from './silence';

const kFirstRetry_ms = 300;
const kLongestRetry_ms = 5000;
const kPing_ms = 1000;
/** The number of pings whose median counts. */
const kPings = 5;
/** Without a message for so long, though pings are answered, the line is dead, whatever the browser
 * thinks. */
const kDead_ms = 4000;

/** `untrusted`: TLS fails, most often since the browser does not know the certificate. `withdrawn`:
 * another ticket is needed. `blocked`: the page was loaded before the host had a line. */
export type LineState = 'opening' | 'open' | 'lost' | 'untrusted' | 'withdrawn' | 'blocked';

const kBadTicket = 4401;
const kWithdrawn = 4403;
const kReplaced = 4408;

/** What signs for the page. */
export interface Signer {
  sign(text: string): Promise<string>;
}

/** The WebSocket to one host: comes back by itself, with the same ticket, without the GUI
 * Server. */
export class DirectLine {
  state: LineState = 'opening';
  /** To the host and back, as pings say; null: not measured yet. */
  latency_ms: number | null = null;
  /** Who drives which robot, as the host says. */
  leases: Record<string, string> = {};
  /** Who stands, as the host says; null: it has not said it yet on this connection. */
  stopped: string[] | null = null;
  /** Why the host refused the line last. */
  refusal = '';
  readonly changed = new Signal();

  private socket: WebSocket | null = null;
  private retry_ms = kFirstRetry_ms;
  private timer: ReturnType<typeof setTimeout> | undefined;
  private readonly pinging: ReturnType<typeof setInterval>;
  private id = 0;
  private readonly open_ = new Map<number, (answer: LineAnswer) => void>();
  private readonly pings = new Map<number, number>();
  private readonly measured: number[] = [];
  private readonly silence = new SilenceWatch(() => {
    this.set('lost');
    this.dial();
  });
  private ended = false;

  constructor(
    private ticket_: LineTicket,
    private readonly signer: Signer,
  ) {
    this.pinging = setInterval(() => this.ping(), kPing_ms);
    this.dial();
  }

  get ticket(): LineTicket {
    return this.ticket_;
  }

  /** Sends an order. The answer of the run; of a drive only if it is refused or `echo` is set.
   * Never rejects. */
  order(order: LineOrder): Promise<LineAnswer> {
    if (this.state !== 'open')
      return Promise.resolve({good: false, text: `There is no line to host ${this.ticket_.host}.`});
    const id = ++this.id;
    this.send({type: 'order', id, ...order});
    if (order.kind === 'drive' && !order.echo) {
      // Most are never answered; the last of them is kept for the one that is refused.
      for (const old of [...this.open_.keys()].filter((other) => other < id - 64))
        this.open_.delete(old);
    }
    return new Promise((done) => this.open_.set(id, done));
  }

  /** The next ticket: over the line that is there, or for the next try. */
  renew(ticket: LineTicket): void {
    const moved = ticket.url !== this.ticket_.url;
    this.ticket_ = ticket;
    if (this.state === 'open' && !moved) this.send({type: 'ticket', ticket: ticket.ticket});
    else this.dial();
  }

  /** The page does not want the line any more. */
  end(): void {
    this.ended = true;
    clearTimeout(this.timer);
    clearInterval(this.pinging);
    this.drop();
  }

  /** The browser did not even try: the policy of the page does not list the host. */
  block(): void {
    clearTimeout(this.timer);
    this.drop();
    this.set('blocked');
  }

  /** Tries now. */
  dial(): void {
    if (this.ended) return;
    clearTimeout(this.timer);
    this.drop();
    let opened = false;
    const socket = new WebSocket(this.ticket_.url, kLineProtocol);
    this.socket = socket;
    this.silence.heard(kDead_ms);
    socket.onopen = () => (opened = true);
    socket.onmessage = (message: MessageEvent<string>) => {
      if (this.socket === socket) void this.take(socket, JSON.parse(message.data) as HostMessage);
    };
    socket.onclose = (event) => {
      if (this.socket === socket) this.lose(event, opened);
    };
  }

  private drop(): void {
    const old = this.socket;
    this.socket = null;
    this.stopped = null;
    this.silence.end();
    old?.close();
    for (const done of this.open_.values())
      done({good: false, text: `The line to host ${this.ticket_.host} was lost.`});
    this.open_.clear();
    this.pings.clear();
  }

  private lose(event: CloseEvent, opened: boolean): void {
    this.drop();
    this.refusal = event.reason;
    if (event.code === kWithdrawn || event.code === kBadTicket) return this.set('withdrawn');
    // Another page of the same ticket, as after a copy of the tab: that one has the line.
    if (event.code === kReplaced) return this.set('lost');
    this.set(!opened && this.ticket_.url.startsWith('wss:') ? 'untrusted' : 'lost');
    this.timer = setTimeout(() => this.dial(), this.retry_ms);
    this.retry_ms = Math.min(2 * this.retry_ms, kLongestRetry_ms);
  }

  private async take(socket: WebSocket, message: HostMessage): Promise<void> {
    this.silence.heard(kDead_ms);
    switch (message.type) {
      case 'challenge': {
        const {ticket, url} = this.ticket_;
        const proof = await this.signer.sign(
          proofText(message.challenge, new URL(url).host, ticket),
        );
        if (this.socket === socket) this.send({type: 'hello', ticket, proof});
        break;
      }
      case 'welcome':
        this.retry_ms = kFirstRetry_ms;
        this.refusal = '';
        this.set('open');
        this.ping();
        break;
      case 'answer': {
        const done = this.open_.get(message.id ?? -1);
        this.open_.delete(message.id ?? -1);
        done?.({good: message.good, text: message.text});
        break;
      }
      case 'state':
        this.leases = message.leases;
        this.stopped = message.stopped;
        this.changed.emit();
        break;
      case 'pong':
        this.measure(message.id);
        break;
      case 'renewed':
        break;
    }
  }

  private ping(): void {
    if (this.state !== 'open') return;
    const id = ++this.id;
    this.pings.set(id, performance.now());
    this.send({type: 'ping', id});
  }

  private measure(id: number): void {
    const sent_ms = this.pings.get(id);
    if (sent_ms === undefined) return;
    this.pings.delete(id);
    this.measured.push(performance.now() - sent_ms);
    if (this.measured.length > kPings) this.measured.shift();
    this.latency_ms =
      [...this.measured].sort((a, b) => a - b)[Math.floor(this.measured.length / 2)] ?? null;
    this.changed.emit();
  }

  private send(message: object): void {
    if (this.socket?.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(message));
  }

  private set(state: LineState): void {
    if (this.state === state) return;
    this.state = state;
    this.changed.emit();
  }
}
