// SPDX-License-Identifier: Apache-2.0
import {describe, expect, it} from 'vitest';
import {Recogniser} from '../../gestures/recogniser';
import type {Point} from '../../protocol/messages';
import {kGestureNames, propose, type Member, type Scene} from './meanings';
import {builtInStrokes} from './strokes';

const member = (slot: number, x: number, y: number, obeys = true): Member => ({
  slot,
  name: `robot-${slot}`,
  at: [x, y],
  yaw: 0,
  radius: 0.2,
  obeys,
});
const square: Point[] = [
  [-1, -1],
  [1, -1],
  [1, 1],
  [-1, 1],
];
const scene = (over: Partial<Scene> = {}): Scene => ({
  members: [member(0, 0, 0), member(1, 0.5, 0.5), member(2, 5, 5), member(3, 0.2, 0, false)],
  selected: [],
  stroke: [],
  middle: [3, 3],
  mayRelease: true,
  ...over,
});

describe('what a gesture means', () => {
  it('gathers those in the circle, or all that obey', () => {
    expect(propose('gather', scene({stroke: square}))).toMatchObject({
      title: 'Circle: gather here',
      detail: 'robot-0 and robot-1 about 0.0, 0.0',
      slots: [0, 1],
    });
    expect(propose('gather', scene()).slots).toEqual([0, 1, 2]);
  });

  it('goes to the corner of the tick, or where the picture is centred', () => {
    const tick: Point[] = [
      [0, 2],
      [1, 1.5],
      [3, 4],
    ];
    expect(propose('go', scene({stroke: tick, selected: [2]})).points).toEqual([[1, 1.5]]);
    expect(propose('go', scene({selected: [2]})).points).toEqual([[3, 3]]);
    expect(propose('go', scene({selected: [3]})).why).toBe('No robot here takes goals from you.');
  });

  it('spreads out: everybody is a metre from everybody', () => {
    const {points, slots} = propose('spread', scene());
    expect(slots).toEqual([0, 1, 2]);
    for (const [i, a] of points.entries())
      for (const b of points.slice(i + 1))
        expect(Math.hypot(a[0] - b[0], a[1] - b[1])).toBeGreaterThan(1);
  });

  it('follows the robot that is selected last, the nearest first', () => {
    expect(propose('follow', scene()).why).toBe('Select the robot that leads.');
    const {slots, points, detail} = propose('follow', scene({selected: [2]}));
    expect(slots).toEqual([0, 1]);
    expect(detail).toContain('behind robot-2');
    expect(points.map(([, y]) => y)).toEqual([5, 5]);
    expect(points[1][0]).toBeGreaterThan(points[0][0]);
    expect(points[1][0]).toBeLessThan(4.5);
    expect(propose('follow', scene({selected: [0, 2]})).slots).toEqual([0]);
  });

  it('stops all, and releases all where the person may', () => {
    expect(propose('stop', scene({mayRelease: false})).why).toBe('');
    expect(propose('release', scene()).why).toBe('');
    expect(propose('release', scene({mayRelease: false})).why).not.toBe('');
  });
});

describe('the strokes that come with the page', () => {
  it('have all gestures, and none is taken for another', () => {
    const strokes = builtInStrokes();
    const recogniser = new Recogniser(strokes);
    expect(new Set(strokes.map(({gesture}) => gesture))).toEqual(new Set(kGestureNames));
    for (const stroke of strokes) {
      const reading = recogniser.read(stroke.points, stroke);
      expect(reading?.first).toBe(stroke.gesture);
      expect(reading?.verdict).not.toBe('none');
    }
  });

  it('do not take a straight line or a zigzag for a gesture', () => {
    const recogniser = new Recogniser(builtInStrokes());
    const line = Array.from({length: 40}, (_, i) => [i, 0.3 * i]);
    const zigzag = Array.from({length: 90}, (_, i) => [i / 90, Math.abs(((i / 7) % 2) - 1)]);
    expect(recogniser.read(line)?.verdict).toBe('none');
    expect(recogniser.read(zigzag)?.verdict).toBe('none');
  });
});
