// SPDX-License-Identifier: Apache-2.0
import {beforeEach, expect, it} from 'vitest';
import {Kept} from './kept';

beforeEach(() => localStorage.clear());

it('each user has what they kept in each layout', () => {
  const kept = new Kept();
  const places = [
    ['ada', 'Watch'],
    ['ada', 'Drive'],
    ['ben', 'Watch'],
    ['ben', ''],
  ] as const;
  places.forEach(([user, layout], i) => {
    kept.belongTo(user, layout);
    expect(kept.read('world')).toBeNull();
    kept.write('world', {names: i});
  });
  places.forEach(([user, layout], i) => {
    kept.belongTo(user, layout);
    expect(kept.read('world')).toEqual({names: i});
  });
});

it('says when it belongs to another user or layout, and only then', () => {
  const kept = new Kept();
  let told = 0;
  kept.changed.on(() => ++told);
  kept.belongTo('ada', 'Watch');
  kept.belongTo('ada', 'Watch');
  kept.belongTo('ada', 'Drive');
  kept.belongTo('ben', 'Drive');
  expect(told).toBe(3);
});

it('keeps nothing for nobody, and takes nothing that cannot be read', () => {
  const kept = new Kept();
  kept.write('world', 1);
  expect(localStorage.length).toBe(0);
  kept.belongTo('ada', 'Watch');
  localStorage.setItem('rave.world.ada.Watch', '{broken');
  expect(kept.read('world')).toBeNull();
});
