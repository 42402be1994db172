// SPDX-License-Identifier: Apache-2.0
import type {SerializedDockview} from 'dockview-core';
import {expect, it} from 'vitest';
import {bringHome} from './kept_layout';

const leaf = (id: string, views: string[], more = {}) => ({
  type: 'leaf',
  size: 300,
  data: {views, id, ...more},
});
const box = {left: 1920, top: 0, width: 800, height: 600};

function layout(leaves: object[], popouts: object[], activeGroup = '1'): SerializedDockview {
  return {
    grid: {
      root: {type: 'branch', data: leaves},
      width: 900,
      height: 600,
      orientation: 'HORIZONTAL',
    },
    panels: {},
    activeGroup,
    popoutGroups: popouts,
  } as unknown as SerializedDockview;
}
const groups = (home: SerializedDockview) =>
  (
    home.grid.root as unknown as {
      data: {visible?: boolean; data: {id: string; views: string[]; activeView?: string}}[];
    }
  ).data;

it('a group that had a window is in its place again, and shown', () => {
  const kept = bringHome(
    layout(
      [leaf('1', ['world'], {activeView: 'world'}), {...leaf('2', []), visible: false}],
      [
        {
          data: {id: '3', views: ['log', 'hosts'], activeView: 'hosts'},
          gridReferenceGroup: '2',
          position: box,
        },
      ],
      '3',
    ),
  );
  expect(kept.windows).toEqual([{panels: ['log', 'hosts'], box}]);
  expect(groups(kept.layout)[1]?.data).toEqual({
    id: '2',
    views: ['log', 'hosts'],
    activeView: 'hosts',
  });
  expect(groups(kept.layout)[1]).not.toHaveProperty('visible');
  expect(kept.layout.popoutGroups).toBeUndefined();
  expect(kept.layout.activeGroup).toBeUndefined();
});

it('one panel of several joins those that stayed', () => {
  const kept = bringHome(
    layout(
      [leaf('1', ['world', 'log'], {activeView: 'log'})],
      [
        {
          data: {id: '3', views: ['map'], activeView: 'map'},
          gridReferenceGroup: '1',
          position: null,
        },
      ],
    ),
  );
  expect(groups(kept.layout)[0]?.data).toEqual({
    id: '1',
    views: ['world', 'log', 'map'],
    activeView: 'log',
  });
  expect(kept.layout.activeGroup).toBe('1');
});

it('without its place a panel goes to the first one', () => {
  const kept = bringHome(
    layout([leaf('1', ['world'])], [{data: {id: '3', views: ['map']}, position: box}]),
  );
  expect(groups(kept.layout)[0]?.data.views).toEqual(['world', 'map']);
});

it('a layout without windows stays as it is', () => {
  const plain = layout([leaf('1', ['world'])], []);
  expect(bringHome(plain).windows).toEqual([]);
  expect(groups(bringHome(plain).layout)).toEqual(groups(plain));
});
