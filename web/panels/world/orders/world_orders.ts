// SPDX-License-Identifier: Apache-2.0
import {html, nothing, type TemplateResult} from 'lit';
import type {PanelContext} from '../../../panel_api';
import {renderCards, renderHint, renderTools, type ToScreen} from './order_cards';
import {OrderDesk, type Tool} from './order_desk';
import './ring_menu';
import {kRing_px, type Sector} from './ring_menu';

/** What the World View shows for orders over its picture, and what their keys and menu do. */
export class WorldOrders {
  readonly desk: OrderDesk;
  private ring: {x: number; y: number; slot: number; point: [number, number]} | null = null;

  constructor(
    private readonly context: PanelContext,
    private readonly update: () => void,
    private readonly toTop: () => void,
  ) {
    this.desk = new OrderDesk(context);
  }

  /** Returns what ends the listening. */
  listen(): (() => void)[] {
    const {commands, model, selection} = this.context;
    return [
      this.desk.changed.on(this.update),
      commands.changed.on(this.update),
      model.drivesChanged.on(this.update),
      model.runChanged.on(this.update),
      selection.changed.on(() => this.follow()),
    ];
  }

  /** What is drawn is for those who are selected. */
  private follow(): void {
    const {draft} = this.desk;
    if (
      draft !== null &&
      draft.kind !== 'outline' &&
      this.desk.slotsFor(draft.kind).length === 0 &&
      this.desk.slotsFor('goal').length === 0
    ) {
      this.desk.draft = null;
      this.update();
    }
  }

  choose(tool: Tool): void {
    const why =
      tool === 'obstacle' || tool === 'select'
        ? ''
        : this.context.model.whyNot(tool === 'place' ? 'edit' : 'command');
    if (why !== '' || (!this.context.model.live && tool !== 'select')) return;
    this.desk.choose(tool);
    if (tool !== 'select') this.toTop();
  }

  drop(): boolean {
    if (this.ring !== null) {
      this.ring = null;
      this.update();
      return true;
    }
    return this.desk.drop();
  }

  openMenu(
    px: number,
    py: number,
    slot: number | null,
    point: [number, number],
    size: readonly [number, number],
  ): void {
    const {model, selection} = this.context;
    const whom = slot ?? selection.primary;
    if (whom === null || model.robots[whom] === undefined) return;
    if (slot !== null && !selection.has(slot)) selection.set([slot]);
    const half = kRing_px / 2;
    const inside = (at: number, room: number, above: number) =>
      Math.min(Math.max(at, half + above), Math.max(half + above, room - half));
    this.ring = {x: inside(px, size[0], 4), y: inside(py, size[1], 40), slot: whom, point};
    this.update();
  }

  private sectors(slot: number): Sector[] {
    const {model} = this.context;
    return [
      {id: 'goal', label: 'Goal', icon: 'target', why: model.whyNotTaken(slot, 'goal')},
      {
        id: 'path',
        label: 'Path',
        icon: 'route',
        why: model.whyNotTaken(slot, 'path') === '' ? '' : model.whyNotTaken(slot, 'goal'),
      },
      {id: 'drive', label: 'Drive', icon: 'joystick', why: model.whyNotTaken(slot, 'drive')},
      {
        id: 'stop',
        label: 'Stop',
        icon: 'octagonX',
        why: model.live ? model.whyNotStopped(slot) : 'This is a recording.',
      },
      {id: 'say', label: 'Say', icon: 'message', why: model.whyNot('chat')},
      {id: 'follow', label: 'Follow', icon: 'crosshair', why: ''},
    ];
  }

  private chosen(id: Sector['id'] | null): void {
    const {ring} = this;
    this.ring = null;
    this.update();
    if (ring === null || id === null) return;
    const {model, link, selection, show} = this.context;
    if (id === 'goal' || id === 'path') this.choose(id);
    else if (id === 'drive') show('joystick');
    else if (id === 'say') show('chat');
    else if (id === 'follow') selection.follow(true);
    else
      link.send({
        type: 'halt',
        do: 'stop',
        slots: selection.has(ring.slot)
          ? selection.slots.filter((slot) => model.stops(slot))
          : [ring.slot],
      });
  }

  tools(): TemplateResult | typeof nothing {
    return renderTools(this.context, this.desk, (tool) => this.choose(tool));
  }

  /** Over the picture. `at`: null in perspective, where nothing is drawn. */
  render(at: ToScreen | null): TemplateResult {
    const {ring} = this;
    return html`${at === null ? nothing : renderCards(this.context, this.desk, at)}
    ${renderHint(this.context, this.desk, (shape) => {
      this.desk.shape = shape;
      this.desk.choose('obstacle');
    })}
    ${ring === null
      ? nothing
      : html`<rave-ring
          style="left:${ring.x}px;top:${ring.y}px"
          .name=${this.context.model.robots[ring.slot]?.name ?? ''}
          .sectors=${this.sectors(ring.slot)}
          @choose=${(event: CustomEvent<Sector['id'] | null>) =>
            this.chosen(event.detail)}></rave-ring>`}`;
  }
}
