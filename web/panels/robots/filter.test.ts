// SPDX-License-Identifier: Apache-2.0
import {describe, expect, it} from 'vitest';
import type {Robot} from '../../protocol/messages';
import {parseFilter} from './filter';

const kRobot: Robot = {
  name: 'walker-3',
  team: 'green',
  kind: 'simulated',
  word: '',
  recorded: false,
  program: 'wander',
  drivers: [],
  shapes: [],
  sensors: [],
};

describe('filter', () => {
  const passes = (text: string, speed = 0.1, flags = 1) =>
    parseFilter(text)({robot: kRobot, speed, flags});

  it('looks at names, teams and states', () => {
    expect(passes('walk')).toBe(true);
    expect(passes('GREEN')).toBe(true);
    expect(passes('real')).toBe(false);
    expect(passes('stale')).toBe(false);
    expect(passes('stale', 0, 3)).toBe(true);
    expect(passes('walker red')).toBe(false);
  });

  it('compares speeds', () => {
    expect(passes('speed < 0.02')).toBe(false);
    expect(passes('speed<0.02', -0.01)).toBe(true);
    expect(passes('green speed > 0.05', -0.1)).toBe(true);
  });
});
