// SPDX-License-Identifier: Apache-2.0
// What a page can ask of a live run, each of a right of its own, and the roles from whom the server
// takes it. Slot 0 is a robot of the commander's team, slot 1 one of another.

const kAll = ['observer', 'commander', 'super_user'];
const kCommanders = ['commander', 'super_user'];
const kSuperUsers = ['super_user'];
let number = 100;
const numbered = (type, more) => ({type, request: ++number, ...more});
/** `time` with a state tells that a transport was done. */
const state =
  (...states) =>
  (message) =>
    message.type === 'time' && states.includes(message.state);
const pace = (value) => (message) => message.type === 'time' && message.pace === value;
const probed = ({type, probes}) =>
  type === 'probes' && {good: probes[0].error === undefined, text: probes[0].error};
const row = (what, from, request, done) => ({what, from, request, done});

/** In an order in which each can be done after those before. */
export const kRequests = [
  row('say', kAll, numbered('say', {to: 'all', text: 'Good morning.'})),
  row('stop own', kCommanders, {type: 'halt', do: 'stop', slots: [0]}),
  row('release own', kCommanders, {type: 'halt', do: 'release', slots: [0]}),
  row('stop other', kCommanders, {type: 'halt', do: 'stop', slots: [1]}),
  row('release other', kSuperUsers, {type: 'halt', do: 'release', slots: [1]}),
  row('lease own', kCommanders, numbered('lease', {do: 'force', slots: [0]})),
  row('goal own', kCommanders, numbered('order', {kind: 'goal', slots: [0], points: [[-1, 0.5]]})),
  row('cancel own', kCommanders, numbered('order', {kind: 'cancel', slots: [0]})),
  row('drive own', kCommanders, numbered('order', {kind: 'drive', slots: [0], v: 0, w: 0})),
  row('goal other', kSuperUsers, numbered('order', {kind: 'goal', slots: [1], points: [[1, 0.5]]})),
  row('lease other', kSuperUsers, numbered('lease', {do: 'take', slots: [1]})),
  row(
    'place own',
    kSuperUsers,
    numbered('order', {kind: 'place', slots: [0], points: [[-1.5, -1]]}),
  ),
  row(
    'edit',
    kSuperUsers,
    numbered('edit', {do: 'add', name: 'parcel', pose: [3, 3, 0], disc: 0.2}),
  ),
  row(
    'probe own',
    kCommanders,
    numbered('look_probes', {
      probes: [
        {slot: 0, name: 'tried', driver: 'virtual_laser', mount: [0, 0, 0], z: 0.1, params: {}},
      ],
    }),
    probed,
  ),
  row('pause', kSuperUsers, {type: 'transport', do: 'pause'}, state('paused')),
  row('step', kSuperUsers, {type: 'transport', do: 'step', value: 1}, state('paused')),
  row('play', kSuperUsers, {type: 'transport', do: 'play'}, state('running')),
  row('pace', kSuperUsers, {type: 'transport', do: 'pace', value: 2}, pace(2)),
  row('rights', kSuperUsers, {type: 'set_right', role: 'commander', class: 'video', reach: 'own'}),
  row('see as', kSuperUsers, {type: 'see_as', role: 'commander'}),
  row('see as oneself', kSuperUsers, {type: 'see_as'}),
  row(
    'invitation',
    kSuperUsers,
    numbered('invitation', {do: 'make', role: 'observer', teams: '-', uses: 1, days: 1}),
    (message) => message.type === 'invited',
  ),
  row(
    'account',
    kSuperUsers,
    numbered('account', {do: 'change', name: 'carl', role: 'commander', teams: 'red'}),
  ),
  row(
    'audit',
    kSuperUsers,
    numbered('audit', {most: 1}),
    (message) => message.type === 'audit_lines',
  ),
];
