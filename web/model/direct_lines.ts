// SPDX-License-Identifier: Apache-2.0
import type {LineAnswer, LineOrder, Tickets} from '../protocol/line';
import {DirectLine} from './direct_line';
import {PageKey} from './page_key';
import {Signal} from './signal';

/** A host that comes later, and a right that is given back, are noticed after so long. */
const kAgain_ms = 5000;
const kQuiet_ms = 30_000;
/** A withdrawn ticket: the server knows the new rights already. */
const kWithdrawn_ms = 300;
const kReloaded = 'rave.reloaded';
const kYoung_ms = 30_000;
const kRarely_ms = 60_000;

/** How orders of a robot go. `none`: they cannot. */
export type Way = 'direct' | 'relay' | 'none';

/** The direct lines to all hosts whose robots this page may order about. */
export class DirectLines {
  readonly lines = new Map<string, DirectLine>();
  readonly changed = new Signal();
  /** Orders may go through the server where there is no line. */
  relay = false;
  /** Why there are no tickets; empty: there are. */
  why = '';

  private key: PageKey | null = null;
  private readonly hosts = new Map<string, string>();
  private timer: ReturnType<typeof setTimeout> | undefined;
  private asking = false;
  private wanted = false;

  /** `url`: of `POST /ticket`. */
  constructor(private readonly url: string) {
    document.addEventListener('securitypolicyviolation', (event) => {
      for (const line of this.lines.values()) {
        if (
          event.blockedURI !== '' &&
          line.ticket.url.startsWith(event.blockedURI.replace(/\/$/, ''))
        )
          this.block(line);
      }
    });
  }

  /** A page that was opened just before its hosts is loaded anew by itself, once, while the person
   * has not touched it. */
  private block(line: DirectLine): void {
    line.block();
    const last_ms = Number(sessionStorage.getItem(kReloaded) ?? 0);
    if (
      navigator.userActivation.hasBeenActive ||
      performance.now() > kYoung_ms ||
      Date.now() - last_ms < kRarely_ms
    )
      return;
    sessionStorage.setItem(kReloaded, String(Date.now()));
    location.reload();
  }

  /** Whether the page has a live run and a user who may give orders. */
  want(wanted: boolean): void {
    if (wanted === this.wanted) return;
    this.wanted = wanted;
    clearTimeout(this.timer);
    if (wanted) void this.ask();
    else this.end();
  }

  /** Public key of the page, by which its leases are known over all ways; empty: it has none
   * yet. */
  get point(): string {
    return this.key?.point ?? '';
  }

  way(robot: string): Way {
    const line = this.lineOf(robot);
    if (line?.state === 'open') return 'direct';
    return this.relay ? 'relay' : 'none';
  }

  lineOf(robot: string): DirectLine | undefined {
    const host = this.hosts.get(robot);
    return host === undefined ? undefined : this.lines.get(host);
  }

  /** Whether a robot is stopped, by what its host says; null: the host does not say it. */
  stands(robot: string): boolean | null {
    const line = this.lineOf(robot);
    return line?.state === 'open' && line.stopped !== null ? line.stopped.includes(robot) : null;
  }

  /** Lines that are open. */
  get open(): DirectLine[] {
    return [...this.lines.values()].filter((line) => line.state === 'open');
  }

  /** The slowest of the open ones; null: none is measured. */
  get latency_ms(): number | null {
    const measured = this.open.map((line) => line.latency_ms).filter((ms) => ms !== null);
    return measured.length === 0 ? null : Math.max(...measured);
  }

  /** Over the line to the robot's host; without a robot over all lines. Null: there is none. */
  order(order: LineOrder): Promise<LineAnswer> | null {
    if (order.robot !== undefined) {
      const line = this.lineOf(order.robot);
      return line?.state === 'open' ? line.order(order) : null;
    }
    const lines = this.open;
    if (lines.length === 0) return null;
    return Promise.all(lines.map((line) => line.order(order))).then((answers) => {
      const bad = answers.filter((answer) => !answer.good);
      return {
        good: bad.length === 0,
        text: (bad.length > 0 ? bad : answers).map((answer) => answer.text).join('; '),
      };
    });
  }

  private async ask(): Promise<void> {
    if (this.asking || !this.wanted) return;
    this.asking = true;
    try {
      if (this.key === null) {
        this.key = await PageKey.make();
        this.changed.emit();
      }
      const response = await fetch(this.url, {
        method: 'POST',
        headers: {'Content-Type': 'application/json'},
        body: JSON.stringify({key: this.key.point}),
      });
      if (response.ok) this.take((await response.json()) as Tickets, this.key);
      else this.why = await whyNot(response);
    } catch (error) {
      // Without the server the lines that are there continue, with the tickets that they have.
      this.why = this.lines.size > 0 ? '' : String(error);
    }
    this.asking = false;
    this.schedule();
    this.changed.emit();
  }

  private take(tickets: Tickets, key: PageKey): void {
    this.why = '';
    this.relay = tickets.relay;
    this.hosts.clear();
    for (const ticket of tickets.lines) {
      for (const robot of ticket.robots) this.hosts.set(robot, ticket.host);
      const known = this.lines.get(ticket.host);
      if (known !== undefined) {
        known.renew(ticket);
        continue;
      }
      const line = new DirectLine(ticket, key);
      line.changed.on(() => this.look(line));
      this.lines.set(ticket.host, line);
    }
    const told = new Set(tickets.lines.map((ticket) => ticket.host));
    for (const [host, line] of [...this.lines]) {
      if (told.has(host)) continue;
      line.end();
      this.lines.delete(host);
    }
  }

  private look(line: DirectLine): void {
    if (line.state === 'withdrawn') this.schedule(kWithdrawn_ms);
    this.changed.emit();
  }

  /** At half of a ticket's life, or soon while something is missing. */
  private schedule(at_ms?: number): void {
    clearTimeout(this.timer);
    if (!this.wanted) return;
    const first_s = Math.min(...[...this.lines.values()].map((line) => line.ticket.expires));
    const half_ms = Number.isFinite(first_s) ? (first_s * 1000 - Date.now()) / 2 : kQuiet_ms;
    const missing =
      [...this.lines.values()].some((line) => line.state === 'withdrawn') ||
      (this.lines.size === 0 && !this.relay);
    this.timer = setTimeout(
      () => void this.ask(),
      at_ms ?? (missing ? kAgain_ms : Math.max(kAgain_ms, Math.min(kQuiet_ms, half_ms))),
    );
  }

  private end(): void {
    for (const line of this.lines.values()) line.end();
    this.lines.clear();
    this.hosts.clear();
    this.changed.emit();
  }
}

async function whyNot(response: Response): Promise<string> {
  const text = await response.text();
  try {
    return (JSON.parse(text) as {why?: string}).why ?? text;
  } catch {
    return text;
  }
}
