// SPDX-License-Identifier: Apache-2.0
import type {PanelKind} from '../panel_api';

/** The panels that come with the page, in the order of their keys. */
export const kPanels: readonly PanelKind[] = [
  {id: 'world', title: 'World View', icon: 'compass', tag: 'rave-world', phone: true},
  {id: 'robots', title: 'Robots', icon: 'bot', tag: 'rave-robots', phone: true, count: ({model}) => model.robots.length},
  {id: 'sensors', title: 'Sensor Display', icon: 'radar', tag: 'rave-sensors', phone: true},
  {id: 'log', title: 'Log & alerts', icon: 'list', tag: 'rave-log', phone: true},
  {id: 'hosts', title: 'Hosts', icon: 'server', tag: 'rave-hosts', phone: true, count: ({model}) => model.hosts.length},
];
