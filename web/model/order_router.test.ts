// SPDX-License-Identifier: Apache-2.0
import {expect, it, vi} from 'vitest';
import type {LineAnswer, LineOrder} from '../protocol/line';
import type {DirectLines, Way} from './direct_lines';
import {OrderRouter} from './order_router';
import type {RunModel} from './run_model';

/** Robots r0 and r1 have a line, r2 has none. */
function made(answer: LineAnswer = {good: true, text: 'done'}) {
  const asked: LineOrder[] = [];
  const told: object[] = [];
  const lines = {
    way: (robot: string): Way => (robot === 'r2' ? 'relay' : 'direct'),
    order: (order: LineOrder) => {
      asked.push(order);
      return order.robot === 'r2' ? null : Promise.resolve(answer);
    },
  } as unknown as DirectLines;
  const model = {
    robots: [{name: 'r0'}, {name: 'r1'}, {name: 'r2'}],
    takeMessage: (message: object) => told.push(message),
  } as unknown as RunModel;
  return {router: new OrderRouter(model, lines), asked, told};
}

const flush = () => vi.waitFor(() => Promise.resolve());

it('leaves what is no order alone', () => {
  const {router} = made();
  const look = {type: 'look', poses: true};
  expect(router.route(look)).toBe(look);
});

it('sends an order straight to robots with a line, and answers as the server does', async () => {
  const {router, asked, told} = made();
  expect(
    router.route({type: 'order', request: 5, kind: 'drive', slots: [0], v: 0.5, w: 0}),
  ).toBeNull();
  expect(asked).toEqual([{kind: 'drive', robot: 'r0', v: 0.5, w: 0, echo: true}]);
  await flush();
  expect(told).toEqual([{type: 'answer', to: 'drive', request: 5, good: true, text: 'done'}]);
});

it('splits an order, each robot with its own point', () => {
  const {router, asked} = made();
  const message = {
    type: 'order',
    request: 6,
    kind: 'goal' as const,
    slots: [2, 1],
    points: [
      [1, 1],
      [2, 2],
    ] as [number, number][],
  };
  expect(router.route(message)).toEqual({...message, slots: [2], points: [[1, 1]]});
  expect(asked).toEqual([{kind: 'goal', robot: 'r1', points: [[2, 2]]}]);
});

it('leaves everything to the server where no robot has a line', () => {
  const {router, asked} = made();
  const message = {type: 'lease', request: 7, do: 'take', slots: [2]};
  expect(router.route(message)).toBe(message);
  expect(asked).toEqual([]);
});

it('says which robot refused', async () => {
  const {router, told} = made({good: false, text: '`ben` drives it'});
  router.route({type: 'lease', request: 8, do: 'force', slots: [1]});
  await flush();
  expect(told).toEqual([
    {
      type: 'answer',
      to: 'lease',
      request: 8,
      good: false,
      text: '`ben` drives it',
      refused: [{slot: 1, text: '`ben` drives it'}],
    },
  ]);
});

it('sends a stop by all ways', () => {
  const {router, asked} = made();
  const stop = {type: 'halt', do: 'stop', slots: []};
  expect(router.route(stop)).toBe(stop);
  expect(asked).toEqual([{kind: 'stop'}]);
});
