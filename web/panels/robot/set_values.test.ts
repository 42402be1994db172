// SPDX-License-Identifier: Apache-2.0
import {expect, it} from 'vitest';
import {RunModel} from '../../model/run_model';
import {SetValues} from './set_values';

it('shows what was asked until the run tells what holds', () => {
  const values = new SetValues();
  expect(values.shown('r v', 0.2)).toBe(0.2);
  values.ask('r v', 0.3, 0.2);
  expect(values.shown('r v', 0.2)).toBe(0.3);
  expect(values.shown('r v', 0.3)).toBe(0.3);
  // Somebody else sets it.
  expect(values.shown('r v', 0.9)).toBe(0.9);
  expect(values.shown('r v', 0.2)).toBe(0.2);
  values.ask('r v', 5, 0.2);
  values.refuse('r v');
  expect(values.shown('r v', 0.2)).toBe(0.2);
});

it('has what was set before the page came', () => {
  const model = new RunModel();
  model.takeMessage({
    type: 'leases',
    reset: true,
    robots: [
      {slot: 2, lease: '', yours: false, takes: [], order: '', values: {'program.v_mps': 0.7}},
    ],
  });
  expect(model.drives.get(2)?.values?.['program.v_mps']).toBe(0.7);
});
