// SPDX-License-Identifier: Apache-2.0
import {expect, it, vi} from 'vitest';
import {Commands, placeOf, spread} from './commands';
import type {Link} from './link';
import {RunModel} from './run_model';
import {Signal} from './signal';

function made() {
  const model = new RunModel();
  const link = {reaches: true, changed: new Signal(), send: vi.fn()};
  return {model, link, commands: new Commands(model, link as unknown as Link)};
}

it('numbers requests and gives each its answer', async () => {
  const {model, link, commands} = made();
  const first = commands.cancel([1]);
  const second = commands.lease('take', [2]);
  expect(link.send.mock.calls.map(([message]) => message.request)).toEqual([1, 2]);
  model.takeMessage({type: 'answer', to: 'take', good: false, text: 'anna drives r1', request: 2});
  model.takeMessage({type: 'answer', to: 'cancel', good: true, text: '', request: 1});
  expect((await first).good).toBe(true);
  expect((await second).text).toBe('anna drives r1');
});

it('refuses a path that no run takes, in the words of runs', async () => {
  const {link, commands} = made();
  const answer = await commands.path(
    [0],
    Array.from({length: 10_000}, (_, i) => [i, 0]),
  );
  expect(answer).toMatchObject({good: false, text: 'a path has 10000 points; expected 2 to 1000'});
  expect(link.send).not.toHaveBeenCalled();
  expect(commands.pending).toMatchObject([
    {
      state: 'refused',
      text: answer.text,
      points: [
        [0, 0],
        [9999, 0],
      ],
    },
  ]);
});

it('draws an order until its robot says that nothing is under way', async () => {
  vi.useFakeTimers();
  const {model, commands} = made();
  const state = (order: string) => ({slot: 0, lease: 'ada', yours: true, takes: ['goal'], order});
  const sent = commands.goal([0], [[1, 2]]);
  expect(commands.pending.map(({state: word}) => word)).toEqual(['sent']);
  model.takeMessage({type: 'leases', reset: false, robots: [state('goal 1.00, 2.00')]});
  model.takeMessage({type: 'answer', to: 'goal', good: true, text: 'r1 goes', request: 1});
  await sent;
  expect(commands.pending.map(({state: word}) => word)).toEqual(['taken']);
  vi.advanceTimersByTime(3000);
  expect(commands.pending).toHaveLength(1);
  model.takeMessage({type: 'leases', reset: false, robots: [state('')]});
  expect(commands.pending).toHaveLength(0);
  vi.useRealTimers();
});

it('keeps a refused order with its reason until it is dropped', async () => {
  const {model, commands} = made();
  const sent = commands.path(
    [0],
    [
      [0, 0],
      [1, 1],
    ],
  );
  model.takeMessage({
    type: 'answer',
    to: 'path',
    good: false,
    text: 'r1 takes no path',
    request: 1,
    refused: [{slot: 0, text: 'r1 takes no path'}],
  });
  await sent;
  expect(commands.pending[0]).toMatchObject({state: 'refused', text: 'r1 takes no path'});
  commands.drop(commands.pending[0]);
  expect(commands.pending).toHaveLength(0);
});

it('answers what was open when the link is lost, and what is asked without one', async () => {
  const {link, commands} = made();
  const open = commands.cancel([0]);
  link.reaches = false;
  link.changed.emit();
  expect(await open).toMatchObject({good: false, text: 'The link was lost.'});
  expect((await commands.cancel([0])).good).toBe(false);
});

it('reads the place of an order', () => {
  expect(placeOf('goal 1.20, -3.40')).toEqual([1.2, -3.4]);
  expect(placeOf('drive')).toBeNull();
});

it('gives the robots of a team places of their own', () => {
  const places = spread([1, 1], [0.2, 0.2, 0.2, 0.2]);
  expect(new Set(places.map(String)).size).toBe(4);
  expect(places.reduce((sum, [x]) => sum + x, 0) / 4).toBeCloseTo(1);
});
