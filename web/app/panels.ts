// SPDX-License-Identifier: Apache-2.0
import type {RunModel} from '../model/run_model';
import {classOf, kUsualRights} from '../model/withheld';
import type {PanelKind} from '../panel_api';
import '../panels/chat/chat_panel';
import '../panels/hosts/hosts_panel';
import '../panels/joystick/joystick_panel';
import '../panels/log/log_panel';
import '../panels/map/map_panel';
import '../panels/people/super_user_panel';
import '../panels/probe/probe_panel';
import '../panels/robot/robot_panel';
import '../panels/robots/robots_panel';
import '../panels/sensors/sensors_panel';
import '../panels/world/world_panel';

/** The panels that come with the page, in the order of their keys. A new one has its import above
 * and its entry here. Nothing else names it, unless a layout opens it at first (dock.ts). */
export const kPanels: readonly PanelKind[] = [
  {id: 'world', title: 'World View', icon: 'compass', tag: 'rave-world', short: 'World'},
  {
    id: 'robots',
    title: 'Robots',
    icon: 'bot',
    tag: 'rave-robots',
    short: 'Robots',
    count: ({model}) => model.robots.length,
  },
  {id: 'sensors', title: 'Sensor Display', icon: 'radar', tag: 'rave-sensors', short: 'Sensors'},
  {id: 'robot', title: 'Robot', icon: 'activity', tag: 'rave-robot', live: true},
  {
    id: 'joystick',
    title: 'Joystick',
    icon: 'joystick',
    tag: 'rave-joystick',
    needs: 'command',
    live: true,
    beside: 'robots',
  },
  {id: 'chat', title: 'Chat', icon: 'message', tag: 'rave-chat', short: 'Chat'},
  {id: 'log', title: 'Log & alerts', icon: 'list', tag: 'rave-log', short: 'Log'},
  {
    id: 'hosts',
    title: 'Hosts',
    icon: 'server',
    tag: 'rave-hosts',
    count: ({model}) => model.hosts.length,
  },
  {
    id: 'rights',
    title: 'Super-User',
    icon: 'shield',
    tag: 'rave-super-user',
    needs: 'rights',
    short: 'People',
  },
  {
    id: 'probe',
    title: 'Probe',
    icon: 'flask',
    tag: 'rave-probe',
    needs: 'probe',
    live: true,
    beside: 'sensors',
  },
  {id: 'map', title: 'Map', icon: 'map', tag: 'rave-map', needs: 'maps', beside: 'sensors'},
];

/** Panels that the run brings along. */
const components: PanelKind[] = [];

export function addPanelKind(kind: PanelKind): void {
  components.push(kind);
}

/** All kinds, whether this person may see them or not. */
export function allPanels(): readonly PanelKind[] {
  return [...kPanels, ...components];
}

/** Panels of information that rights withhold: each says so, and whom to ask. What a role may not
 * do is not offered. */
export function withheldPanels(model: RunModel): PanelKind[] {
  return allPanels().filter(({needs, live}) => {
    const what = needs === undefined ? null : classOf(needs);
    return (
      what !== null &&
      kUsualRights[what].to === 'see' &&
      needs !== undefined &&
      model.isWithheld(needs) &&
      (live !== true || model.live)
    );
  });
}

/** Those that this person may see. */
export function panelsFor(model: RunModel): PanelKind[] {
  return [...kPanels, ...components].filter(
    (kind) =>
      (kind.needs === undefined || model.may(kind.needs)) && (kind.live !== true || model.live),
  );
}
