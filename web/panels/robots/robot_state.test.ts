// SPDX-License-Identifier: Apache-2.0
import {expect, it} from 'vitest';
import type {Robot} from '../../protocol/messages';
import {stoppable} from './robot_state';

function robot(team: string, recorded = false): Robot {
  return {
    name: '',
    team,
    kind: 'simulated',
    word: '',
    recorded,
    program: '',
    drivers: [],
    shapes: [],
    sensors: [],
  };
}

it('a stop of a team means its own robots, but for recorded ones and those of others', () => {
  expect(
    stoppable([robot('green'), robot('red'), robot('green', true), robot('green')], 'green'),
  ).toEqual([0, 3]);
  expect(stoppable([{...robot('green'), stoppable: false}, robot('green')], 'green')).toEqual([1]);
  expect(stoppable([], 'green')).toEqual([]);
});
