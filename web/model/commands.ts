// SPDX-License-Identifier: Apache-2.0
import type {
  Answer,
  AskAudit,
  AskConduct,
  ChangeAccount,
  ChangeInvitation,
  Edit,
  HandOver,
  Lease,
  Order,
  PageMessage,
  Point,
  Robot,
  Say,
  SetParameter,
} from '../protocol/messages';
import {Asked} from './asked';
import type {Link} from './link';
import type {RunModel} from './run_model';
import {Signal} from './signal';

/** An order of this page that is drawn until it is done, refused or dropped. */
export interface Pending {
  readonly number: number;
  readonly kind: 'goal' | 'path' | 'place';
  readonly slots: readonly number[];
  readonly points: readonly Point[];
  state: 'sent' | 'taken' | 'refused';
  /** What the run said. */
  text: string;
  /** The robots that refused. */
  refused: readonly number[];
  /** performance.now() of the last change. */
  at_ms: number;
}

type Unnumbered<T> = Omit<T, 'request'>;
type Request =
  | Unnumbered<Order>
  | Unnumbered<Lease>
  | Unnumbered<HandOver>
  | Unnumbered<SetParameter>
  | Unnumbered<Edit>
  | Unnumbered<Say>
  | Unnumbered<ChangeAccount>
  | Unnumbered<ChangeInvitation>
  | Unnumbered<AskAudit>
  | Unnumbered<AskConduct>;

/** A taken order that no robot says it follows is over after so long. */
const kTold_ms = 1200;
/** An answer that a person did not drop goes by itself. */
const kRefused_ms = 12000;

/** As runs take it, wherever orders come in. */
const kMostPathPoints = 1000;

/** What this page asks of robots and obstacles: numbered, each with its answer. */
export class Commands {
  /** Orders that are drawn. */
  pending: Pending[] = [];
  readonly changed = new Signal();
  /** Velocities that this page asked for. */
  readonly asked = new Asked();
  /** For whom the next line of the chat is: `all`, `super-users` and other keys of the panel
   * Chat. */
  addressee = 'all';
  readonly addresseeChanged = new Signal();
  private number = 0;
  private readonly open = new Map<number, (answer: Answer) => void>();
  private roster: readonly Robot[] = [];

  address(key: string): void {
    this.addressee = key;
    this.addresseeChanged.emit();
  }

  constructor(
    private readonly model: RunModel,
    private readonly link: Link,
  ) {
    model.answered.on((answer) => this.take(answer));
    model.drivesChanged.on(() => this.prune());
    model.rosterChanged.on(() => {
      // Slots are others now.
      if (this.roster !== model.robots) {
        this.pending = [];
        this.asked.clear();
      }
      this.roster = model.robots;
      this.changed.emit();
    });
    link.changed.on(() => {
      if (link.reaches) return;
      for (const [request, done] of [...this.open])
        done({type: 'answer', to: 'link', good: false, text: 'The link was lost.', request});
      this.open.clear();
    });
  }

  /** Sends a request; the answer of the run. Never rejects. */
  ask(request: Request): Promise<Answer> {
    const number = ++this.number;
    if (!this.link.reaches)
      return Promise.resolve({
        type: 'answer',
        to: request.type,
        good: false,
        text: 'There is no link to the server.',
        request: number,
      });
    if (request.type === 'order' && request.kind === 'drive')
      this.asked.note(
        request.slots,
        request.v ?? 0,
        request.w ?? 0,
        this.model.poses.newest?.time_s ?? 0,
      );
    return new Promise((done) => {
      this.open.set(number, done);
      this.link.send({...request, request: number} as PageMessage);
    });
  }

  /** Sends robots to a place: one point for all, or one for each. */
  goal(slots: readonly number[], points: Point[], yaw?: number): Promise<Answer> {
    return this.track('goal', slots, points, {
      type: 'order',
      kind: 'goal',
      slots: [...slots],
      points,
      ...(yaw === undefined ? {} : {yaw}),
    });
  }

  path(slots: readonly number[], points: Point[]): Promise<Answer> {
    if (points.length < 2 || points.length > kMostPathPoints) {
      // Only its ends are drawn, with the reason beside them.
      const order = this.begin('path', slots, [...points.slice(0, 1), ...points.slice(-1)]);
      ++this.number;
      return Promise.resolve(
        this.end(order, {
          type: 'answer',
          to: 'path',
          good: false,
          text: `a path has ${points.length} points; expected 2 to ${kMostPathPoints}`,
        }),
      );
    }
    return this.track('path', slots, points, {
      type: 'order',
      kind: 'path',
      slots: [...slots],
      points,
    });
  }

  place(slot: number, point: Point, yaw?: number): Promise<Answer> {
    return this.track('place', [slot], [point], {
      type: 'order',
      kind: 'place',
      slots: [slot],
      points: [point],
      ...(yaw === undefined ? {} : {yaw}),
    });
  }

  cancel(slots: readonly number[]): Promise<Answer> {
    this.pending = this.pending.filter(
      (order) => !order.slots.every((slot) => slots.includes(slot)),
    );
    this.changed.emit();
    return this.ask({type: 'order', kind: 'cancel', slots: [...slots]});
  }

  lease(what: 'take' | 'force' | 'give', slots: readonly number[], to?: string): Promise<Answer> {
    return this.ask({
      type: 'lease',
      do: what,
      slots: [...slots],
      ...(to === undefined ? {} : {to}),
    });
  }

  /** The person has read why it was refused. */
  drop(order: Pending): void {
    this.pending = this.pending.filter((other) => other !== order);
    this.changed.emit();
  }

  private async track(
    kind: Pending['kind'],
    slots: readonly number[],
    points: readonly Point[],
    request: Request,
  ): Promise<Answer> {
    const order = this.begin(kind, slots, points);
    return this.end(order, await this.ask(request));
  }

  private begin(
    kind: Pending['kind'],
    slots: readonly number[],
    points: readonly Point[],
  ): Pending {
    const order: Pending = {
      number: this.number + 1,
      kind,
      slots,
      points,
      state: 'sent',
      text: '',
      refused: [],
      at_ms: performance.now(),
    };
    // The newest order of a robot goes before older ones.
    this.pending = [
      ...this.pending.filter((other) => !other.slots.every((slot) => slots.includes(slot))),
      order,
    ];
    this.changed.emit();
    return order;
  }

  private end(order: Pending, answer: Answer): Answer {
    const {kind, slots} = order;
    order.refused = answer.refused?.map(({slot}) => slot) ?? (answer.good ? [] : slots);
    order.state = order.refused.length < slots.length ? 'taken' : 'refused';
    order.text = answer.text;
    order.at_ms = performance.now();
    if (kind === 'place' && answer.good)
      this.pending = this.pending.filter((other) => other !== order);
    this.changed.emit();
    setTimeout(() => this.prune(), order.state === 'refused' ? kRefused_ms + 50 : kTold_ms + 50);
    return answer;
  }

  /** Leaves out what is done: no robot reports it as its current order any more. */
  private prune(): void {
    const now_ms = performance.now();
    const kept = this.pending.filter((order) => {
      if (order.state === 'sent') return true;
      if (order.state === 'refused') return now_ms - order.at_ms < kRefused_ms;
      return (
        now_ms - order.at_ms < kTold_ms ||
        order.slots.some((slot) => (this.model.drives.get(slot)?.order ?? '') !== '')
      );
    });
    if (kept.length === this.pending.length) return;
    this.pending = kept;
    this.changed.emit();
  }

  private take(answer: Answer): void {
    const done = this.open.get(answer.request ?? -1);
    if (done === undefined) return;
    this.open.delete(answer.request ?? -1);
    done(answer);
  }
}

/** Where the current order of a robot goes; null if it names no place. */
export function placeOf(order: string): Point | null {
  const found = [...order.matchAll(/(-?\d+(?:\.\d+)?), (-?\d+(?:\.\d+)?)/g)].pop();
  return found === undefined ? null : [Number(found[1]), Number(found[2])];
}

/** Places for a team about a goal, so that its robots do not fight for one: a grid, in the order of
 * the slots. */
export function spread(centre: Point, radii: readonly number[]): Point[] {
  const step = 2.6 * Math.max(0.1, ...radii);
  const across = Math.ceil(Math.sqrt(radii.length));
  const down = Math.ceil(radii.length / across);
  return radii.map((_, i) => [
    centre[0] + step * ((i % across) - (across - 1) / 2),
    centre[1] - step * (Math.floor(i / across) - (down - 1) / 2),
  ]);
}
