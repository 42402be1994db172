// SPDX-License-Identifier: Apache-2.0
import {expect, it, vi} from 'vitest';
import type {PanelContext, PanelElement} from '../panel_api';
import {LoadedComponent} from './component_loader';

const context = {} as PanelContext;
class Panel extends HTMLElement {}
const panels = [
  {id: 'heat', title: 'Heat map', element: Panel as unknown as new () => PanelElement},
];

it('makes a kind of each panel, under a tag of its own', async () => {
  const loaded = new LoadedComponent('heat_map', 'components/0/heat_map.js', context, () =>
    Promise.resolve({component: {api: 1, name: 'heat_map', version: '1.2', panels}}),
  );
  await loaded.load();
  expect(loaded.error).toBe('');
  expect(loaded.kinds().map(({id, title}) => [id, title])).toEqual([['heat_map/heat', 'Heat map']]);
  expect(loaded.makers.get('heat')?.()).toBeInstanceOf(Panel);
});

it.each([
  [{}, 'does not export `component`'],
  [{component: {api: 2, name: 'a', version: '1'}}, 'interface 2 of panels; this page has 1'],
])('says why a module is no component', async (module, why) => {
  const loaded = new LoadedComponent('a', 'a.js', context, () => Promise.resolve(module));
  await loaded.load();
  expect(loaded.error).toContain(why);
  expect(loaded.kinds()).toHaveLength(1);
});

it('takes back what a component added before it loads it again, from another address', async () => {
  const back = vi.fn();
  const fetch = vi.fn((_: string) =>
    Promise.resolve({component: {api: 1, name: 'a', version: '1', extend: () => back}}),
  );
  const loaded = new LoadedComponent('a', 'a.js', context, fetch);
  await loaded.load();
  expect(back).not.toHaveBeenCalled();
  await loaded.load();
  expect(back).toHaveBeenCalledOnce();
  expect(fetch.mock.calls[0][0]).not.toBe(fetch.mock.calls[1][0]);
});
