// SPDX-License-Identifier: Apache-2.0
// What a made-up run consists of: robots, bodies, people and their rights.

export const kTeams = ['north', 'south', 'east', 'scouts'];
export const kRange_m = 4;
export const kRays = 61;
const kClasses = [
  'pose',
  'true_pose',
  'readings',
  'hybrid_parts',
  'obstacles',
  'log',
  'recording',
  'stop',
];

/** A roster of `count` robots: the first `real` of them are real and have a laser. */
export function makeRobots(count, real = 5) {
  return Array.from({length: count}, (_, i) => {
    const isReal = i < real;
    return {
      name: isReal ? `real-${i + 1}` : `walker-${i + 1 - real}`,
      team: isReal ? 'utias' : kTeams[i % kTeams.length],
      kind: isReal ? 'real' : 'simulated',
      word: '',
      recorded: false,
      program: 'wander',
      drivers: ['create'],
      parameters: [
        {
          key: 'program.cruise_mps',
          kind: 'number',
          unit: 'm/s',
          doc: 'How fast it goes.',
          range: [0, 1],
          value: 0.2,
        },
        {
          key: 'program.avoid_m',
          kind: 'number',
          unit: 'm',
          doc: 'From where on it turns away.',
          range: [0, 2],
          value: 0.45,
        },
      ],
      host: `host-${(i % 3) + 1}`,
      shapes: [
        {disc: [0, 0, 0.17], z: [0, 0.12]},
        ...(isReal ? [{disc: [0, 0, 0.04], z: [0.12, 0.5]}] : []),
      ],
      sensors: isReal || count <= 64 ? [laser()] : [],
    };
  });
}

function laser() {
  const bearings = Array.from({length: kRays}, (_, i) => -2 + (4 * i) / (kRays - 1));
  return {
    name: 'laser',
    kind: 'ranges',
    origin: 'virtual',
    driver: 'virtual_laser',
    mount: [0.1, 0, 0],
    z: 0.2,
    period_s: 0.1,
    range: [0.05, kRange_m],
    bearings,
    fields: [{name: 'range_m', label: 'range', unit: 'm', format: 'float32'}],
  };
}

export function makeBodies(half_m) {
  const box = (w, h) => [
    [-w, -h],
    [w, -h],
    [w, h],
    [-w, h],
  ];
  return [
    {
      id: 1,
      name: 'crate',
      kind: 'virtual',
      pose: [-half_m / 3, half_m / 4, 0.4],
      shapes: [{polygon: box(0.5, 0.3), z: [0, 0.5]}],
    },
    {
      id: 2,
      name: 'pond',
      kind: 'virtual',
      pose: [half_m / 3, -half_m / 3, 0],
      shapes: [{disc: [0, 0, 0.5], z: [0, 0.3]}],
    },
    {
      id: 3,
      name: 'tube-1',
      kind: 'landmark',
      pose: [0, half_m / 2, 0],
      shapes: [{disc: [0, 0, 0.04], z: [0, 0.7]}],
      barcode: 23,
    },
    {
      id: 4,
      name: 'wall',
      kind: 'wall',
      pose: [0, -half_m, 0],
      shapes: [{polygon: box(half_m, 0.05), z: [0, 1]}],
    },
  ];
}

/** Who may come in, with everything that is shown of it. */
export function fakeAccounts() {
  const now_s = Math.floor(Date.now() / 1000);
  const person = (name, role, teams, pages, more = {}) => ({
    name,
    role,
    teams,
    guest: false,
    name_given: true,
    disabled: false,
    pages,
    sessions: pages === 0 ? 0 : 1,
    seen_s: now_s - 26 * 3600,
    ...more,
  });
  return {
    type: 'accounts',
    kept: true,
    why_not: '',
    links: 1,
    people: [
      person('Ada N', 'super_user', '*', 2),
      person('ben', 'commander', '*', 1),
      person('carla', 'observer', 'north', 1, {guest: true, name_given: false}),
      person('fatima', 'observer', 'south,west', 0),
      person('gil', 'commander', '-', 0, {disabled: true, seen_s: 0}),
    ],
    invitations: [
      {
        id: 'a1',
        role: 'observer',
        teams: '*',
        uses: 7,
        until_s: now_s + 23 * 3600 + 60,
        by: 'Ada N',
        name: '',
      },
      {
        id: 'a2',
        role: 'commander',
        teams: 'east',
        uses: 1,
        until_s: now_s + 5 * 86400 + 60,
        by: 'operator',
        name: '',
      },
    ],
  };
}

export function fakeAudit() {
  const at = (ago_s) => new Date(Date.now() - 1000 * ago_s).toISOString().slice(0, 19) + 'Z';
  return [
    {time: at(5), what: 'right', user: 'Ada N', detail: 'obstacles of carla: none'},
    {
      time: at(30),
      what: 'refused',
      user: 'carla',
      why: 'order',
      detail: 'goal, 1 robots: Your rights do not include this.',
    },
    {time: at(60), what: 'stop', user: 'ben', detail: '1 robots'},
    {time: at(90), what: 'login', user: 'ben', by: 'password', from: '192.168.1.20'},
    {
      time: at(90000),
      what: 'invitation',
      user: 'Ada N',
      detail: 'made: observer, teams *, 10 uses, 1 days',
    },
  ];
}

/** What each role may see and do, and who is here. */
export function fakeRights() {
  return {
    type: 'rights',
    classes: kClasses,
    teams: kTeams,
    rows: ['observer', 'commander', 'super_user'].map((role, i) => ({
      role,
      cells: Object.fromEntries(
        kClasses.map((what, k) => [
          what,
          i === 2 || k % 3 === 0 ? 'all' : i === 1 ? 'own' : 'none',
        ]),
      ),
    })),
    people: [
      {name: 'carla', role: 'observer', teams: 'north'},
      {name: 'ben', role: 'commander', teams: '*'},
    ],
  };
}

/** What a commander may do who may not change rights. */
export const kCommanderMay = [
  'play',
  'pace',
  'step',
  'stop',
  'release',
  'readings',
  'obstacles',
  'log',
  'command',
  'edit',
  'chat',
];
