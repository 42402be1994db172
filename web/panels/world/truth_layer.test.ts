// SPDX-License-Identifier: Apache-2.0
import {expect, it} from 'vitest';
import {Placed} from '../../model/pose_history';
import {bothKnown, takePlaces} from './truth_layer';

function placed(flags: number[], x: number[]): Placed {
  const all = new Placed();
  all.resize(flags.length);
  all.flags = Uint16Array.from(flags);
  all.x.set(x);
  return all;
}

it('true poses take the place of reported ones where both are known', () => {
  const reported = placed([1, 17, 0, 1], [1, 2, 3, 4]);
  const truth = placed([1, 0, 1], [1.5, 2.5, 3.5]);
  expect([0, 1, 2, 3].map((slot) => bothKnown(reported, truth, slot))).toEqual([
    true,
    false,
    false,
    false,
  ]);
  takePlaces(reported, truth);
  expect([...reported.x]).toEqual([1.5, 2, 3, 4]);
});
