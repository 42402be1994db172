// SPDX-License-Identifier: Apache-2.0
import {
  RobotFlag,
  decodeFrame,
  kFirstProbe,
  isMapTile,
  isPoseFrame,
  isVariances,
  type Variance,
} from '../protocol/frames';
import type {
  Accounts,
  Answer,
  AuditLines,
  AuditWritten,
  Body,
  Chat,
  Conduct,
  DriveState,
  Event,
  Hello,
  Host,
  Invited,
  Leases,
  Line,
  People,
  Person,
  Power,
  Rights,
  Robot,
  Roster,
  ServerMessage,
  Time,
} from '../protocol/messages';
import {Maps} from './maps';
import {PoseHistory} from './pose_history';
import {Probes} from './probes';
import {Readings} from './readings';
import {Signal} from './signal';
import {askText, classOf, kNotYours, rightText, withheldText} from './withheld';

/** A robot, with what has become of it since the run began. */
export interface KnownRobot extends Robot {
  /** Its second set of drivers serves: `kind` is of that. */
  handedOver?: boolean;
  /** One of its two sets of drivers is real, the other is not. */
  mixed?: boolean;
}

type OfPeople = People | Rights | Accounts | Invited | AuditLines | AuditWritten | Leases | Chat;

/** What the page knows of the run: the one place that messages and frames go to. */
export class RunModel {
  hello: Hello | null = null;
  time: Time | null = null;
  robots: KnownRobot[] = [];
  bodies = new Map<number, Body>();
  hidden: string[] = [];
  events: Event[] = [];
  hosts: Host[] = [];
  people: Person[] = [];
  /** Who drives what, and the current orders; by slot. */
  drives = new Map<number, DriveState>();
  /** What people said, oldest first. */
  lines: Line[] = [];
  /** Who gets what; of super-users alone. */
  rights: Rights | null = null;
  /** Who may come in and who is here; of super-users alone. */
  accounts: Accounts | null = null;
  /** Runs that the server starts; null: it starts none, or has not said it yet. */
  conduct: Conduct | null = null;
  /** Lines of the audit log that were asked for last. */
  audit: AuditLines | null = null;
  /** A link that was received and not taken yet. */
  private invited: Invited | null = null;
  readonly poses = new PoseHistory();
  /** True poses, as far as they are looked at. */
  readonly truth = new PoseHistory();
  readonly readings = new Readings();
  readonly maps = new Maps();
  readonly probes = new Probes();
  /** By slot, of robots that are looked at and say it. */
  variances: ReadonlyMap<number, Variance> = new Map();

  /** Slots of robots whose kind may change. */
  private mixed: number[] = [];

  readonly runChanged = new Signal();
  readonly timeChanged = new Signal();
  readonly rosterChanged = new Signal();
  readonly sceneChanged = new Signal();
  readonly eventsChanged = new Signal();
  readonly hostsChanged = new Signal();
  readonly peopleChanged = new Signal();
  readonly rightsChanged = new Signal();
  readonly accountsChanged = new Signal();
  readonly conductChanged = new Signal();
  /** The audit log has lines that this page has not received. */
  readonly auditChanged = new Signal();
  readonly drivesChanged = new Signal();
  readonly linesChanged = new Signal();
  /** A frame or a reading arrived: there is something new to draw. */
  readonly pictureChanged = new Signal();
  readonly answered = new Signal<Answer>();

  /** Whether a roster arrived. Before that, an empty `robots` does not mean that the run has no
   * robots. */
  rosterCame = false;

  /** The run is in progress; otherwise what is shown is its recording. */
  get live(): boolean {
    return this.hello?.run.source === 'live';
  }

  may(power: string): boolean {
    return this.hello?.may.some((known) => known === power) ?? false;
  }

  /** This person may command a robot, if it takes orders at all. */
  commands(slot: number): boolean {
    const robot = this.robots[slot];
    return robot !== undefined && this.live && this.may('command') && robot.yours !== false;
  }

  /** This person may stop a robot. */
  stops(slot: number): boolean {
    const robot = this.robots[slot];
    return robot !== undefined && this.live && this.may('stop') && robot.stoppable !== false;
  }

  /** Why this person may not stop a robot, in words; empty if they may. */
  whyNotStopped(slot: number): string {
    if (this.stops(slot) || this.robots[slot] === undefined) return '';
    if (!this.may('stop')) return this.whyNot('stop');
    return `You may not stop ${this.robots[slot].name}. ${rightText('stop', this.others)}`;
  }

  /** The name of the person at this page, also while they look as another person; empty until it is
   * known. */
  get user(): string {
    return (this.hello?.seen_by ?? this.hello?.user)?.name ?? '';
  }

  /** The name that others know this person by: the run calls who has the link of the server the
   * operator. */
  get knownAs(): string {
    const {user} = this;
    const role = (this.hello?.seen_by ?? this.hello?.user)?.role;
    return user === 'you' && role === 'super_user' ? 'the operator' : user;
  }

  /** The people who are here, but for the one at this page. */
  get others(): Person[] {
    const me = this.knownAs;
    return this.people.filter(({name}) => name !== me);
  }

  /** Why a robot does not take something from this person, in words; empty if it does. */
  whyNotTaken(slot: number, what: string): string {
    const robot = this.robots[slot];
    if (robot === undefined) return 'No robot is selected.';
    if (!this.live) return 'This is a recording: it takes no orders.';
    if (!this.may('command')) return this.whyNot('command');
    if (robot.yours === false)
      return `You may not command ${robot.name}. ${rightText('command', this.others)}`;
    if (robot.recorded) return `${robot.name} is recorded: it takes no orders.`;
    const takes = this.drives.get(slot)?.takes ?? [];
    if (takes.includes(what)) return '';
    return takes.length === 0
      ? `${robot.name} takes no orders.`
      : `${robot.name} takes no ${what}; it takes ${takes.join(', ')}.`;
  }

  /** Why something is not allowed, in words; empty if it is. Of what rights withhold: who has it,
   * whom to ask. */
  whyNot(power: Power): string {
    if (this.may(power)) return '';
    if (power === 'rights')
      return `Only super-users see rights, people and the audit log. ${askText(this.others)}`;
    const told = this.hello?.why_not[power] ?? 'Not available.';
    const what = classOf(power);
    return told === kNotYours && what !== null ? withheldText(what, this.others) : told;
  }

  /** Rights withhold it, and not, for instance, that this is a recording. */
  isWithheld(power: Power): boolean {
    return !this.may(power) && this.hello?.why_not[power] === kNotYours;
  }

  /** This person may be shown less than all robots, sensors and maps that there are. The server
   * does not say what is left out, so where something is missing the page says that it may be
   * withheld. */
  get seesLess(): boolean {
    return this.hello !== null && this.hello.user.role !== 'super_user';
  }

  takeMessage(message: ServerMessage): void {
    switch (message.type) {
      case 'hello':
        this.begin(message);
        break;
      case 'scene':
        this.bodies = new Map(message.bodies.map((body) => [body.id, body]));
        this.hidden = message.hidden;
        this.sceneChanged.emit();
        break;
      case 'scene_change':
        for (const body of message.set) this.bodies.set(body.id, body);
        for (const id of message.gone) this.bodies.delete(id);
        this.sceneChanged.emit();
        break;
      case 'time':
        this.time = message;
        this.timeChanged.emit();
        break;
      case 'events':
        if (message.reset) this.events = [];
        message.events.forEach((event, i) => (this.events[message.first + i] = event));
        this.eventsChanged.emit();
        break;
      case 'hosts':
        this.hosts = message.hosts;
        this.hostsChanged.emit();
        break;
      case 'maps':
        this.maps.take(message.maps);
        break;
      case 'catalogue':
        this.probes.takeCatalogue(message);
        break;
      case 'probes':
        // The numbers mean other sensors now.
        this.readings.forgetFrom(kFirstProbe);
        this.probes.take(message);
        break;
      case 'roster':
        this.takeRoster(message);
        break;
      case 'conduct':
        this.conduct = message;
        this.conductChanged.emit();
        break;
      case 'answer':
        this.answered.emit(message);
        break;
      default:
        this.takeOfPeople(message);
    }
  }

  private takeRoster(message: Roster): void {
    this.robots = message.robots;
    this.rosterCame = true;
    for (const robot of this.robots)
      if (robot.twin !== undefined) robot.mixed = robot.twin.kind !== robot.kind;
    this.mixed = this.robots.flatMap((robot, slot) => (robot.mixed === true ? [slot] : []));
    this.poses.clear();
    this.truth.clear();
    this.readings.clear();
    this.rosterChanged.emit();
  }

  /** Who is here, what they may, drive and say. */
  private takeOfPeople(message: OfPeople): void {
    switch (message.type) {
      case 'people':
        this.people = message.people;
        this.peopleChanged.emit();
        break;
      case 'rights':
        this.rights = message;
        this.rightsChanged.emit();
        break;
      case 'accounts':
        this.accounts = message;
        this.accountsChanged.emit();
        break;
      case 'invited':
        this.invited = message;
        break;
      case 'audit_lines':
        this.audit = message;
        break;
      case 'audit_written':
        this.auditChanged.emit();
        break;
      case 'leases':
        if (message.reset) this.drives.clear();
        for (const state of message.robots) this.drives.set(state.slot, state);
        this.drivesChanged.emit();
        break;
      case 'chat':
        this.lines = message.reset ? message.lines : [...this.lines, ...message.lines];
        this.linesChanged.emit();
        break;
    }
  }

  /** The link that a request was answered with, once; null: there is none. */
  takeInvited(request: number | undefined): string | null {
    const told =
      this.invited !== null && this.invited.request === request ? this.invited.link : null;
    this.invited = null;
    return told;
  }

  /** Returns the sequence number to acknowledge, or null. Throws RangeError for a broken frame. */
  takeFrame(buffer: ArrayBuffer, now_ms: number): number | null {
    const frame = decodeFrame(buffer);
    if (isVariances(frame)) {
      this.variances = frame.bySlot;
      this.pictureChanged.emit();
      return null;
    }
    if (isMapTile(frame)) {
      this.maps.add(frame);
      this.pictureChanged.emit();
      return null;
    }
    if (!isPoseFrame(frame)) {
      this.readings.add(frame);
      this.pictureChanged.emit();
      return null;
    }
    if (frame.truth) {
      // The frame of reported poses behind it is what is acknowledged.
      this.truth.add(frame, now_ms);
      return null;
    }
    if (this.mixed.length > 0 && !frame.past) this.followHandOvers(frame.flags);
    const before = this.poses.newest;
    this.poses.add(frame, now_ms, this.time?.state === 'paused');
    // Readings of the moment come before its frame, so those are kept.
    if (before !== null && !frame.past && frame.time_s < before.time_s - 1e-9)
      this.readings.forgetAfter(frame.time_s);
    this.pictureChanged.emit();
    return frame.past ? null : frame.sequence;
  }

  /** A robot that was handed over is what it is now, everywhere. */
  private followHandOvers(flags: Uint16Array): void {
    const changed = this.mixed.filter(
      (slot) =>
        (flags[slot] & RobotFlag.known) !== 0 &&
        ((flags[slot] & RobotFlag.real) !== 0) !== (this.robots[slot].kind === 'real'),
    );
    for (const slot of changed) {
      const robot = this.robots[slot];
      robot.kind = robot.kind === 'real' ? 'simulated' : 'real';
      robot.handedOver = robot.kind === robot.twin?.kind;
    }
    if (changed.length > 0) this.rosterChanged.emit();
  }

  /** A connection begins, or on the same one a live run has become its recording. */
  private begin(hello: Hello): void {
    this.hello = hello;
    this.time = null;
    this.events = [];
    this.hosts = [];
    // Who may not talk any more is not told anew who is here.
    this.people = [];
    this.rights = null;
    this.accounts = null;
    this.audit = null;
    this.drives.clear();
    this.poses.clear();
    this.truth.clear();
    this.readings.clear();
    this.variances = new Map();
    this.maps.clear();
    this.probes.clear();
    this.runChanged.emit();
  }
}
