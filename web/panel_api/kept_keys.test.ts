// SPDX-License-Identifier: Apache-2.0
import {expect, it} from 'vitest';
import {layoutKey, userKey} from './kept_keys';

it('each user, layout and width has an entry of its own', () => {
  const keys = ['ada', 'ben'].flatMap((user) =>
    [700, 1000, 1600].flatMap((width_px) =>
      ['', 'Watch', 'Drive'].map((layout) => layoutKey({user, width_px}, layout)),
    ),
  );
  expect(new Set(keys).size).toBe(18);
  expect(layoutKey({user: 'ada', width_px: 1280}, 'Drive')).toBe('rave.layout.ada.wide.Drive');
  expect(userKey('theme', 'ada')).toBe('rave.theme.ada');
});
