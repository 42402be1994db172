// SPDX-License-Identifier: Apache-2.0
import type {RunModel} from '../model/run_model';
import type {Selection} from '../panel_api/selection';
import type {JoystickPanel} from '../panels/joystick/joystick_panel';
import {kWorldKeys} from '../panels/world/world_keys';
import type {WorldPanel} from '../panels/world/world_panel';
import {panelKey, type KeyAction} from './keys';
import {panelsFor} from './panels';
import type {RunBar} from './run_bar';

/** What keys act on. A panel is asked for when the key is pressed: it comes and goes. */
export interface KeyTargets {
  readonly model: RunModel;
  readonly selection: Selection;
  bar(): RunBar | null;
  world(): WorldPanel | null;
  joystick(): JoystickPanel | null;
  show(panel: string): void;
  find(): void;
  list(): void;
  escape(): void;
}

/** The keys of the page, in the order of their list. */
export function pageKeys(page: KeyTargets): KeyAction[] {
  const {model, selection} = page;
  return [
    model.live
      ? {
          keys: ['Space'],
          what: 'twice: STOP all robots',
          act: (event: KeyboardEvent) => page.bar()?.space(event),
        }
      : {
          keys: ['Space'],
          what: 'play or pause',
          act: (event: KeyboardEvent) => page.bar()?.space(event),
        },
    {keys: ['K'], what: 'pause, resume', act: () => page.bar()?.toggle()},
    {keys: ['.'], what: 'step forward', act: () => page.bar()?.stepBy(1)},
    {keys: [','], what: 'step back (replay)', act: () => page.bar()?.stepBy(-1)},
    {keys: ['J'], what: 'slower', act: () => page.bar()?.changePace(-1)},
    {keys: ['L'], what: 'faster', act: () => page.bar()?.changePace(1)},
    {keys: ['['], what: 'previous event', act: () => page.bar()?.toEvent(-1)},
    {keys: [']'], what: 'next event', act: () => page.bar()?.toEvent(1)},
    {keys: ['Ctrl K', '/'], what: 'find anything', act: page.find},
    {
      keys: ['F'],
      what: 'show everything; press again: the selection',
      act: () => page.world()?.fit(),
    },
    {
      keys: ['C'],
      what: 'follow the selected robot',
      act: () => selection.follow(!selection.following),
    },
    {keys: ['T'], what: 'top view, 3-D', act: () => page.world()?.toggleMode()},
    {
      keys: ['Z'],
      what: 'lens, while held',
      act: () => page.world()?.lens(true),
      end: () => page.world()?.lens(false),
    },
    {keys: ['M'], what: 'measure', act: () => page.world()?.toggleMeasure()},
    {keys: ['P'], what: 'save a picture', act: () => page.world()?.picture()},
    ...kWorldKeys.map((of) => ({...of, act: () => {}})),
    ...orderKeys(page),
    ...panelsFor(model)
      .slice(0, 19)
      .map((kind, i) => ({
        keys: panelKey(i),
        what: kind.title,
        act: () => page.show(kind.id),
      })),
    {keys: ['?'], what: 'this list', act: () => page.list()},
    {keys: ['Escape'], what: 'cancel, close or deselect', act: () => page.escape()},
  ];
}

/** Tools and the stick, for those who command. */
function orderKeys(page: KeyTargets): KeyAction[] {
  const {model} = page;
  if (!model.live || !model.may('command')) return [];
  const tool = (key: string, what: string, name: WorldPanel['tool']) => ({
    keys: [key],
    what,
    act: () => page.world()?.chooseTool(name),
  });
  const stick = ['ArrowUp', 'ArrowDown', 'ArrowLeft', 'ArrowRight'].map((key, i) => ({
    keys: [`Shift ${key}`],
    what: ['drive', 'drive backwards', 'turn left', 'turn right'][i],
    act: () => page.joystick()?.drive(key, true),
    end: () => page.joystick()?.drive(key, false),
  }));
  return [
    tool('V', 'select', 'select'),
    tool('G', 'goal', 'goal'),
    tool('W', 'path', 'path'),
    ...(model.may('edit')
      ? [
          tool('O', 'obstacle', 'obstacle'),
          tool('B', 'place a robot', 'place'),
          {
            keys: ['Delete'],
            what: 'remove the selected obstacle',
            act: () => page.world()?.removeBody(),
          },
        ]
      : []),
    {keys: ['Enter'], what: 'send the drawn order', act: () => page.world()?.sendDraft()},
    ...stick,
  ];
}
