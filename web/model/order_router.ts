// SPDX-License-Identifier: Apache-2.0
import type {Answer, ServerMessage} from '../protocol/messages';
import type {LineAnswer, LineOrder, LinePedals} from '../protocol/line';
import type {DirectLines} from './direct_lines';
import type {RunModel} from './run_model';

/** What pages ask of robots, as they would say it to the server. */
interface Routed extends Partial<LinePedals> {
  type: string;
  request?: number;
  kind?: LineOrder['kind'];
  do?: string;
  slots?: readonly number[];
  points?: readonly [number, number][];
  v?: number;
  w?: number;
  vy?: number;
  yaw?: number;
  speed?: number;
  text?: string;
  to?: string;
}

/** What a drive has beside both velocities. */
function wide({vy, steering, throttle, brake, gear}: Routed): Partial<LineOrder> {
  return {
    ...(vy === undefined ? {} : {vy}),
    ...(throttle === undefined ? {} : {steering, throttle, brake, gear}),
  };
}

/** Sends by the direct lines what can go there. */
export class OrderRouter {
  constructor(
    private readonly model: RunModel,
    readonly lines: DirectLines,
  ) {}

  /** What is left for the server; null: nothing. */
  route<T extends {type: string}>(message: T): T | null {
    const routed = message as T & Routed;
    if (routed.type === 'halt') return this.halt(routed);
    // To place a robot is an edit of the world, which the server has the rights of.
    if ((routed.type !== 'order' && routed.type !== 'lease') || routed.kind === 'place')
      return message;
    const slots = routed.slots ?? [];
    const rest = slots.filter((slot) => this.lines.way(this.name(slot)) !== 'direct');
    if (rest.length === slots.length) return message;
    void this.send(routed, slots, rest);
    return rest.length === 0 ? null : {...message, slots: rest, ...this.pointsOf(routed, rest)};
  }

  private name(slot: number): string {
    return this.model.robots[slot]?.name ?? '';
  }

  /** A stop goes by all ways: the fastest counts, and twice does no harm. */
  private halt<T extends Routed>(message: T): T | null {
    const kind = message.do === 'release' ? 'release' : 'stop';
    const slots = message.slots ?? [];
    const robots = slots.length === 0 ? [undefined] : slots.map((slot) => this.name(slot));
    const direct = robots
      .map((robot) => this.lines.order(robot === undefined ? {kind} : {kind, robot}))
      .filter((answer) => answer !== null);
    if (direct.length > 0 && !this.serverIsThere())
      void this.tell(kind, undefined, slots, Promise.all(direct));
    return message;
  }

  /** Set by the link. */
  serverIsThere: () => boolean = () => true;

  private async send(
    message: Routed,
    slots: readonly number[],
    rest: readonly number[],
  ): Promise<void> {
    const direct = slots.filter((slot) => !rest.includes(slot));
    const answers = direct.map(
      (slot) =>
        this.lines.order(this.orderOf(message, slot)) ??
        Promise.resolve({good: false, text: 'The line was lost.'}),
    );
    const kind = message.kind ?? message.type;
    // Of one that goes both ways, the server answers unless something went wrong here.
    await this.tell(kind, message.request, direct, Promise.all(answers), rest.length > 0);
  }

  private async tell(
    to: string,
    request: number | undefined,
    slots: readonly number[],
    answers: Promise<LineAnswer[]>,
    quiet = false,
  ): Promise<void> {
    const all = await answers;
    const refused = all.flatMap((answer, i) =>
      answer.good ? [] : [{slot: slots[i] ?? 0, text: answer.text}],
    );
    if (quiet && refused.length === 0) return;
    const answer = {
      type: 'answer',
      to,
      good: refused.length === 0,
      text: (refused.length === 0 ? all : refused)
        .map((one) => one.text)
        .filter((text, i, texts) => texts.indexOf(text) === i)
        .join('; '),
      ...(request === undefined ? {} : {request}),
      ...(refused.length === 0 || slots.length === 0 ? {} : {refused}),
    };
    this.model.takeMessage(answer as Answer as ServerMessage);
  }

  private orderOf(message: Routed, slot: number): LineOrder {
    const robot = this.name(slot);
    if (message.type === 'lease') {
      if (message.do === 'give')
        return {kind: 'give', robot, ...(message.to ? {to: message.to} : {})};
      return {kind: 'take', robot, force: message.do === 'force'};
    }
    const {kind, v, w, yaw, speed, text} = message;
    const points = this.pointsOf(message, [slot]).points;
    return {
      kind: kind ?? 'cancel',
      robot,
      ...(kind === 'drive' ? {v: v ?? 0, w: w ?? 0, echo: true, ...wide(message)} : {}),
      ...(points === undefined ? {} : {points: [...points]}),
      ...(yaw === undefined ? {} : {yaw}),
      ...(speed === undefined ? {} : {speed}),
      ...(text === undefined ? {} : {text}),
    };
  }

  /** One point for all robots, or one for each: those of these slots. A path is for all. */
  private pointsOf(message: Routed, of: readonly number[]): {points?: readonly [number, number][]} {
    const {points, slots} = message;
    if (points === undefined || slots === undefined) return {};
    if (message.kind === 'path' || points.length !== slots.length || points.length === 1)
      return {points};
    return {
      points: of.map((slot) => points[slots.indexOf(slot)]).filter((point) => point !== undefined),
    };
  }
}
