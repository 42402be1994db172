// SPDX-License-Identifier: Apache-2.0
// A made-up run of any size, as messages and frames of the GUI Server, for tests of the page alone.
import {
  fakeAccounts,
  fakeAudit,
  fakeRights,
  kCommanderMay,
  kRays,
  kTeams,
  makeBodies,
  makeRobots,
} from './fake_scene.mjs';

const kPoseHeader = 48;
/** The sensor that stands for what a robot was asked and what is left of it. */
const kCommandsOf = 0xefff;

/** Robots on circles of their own about the middle of their team. */
export class FakeRun {
  constructor(count, options = {}) {
    this.robots = makeRobots(count, options.real ?? Math.min(5, count));
    this.half_m = Math.max(4, 0.6 * Math.sqrt(count));
    this.bodies = makeBodies(this.half_m);
    this.name = options.name ?? 'fake';
    this.duration_s = options.duration_s ?? 120;
    this.source = options.source ?? 'live';
    this.may = options.may ?? kCommanderMay;
    this.role = options.role ?? 'commander';
    this.now_s = options.now_s ?? 0;
    this.state = 'running';
    this.reason = '';
    this.pace = 1;
    this.stopped = new Set();
    /** Robots from this slot on have no pose yet. */
    this.known = options.known ?? Infinity;
    this.components = [];
    /** Velocities that came: slot, m/s, rad/s. */
    this.driven = [];
    /** By slot: what was asked, and what the guard left of it; m/s and rad/s each. */
    this.told = new Map();
    this.drives = new Map(
      this.robots.map((_, slot) => [
        slot,
        {lease: '', takes: ['drive', 'goal', 'path', 'text', 'place'], order: ''},
      ]),
    );
    this.lines = [];
    this.hosts = null;
    this.seenBy = null;
    this.rights = fakeRights();
    this.accounts = fakeAccounts();
    this.audit = fakeAudit();
    this.events = [];
    this.travelled = this.robots.map(() => 0);
  }

  hello() {
    const recorded = 'This is a recording: it takes no orders.';
    const why =
      this.source === 'live'
        ? {seek: 'A live run cannot be moved in time.'}
        : {stop: recorded, release: recorded, command: recorded, edit: recorded};
    const every = [
      'play',
      'seek',
      'pace',
      'step',
      'stop',
      'release',
      'true_pose',
      'readings',
      'hybrid_parts',
      'obstacles',
      'log',
      'recording',
      'command',
      'edit',
      'chat',
      'maps',
      'probe',
    ];
    const why_not = Object.fromEntries(
      every
        .filter((power) => !this.may.includes(power))
        .map((power) => [power, why[power] ?? 'Your rights do not include this.']),
    );
    return {
      type: 'hello',
      protocol: 1,
      server: 'fake 0',
      user: {name: 'Ada N', role: this.role},
      ...(this.seenBy ? {user: this.seenBy.as, seen_by: this.seenBy.by} : {}),
      may: this.may,
      why_not,
      ...(this.components.length ? {components: this.components} : {}),
      run: {
        name: this.name,
        source: this.source,
        clock: 'lock_step',
        started: '',
        step_s: 0.01,
        seed: 1,
        hash: null,
        recording: null,
      },
    };
  }

  time() {
    return {
      type: 'time',
      now_s: this.now_s,
      step: Math.round(this.now_s * 100),
      begin_s: this.source === 'live' ? this.now_s : 0,
      duration_s: this.duration_s,
      end_s: this.source === 'live' ? this.now_s : this.duration_s,
      state: this.state,
      reason: this.reason,
      pace: this.pace,
      speed: this.state === 'running' ? this.pace : 0,
    };
  }

  opening() {
    const all = this.may.includes('obstacles');
    const bodies = this.bodies.filter((body) => all || body.kind !== 'virtual');
    return [
      this.hello(),
      {type: 'scene', bodies, hidden: all ? [] : ['virtual']},
      {type: 'roster', robots: this.robots},
      {type: 'events', reset: true, first: 0, events: this.events},
      this.time(),
      ...(this.hosts ? [{type: 'hosts', hosts: this.hosts}] : []),
      ...(this.may.includes('rights') ? [this.rights, this.accounts] : []),
      ...(this.source === 'live'
        ? [
            this.leases([...this.drives.keys()], true),
            {type: 'chat', reset: true, lines: this.lines},
          ]
        : []),
      {
        type: 'people',
        people: [
          {name: 'Ada N', role: this.role},
          {name: 'Ben K', role: 'observer'},
        ],
      },
    ];
  }

  leases(slots, reset = false) {
    return {
      type: 'leases',
      reset,
      robots: slots.map((slot) => ({
        slot,
        ...this.drives.get(slot),
        yours: this.drives.get(slot).lease === 'Ada N',
      })),
    };
  }

  /** Robots with an even slot take orders of anybody; others are of Ben as long as nobody forces
   * them. */
  command(message) {
    const slots = message.slots ?? [];
    const refused = [];
    for (const slot of slots) {
      const drive = this.drives.get(slot);
      if (message.type === 'lease' && message.do === 'force') drive.lease = 'Ada N';
      else if (message.type === 'lease' && message.do === 'give') drive.lease = message.to ?? '';
      else if (drive.lease !== '' && drive.lease !== 'Ada N') {
        refused.push({slot, text: `\`${drive.lease}\` drives ${this.robots[slot].name}`});
        continue;
      } else if (this.outside(message)) {
        refused.push({slot, text: 'That place is outside the world.'});
        continue;
      } else drive.lease = 'Ada N';
      if (message.kind === 'goal' || message.kind === 'path') {
        const [x, y] =
          message.points[
            message.points.length === slots.length && message.kind === 'goal'
              ? slots.indexOf(slot)
              : message.points.length - 1
          ];
        drive.order = `${message.kind} ${x.toFixed(2)}, ${y.toFixed(2)}`;
      }
      if (message.kind === 'cancel') drive.order = '';
      if (message.kind === 'drive') this.driven.push([slot, message.v, message.w]);
    }
    const to = message.kind ?? message.do ?? message.type;
    return {
      type: 'answer',
      to,
      good: refused.length === 0,
      text: refused[0]?.text ?? `${to}: done`,
      request: message.request,
      ...(refused.length ? {refused} : {}),
    };
  }

  outside(message) {
    return message.points?.some(([x, y]) => Math.hypot(x, y) > 3 * this.half_m) ?? false;
  }

  edit({do: what, name, pose, disc, polygon}) {
    const known = this.bodies.findIndex((body) => body.name === name);
    if (what === 'add') {
      const body = {
        id: 100 + this.bodies.length,
        name,
        kind: 'virtual',
        pose,
        shapes: [{...(disc ? {disc: [0, 0, disc]} : {polygon}), z: [0, 0.5]}],
      };
      this.bodies.push(body);
      return {type: 'scene_change', set: [body], gone: []};
    }
    const body = this.bodies[known];
    if (what === 'remove') {
      this.bodies.splice(known, 1);
      return {type: 'scene_change', set: [], gone: [body.id]};
    }
    this.bodies[known] = {...body, pose};
    return {type: 'scene_change', set: [this.bodies[known]], gone: []};
  }

  say(message, from = {name: 'Ada N', role: 'commander'}) {
    const name = message.to === 'robot' ? this.robots[message.slot].name : (message.name ?? '');
    const line = {
      number: this.lines.length + 1,
      t: this.now_s,
      from,
      yours: from.name === 'Ada N',
      to: message.to,
      name,
      text: message.text,
    };
    this.lines.push(line);
    return {type: 'chat', reset: false, lines: [line]};
  }

  setRight({role, user, class: what, reach}) {
    let row = this.rights.rows.find((known) =>
      user ? known.user === user : known.role === role && !known.user,
    );
    if (!row) this.rights.rows.push((row = {user, cells: {}}));
    if (reach === null) delete row.cells[what];
    else row.cells[what] = reach;
  }

  /** What an account or an invitation becomes; the messages for the page that asked. */
  people(message) {
    const {type, do: what, name, request} = message;
    const {people, invitations} = this.accounts;
    if (type === 'audit') {
      const text = (message.contains ?? '').toLowerCase();
      const lines = this.audit.filter(
        (line) =>
          (!message.what || line.what === message.what) &&
          JSON.stringify(line).toLowerCase().includes(text),
      );
      return [
        {
          type: 'audit_lines',
          request,
          more: lines.length > message.most,
          lines: lines.slice(0, message.most),
        },
        {type: 'answer', to: 'audit', good: true, text: '', request},
      ];
    }
    const answer = {
      type: 'answer',
      to: what,
      good: true,
      text: `${name ?? 'invitation'}: ${what}`,
      request,
    };
    const known = people.find((person) => person.name === name);
    if (what === 'change') Object.assign(known, {role: message.role, teams: message.teams});
    else if (what === 'disable' || what === 'enable')
      Object.assign(known, {disabled: what === 'disable', pages: 0, sessions: 0});
    else if (what === 'end_sessions') Object.assign(known, {pages: 0, sessions: 0});
    else if (what === 'withdraw')
      invitations.splice(
        invitations.findIndex(({id}) => id === message.id),
        1,
      );
    else
      invitations.push({
        id: `b${request}`,
        role: message.role,
        teams: message.teams,
        uses: message.uses,
        until_s: Math.floor(Date.now() / 1000) + message.days * 86400,
        by: 'Ada N',
        name: message.name,
      });
    return [
      this.accounts,
      ...(what === 'make'
        ? [{type: 'invited', request, link: '/join?invite=0123456789abcdef'}]
        : []),
      answer,
    ];
  }

  /** What a super-user is shown as another one; without `as` everything again. */
  seeAs(as) {
    const all = [
      'play',
      'pace',
      'step',
      'stop',
      'release',
      'readings',
      'obstacles',
      'log',
      'rights',
    ];
    this.seenBy = as ? {as, by: {name: 'Ada N', role: 'super_user'}} : null;
    this.may = as ? ['readings', 'log'] : all;
  }

  advance(seconds) {
    if (this.state !== 'running') return;
    this.now_s += seconds * this.pace;
    this.robots.forEach((_, i) => {
      if (!this.stopped.has(i)) this.travelled[i] += seconds * this.pace;
    });
  }

  place(i) {
    const team = i % kTeams.length;
    const golden = i * 2.399963;
    const spread = 0.55 * Math.sqrt(i / kTeams.length + 1);
    const cx =
      this.half_m * 0.45 * Math.cos((team * Math.PI) / 2 + 0.5) + spread * Math.cos(golden);
    const cy =
      this.half_m * 0.45 * Math.sin((team * Math.PI) / 2 + 0.5) + spread * Math.sin(golden);
    const a = golden + (0.2 * this.travelled[i]) / 0.4;
    return [cx + 0.4 * Math.cos(a), cy + 0.4 * Math.sin(a), a + Math.PI / 2];
  }

  frame(sequence) {
    const n = this.robots.length;
    const buffer = new ArrayBuffer(kPoseHeader + 14 * n);
    const view = new DataView(buffer);
    view.setUint8(0, 1);
    view.setUint32(4, sequence, true);
    view.setFloat64(8, this.now_s, true);
    view.setUint32(16, Math.round(this.now_s * 100), true);
    view.setUint32(20, n, true);
    view.setFloat32(40, 1e-4, true);
    const xy = new Int32Array(buffer, kPoseHeader, 2 * n);
    const yaw = new Uint16Array(buffer, kPoseHeader + 8 * n, n);
    const speed = new Int16Array(buffer, kPoseHeader + 10 * n, n);
    const flags = new Uint16Array(buffer, kPoseHeader + 12 * n, n);
    const turn = 2 * Math.PI;
    for (let i = 0; i < n; ++i) {
      const [x, y, a] = this.place(i);
      xy[i] = Math.round(x / 1e-4);
      xy[n + i] = Math.round(y / 1e-4);
      yaw[i] = Math.round(((((a % turn) + turn) % turn) / turn) * 65536) & 0xffff;
      const stopped = this.stopped.has(i);
      speed[i] = stopped || this.state !== 'running' ? 0 : 200;
      flags[i] =
        i >= this.known ? 0 : 1 + (stopped ? 4 : 0) + (this.robots[i].kind === 'real' ? 16 : 0);
    }
    return buffer;
  }

  reading(slot, sensor) {
    if (sensor === kCommandsOf && this.told.has(slot))
      return this.row(slot, sensor, this.told.get(slot));
    const ranges = Array.from({length: kRays}, (_, i) =>
      i % 20 < 12 ? Infinity : 1 + 0.05 * (i % 7),
    );
    return this.row(slot, sensor, ranges, ranges.length, 1);
  }

  row(slot, sensor, values, rows = 1, fields = values.length) {
    const buffer = new ArrayBuffer(32 + 4 * values.length);
    const view = new DataView(buffer);
    view.setUint8(0, 2);
    view.setUint16(2, sensor, true);
    view.setUint32(4, slot, true);
    view.setFloat64(8, this.now_s, true);
    view.setFloat64(16, this.now_s, true);
    view.setUint32(24, rows, true);
    view.setUint32(28, fields, true);
    values.forEach((value, i) => view.setFloat32(32 + 4 * i, value, true));
    return buffer;
  }
}
