// SPDX-License-Identifier: Apache-2.0
import {expect, it} from 'vitest';
import type {Stage} from './stage';
import {pressWorldKey} from './world_keys';

/** What a key makes of a stage. */
function pressed(key: string, more: Partial<KeyboardEvent> = {}, turns = false): string[] {
  const done: string[] = [];
  const stage = {
    nudge: (dx: number, dy: number) => done.push(`nudge ${dx} ${dy}`),
    zoomBy: (factor: number) => done.push(`zoom ${factor}`),
    ...(turns ? {turn: (dx: number, dy: number) => done.push(`turn ${dx} ${dy}`)} : {}),
  } as unknown as Stage;
  return pressWorldKey({key, ...more} as KeyboardEvent, stage) ? done : ['nothing'];
}

it('arrows move the picture, plus and minus zoom it', () => {
  expect(pressed('ArrowRight')).toEqual(['nudge 48 0']);
  expect(pressed('ArrowUp', {ctrlKey: true})).toEqual(['nudge 0 -6']);
  expect(pressed('+')).toEqual(['zoom 1.25']);
  expect(pressed('-')).toEqual(['zoom 0.8']);
});

it('Ctrl turns in perspective', () => {
  expect(pressed('ArrowLeft', {ctrlKey: true}, true)).toEqual(['turn -48 0']);
  expect(pressed('ArrowLeft', {}, true)).toEqual(['nudge -48 0']);
});

it('Shift and arrows are left to the joystick, other keys to the page', () => {
  expect(pressed('ArrowUp', {shiftKey: true})).toEqual(['nothing']);
  expect(pressed('+', {ctrlKey: true})).toEqual(['nothing']);
  expect(pressed('f')).toEqual(['nothing']);
  expect(pressed('Enter')).toEqual(['nothing']);
});
