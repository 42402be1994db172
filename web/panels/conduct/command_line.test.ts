// SPDX-License-Identifier: Apache-2.0
import {expect, test} from 'vitest';
import {completions, readLine} from './command_line';

const read = (line: string) => readLine(line, ['flock', 'convoy']);

test('lines ask what the terminal would', () => {
  expect(read('start flock --seed 7')).toEqual({
    conduct: {type: 'conduct', do: 'start', name: 'flock', seed: 7},
  });
  expect(read(' end ')).toEqual({conduct: {type: 'conduct', do: 'end'}});
  expect(read('restart --seed 2')).toEqual({conduct: {type: 'conduct', do: 'restart', seed: 2}});
  expect(read('step 5')).toEqual({transport: {type: 'transport', do: 'step', value: 5}});
  expect(read('pace max')).toEqual({transport: {type: 'transport', do: 'pace', value: 0}});
  expect(read('pace 2x')).toEqual({transport: {type: 'transport', do: 'pace', value: 2}});
  expect(read('scenarios')).toEqual({text: 'flock, convoy'});
});

test('a wrong line says what was expected', () => {
  for (const [line, text] of [
    ['strat flock', 'there is no command `strat`'],
    ['start', '`start`: expected a name'],
    ['start flock convoy', '`start`: unexpected `convoy`'],
    ['end --seed 1', '`end` takes no seed'],
    ['start flock --seed -1', '`--seed`: expected a whole number'],
    ['step 0', '`step`: expected a whole number from 1'],
    ['pace fast', '`pace`: expected a factor'],
  ])
    expect(read(line)).toEqual({error: expect.stringContaining(text)});
});

test('the beginning of a command is completed', () => {
  expect(completions('re').map(([usage]) => usage.split(' ')[0])).toEqual(['restart', 'resume']);
  expect(completions('start f')).toEqual([]);
});
