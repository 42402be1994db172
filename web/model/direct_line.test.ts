// SPDX-License-Identifier: Apache-2.0
import {afterEach, beforeEach, expect, it, vi} from 'vitest';
import type {LineTicket} from '../protocol/line';
import {DirectLine} from './direct_line';

/** A WebSocket that a test plays the host of. */
class FakeSocket {
  static readonly OPEN = 1;
  static all: FakeSocket[] = [];
  readyState = 0;
  sent: Record<string, unknown>[] = [];
  onopen: (() => void) | null = null;
  onmessage: ((event: {data: string}) => void) | null = null;
  onclose: ((event: {code: number; reason: string}) => void) | null = null;
  constructor(
    readonly url: string,
    readonly protocol: string,
  ) {
    FakeSocket.all.push(this);
  }
  send(text: string): void {
    this.sent.push(JSON.parse(text) as Record<string, unknown>);
  }
  close(): void {
    this.readyState = 3;
  }
  open(): void {
    this.readyState = 1;
    this.onopen?.();
  }
  say(message: object): void {
    this.onmessage?.({data: JSON.stringify(message)});
  }
  fail(code: number, reason = ''): void {
    this.readyState = 3;
    this.onclose?.({code, reason});
  }
}

const ticket: LineTicket = {
  host: 'left',
  url: 'wss://left:8090/ws',
  ticket: 'T.S',
  expires: 4e9,
  robots: ['r1'],
};
const signer = {sign: (text: string) => Promise.resolve(`signed(${text})`)};
const newest = () => FakeSocket.all[FakeSocket.all.length - 1]!;

async function opened(): Promise<DirectLine> {
  const line = new DirectLine(ticket, signer);
  newest().open();
  newest().say({type: 'challenge', host: 'left', challenge: 'C'});
  await vi.advanceTimersByTimeAsync(0);
  newest().say({type: 'welcome', host: 'left', user: 'anna', until: 4e9});
  return line;
}

beforeEach(() => {
  vi.useFakeTimers();
  FakeSocket.all = [];
  vi.stubGlobal('WebSocket', FakeSocket);
});
afterEach(() => {
  vi.useRealTimers();
  vi.unstubAllGlobals();
});

it('shows its ticket with a proof for the challenge and the address', async () => {
  const line = await opened();
  expect(newest().protocol).toBe('rave.line.1');
  expect(newest().sent[0]).toEqual({
    type: 'hello',
    ticket: 'T.S',
    proof: 'signed(rave line proof 1\nC\nleft:8090\nT.S\n)',
  });
  expect(line.state).toBe('open');
  line.end();
});

it('gives each order its answer, and says that it cannot when the line is lost', async () => {
  const line = await opened();
  const goal = line.order({kind: 'goal', robot: 'r1', points: [[1, 2]]});
  const {id} = newest().sent.at(-1) as {id: number};
  newest().say({type: 'answer', id, good: false, text: '`ben` drives r1'});
  await expect(goal).resolves.toEqual({good: false, text: '`ben` drives r1'});
  const other = line.order({kind: 'cancel', robot: 'r1'});
  newest().fail(1006);
  await expect(other).resolves.toEqual({good: false, text: 'The line to host left was lost.'});
  await expect(line.order({kind: 'stop'})).resolves.toMatchObject({good: false});
  line.end();
});

it('comes back with the same ticket, without anybody', async () => {
  const line = await opened();
  newest().fail(1006);
  expect(line.state).toBe('lost');
  await vi.advanceTimersByTimeAsync(400);
  expect(FakeSocket.all.length).toBe(2);
  newest().open();
  newest().say({type: 'challenge', host: 'left', challenge: 'D'});
  await vi.advanceTimersByTimeAsync(0);
  newest().say({type: 'welcome', host: 'left', user: 'anna', until: 4e9});
  expect(line.state).toBe('open');
  line.end();
});

it('does not try again with a ticket that was withdrawn, until it has another one', async () => {
  const line = await opened();
  newest().fail(4403, 'your rights have changed');
  expect(line.state).toBe('withdrawn');
  await vi.advanceTimersByTimeAsync(60_000);
  expect(FakeSocket.all.length).toBe(1);
  line.renew({...ticket, ticket: 'U.S'});
  expect(FakeSocket.all.length).toBe(2);
  line.end();
});

it('says that a certificate may not be trusted if TLS fails', async () => {
  const line = new DirectLine(ticket, signer);
  newest().fail(1006);
  expect(line.state).toBe('untrusted');
  await vi.advanceTimersByTimeAsync(400);
  expect(FakeSocket.all.length).toBe(2);
  line.end();
});

it('measures how long a ping takes, and takes a silent line for dead', async () => {
  const line = await opened();
  const {id} = newest().sent.at(-1) as {id: number};
  await vi.advanceTimersByTimeAsync(7);
  newest().say({type: 'pong', id});
  expect(line.latency_ms).toBeCloseTo(7, 0);
  await vi.advanceTimersByTimeAsync(6000);
  expect(FakeSocket.all.length).toBe(2);
  line.end();
});
