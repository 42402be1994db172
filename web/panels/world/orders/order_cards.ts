// SPDX-License-Identifier: Apache-2.0
import {css, html, nothing, type TemplateResult} from 'lit';
import {icon, type IconName} from '../../../ui/icons';
import type {Pending} from '../../../model/commands';
import type {PanelContext} from '../../../panel_api';
import type {Point} from '../../../protocol/messages';
import {radiusOf} from '../outlines';
import {nearestFree} from './free_point';
import type {OrderDesk, Tool} from './order_desk';
import {lengthOf, outlineOf, outlineText, type OutlineKind} from './outline';

/** Where a point of the world is on the panel. */
export type ToScreen = (point: readonly [number, number]) => [number, number];

const kTools: readonly {tool: Tool; label: string; key: string; icon: IconName}[] = [
  {tool: 'select', label: 'Select', key: 'V', icon: 'pointer'},
  {tool: 'goal', label: 'Goal', key: 'G', icon: 'target'},
  {tool: 'path', label: 'Path', key: 'W', icon: 'route'},
  {tool: 'obstacle', label: 'Obstacle', key: 'O', icon: 'boxSelect'},
  {tool: 'place', label: 'Place', key: 'B', icon: 'move'},
];
const kShapes: readonly OutlineKind[] = ['box', 'disc', 'polygon'];

/** The tools of who may command or edit; nothing for who looks on. */
export function renderTools(
  {model}: PanelContext,
  desk: OrderDesk,
  choose: (tool: Tool) => void,
): TemplateResult | typeof nothing {
  const commands = model.live && model.may('command');
  const edits = model.live && model.may('edit');
  if (!commands && !edits) return nothing;
  const mine = kTools.filter(
    ({tool}) => tool === 'select' || (tool === 'obstacle' || tool === 'place' ? edits : commands),
  );
  return html`<div class="order-tools" role="radiogroup" aria-label="Tool">
      ${mine.map(
        ({tool, label, key, icon: name}) =>
          html` <button
            class="tool"
            role="radio"
            aria-checked=${desk.tool === tool}
            title="${label} (${key})"
            @click=${() => choose(tool)}>
            ${icon(name, 16)}<span>${label}</span>
          </button>`,
      )}
    </div>
    <i class="rule"></i>`;
}

/** At the bottom of the picture: what the tool waits for. */
export function renderHint(
  context: PanelContext,
  desk: OrderDesk,
  choose: (shape: OutlineKind) => void,
): TemplateResult | typeof nothing {
  const {tool} = desk;
  if (tool === 'select') return nothing;
  const why = desk.whyNot(tool);
  const close = html`<button
    aria-label="Put the tool away"
    title="Put the tool away (Esc)"
    @click=${() => desk.choose('select')}>
    ${icon('x', 14)}
  </button>`;
  if (why !== '')
    return html`<div class="hint why" role="status">
      ${icon('info', 16)}<span>${why}</span>${close}
    </div>`;
  const slots = tool === 'obstacle' ? [] : desk.slotsFor(tool);
  const who = slots.length === 1 ? context.model.robots[slots[0]].name : `${slots.length} robots`;
  const texts: Record<Tool, TemplateResult> = {
    select: html``,
    goal: html`<b>Goal for ${who}.</b> Click a place; drag for a heading.`,
    path: html`<b>Path for ${who}.</b> Drag, or click to add points.`,
    place: html`<b>Place ${who}.</b> Click its new position; drag for a heading.`,
    obstacle: html`<b>Obstacle.</b> ${desk.shape === 'polygon'
        ? 'Click its corners; the first one again ends it.'
        : 'Drag it.'}`,
  };
  return html`<div class="hint" role="status">
    ${texts[tool]}
    ${tool === 'obstacle'
      ? html`<span class="shapes" role="radiogroup" aria-label="Shape"
          >${kShapes.map(
            (shape) =>
              html`<button
                role="radio"
                aria-checked=${desk.shape === shape}
                @click=${() => choose(shape)}>
                ${shape}
              </button>`,
          )}</span
        >`
      : nothing}${close}
  </div>`;
}

/** What stands beside things in the picture: what is drawn, what was refused, what is held. */
export function renderCards(context: PanelContext, desk: OrderDesk, at: ToScreen): TemplateResult {
  return html`${renderDraft(context, desk, at)}
  ${context.commands.pending
    .filter((order) => order.state === 'refused')
    .map((order) =>
      place(
        at(order.points[order.points.length - 1]),
        'refused',
        html` <b>${order.kind === 'place' ? 'Not placed' : `No ${order.kind}`}</b
          ><span>${order.text}</span>${renderInstead(context, order)}<button
            @click=${() => context.commands.drop(order)}>
            Drop
          </button>`,
      ),
    )}
  ${desk.note === null
    ? nothing
    : place(
        at(desk.note.at),
        desk.note.good ? 'good' : 'refused',
        html`<span>${desk.note.text}</span><button @click=${() => desk.drop()}>Close</button>`,
      )}
  ${renderChosen(context, desk, at)}`;
}

/** The search takes longer than a picture may, so it is made once for each refusal. */
const instead = new WeakMap<Pending, Point | null>();

/** Of a goal inside an obstacle: the nearest point that is free. */
function renderInstead(
  {commands, model}: PanelContext,
  order: Pending,
): TemplateResult | typeof nothing {
  const frame = model.poses.newest;
  if (
    order.kind !== 'goal' ||
    order.slots.length !== 1 ||
    frame === null ||
    !order.text.includes('is inside the obstacle')
  )
    return nothing;
  const [slot] = order.slots;
  if (!instead.has(order)) {
    const {shapes} = model.robots[slot];
    const height: [number, number] = [
      Math.min(...shapes.map(({z}) => z[0])),
      Math.max(...shapes.map(({z}) => z[1])),
    ];
    instead.set(
      order,
      nearestFree(model.bodies.values(), order.points[0], radiusOf(shapes), height, [
        frame.x[slot],
        frame.y[slot],
      ]),
    );
  }
  const point = instead.get(order) ?? null;
  if (point === null) return nothing;
  const away_m = Math.hypot(point[0] - order.points[0][0], point[1] - order.points[0][1]);
  return html`<span>The nearest free point is ${away_m.toFixed(2)} m away.</span>
    <button
      class="main"
      @click=${() => {
        commands.drop(order);
        void commands.goal([slot], [point]);
      }}>
      Go there
    </button>`;
}

function place(
  [x, y]: readonly [number, number],
  look: string,
  content: TemplateResult,
): TemplateResult {
  return html`<div
    class="beside ${look}"
    role=${look === 'refused' ? 'alert' : 'group'}
    style="left:clamp(8px, ${Math.round(x + 18)}px, calc(100% - 228px));top:clamp(8px, ${Math.round(
      y - (look === 'draft' ? 64 : 18),
    )}px, calc(100% - 110px))">
    ${content}
  </div>`;
}

function renderDraft(
  context: PanelContext,
  desk: OrderDesk,
  at: ToScreen,
): TemplateResult | typeof nothing {
  const {draft} = desk;
  if (draft === null) return nothing;
  const send = html`<button class="main" @click=${() => void desk.send()}>
      Send ${icon('cornerDownLeft', 13)}
    </button>
    <button class="icon" aria-label="Drop" title="Drop (Esc)" @click=${() => desk.drop()}>
      ${icon('x', 15)}
    </button>`;
  if (draft.kind === 'outline') {
    const made = outlineOf(draft.shape, draft.points);
    const end = draft.points[draft.points.length - 1];
    return place(
      at(end),
      'draft',
      html`<span>${made === null ? `${draft.points.length} corners` : outlineText(made)}</span
        >${draft.shape === 'polygon' ? send : nothing}`,
    );
  }
  const points: Point[] = draft.kind === 'path' ? draft.points : [draft.point];
  const end = points[points.length - 1];
  const slots = desk.slotsFor(draft.kind);
  const speed = Math.max(
    0,
    ...slots.map((slot) => Math.abs(context.model.poses.newest?.speed[slot] ?? 0)),
  );
  const length = draft.kind === 'path' ? lengthOf(points) : distance(context, slots[0], end);
  return place(
    at(end),
    'draft',
    html`<span
        ><b>${length.toFixed(1)} m</b
        ><small
          >${speed > 0.05
            ? `about ${Math.round(length / speed)} s`
            : slots.length > 1
              ? `${slots.length} robots`
              : ''}</small
        ></span
      >${send}`,
  );
}

function distance({model}: PanelContext, slot: number | undefined, end: Point): number {
  const frame = model.poses.newest;
  return slot === undefined || frame === null
    ? 0
    : Math.hypot(end[0] - frame.x[slot], end[1] - frame.y[slot]);
}

function renderChosen(
  context: PanelContext,
  desk: OrderDesk,
  at: ToScreen,
): TemplateResult | typeof nothing {
  const {chosen} = desk;
  if (chosen === null || desk.moved !== null || !context.model.may('edit')) return nothing;
  return place(
    at([chosen.pose[0], chosen.pose[1]]),
    'body',
    html`<b>${chosen.body.name}</b>
      <button
        class="icon"
        aria-label="Turn left"
        title="Turn by 15° to the left"
        @click=${() => void desk.turn(Math.PI / 12)}>
        ${icon('rotateCcw', 15)}
      </button>
      <button
        class="icon danger"
        aria-label="Remove ${chosen.body.name}"
        title="Remove (Delete)"
        @click=${() => void desk.remove()}>
        ${icon('trash', 15)}
      </button>`,
  );
}

export const orderStyles = css`
  .order-tools {
    display: flex;
    gap: 2px;
    flex: none;
  }
  .tool {
    display: inline-flex;
    align-items: center;
    gap: 6px;
    height: 28px;
    padding: 0 9px;
    border-radius: var(--r-3);
    color: var(--text-2);
    font-size: var(--fs-12);
    white-space: nowrap;
  }
  .tool:hover {
    background: var(--bg-3);
    color: var(--text-1);
  }
  .tool[aria-checked='true'] {
    background: var(--intent-fill);
    color: #fff;
    font-weight: var(--fw-medium);
  }
  .hint {
    position: absolute;
    left: 50%;
    bottom: 14px;
    transform: translateX(-50%);
    z-index: 3;
    display: flex;
    align-items: center;
    flex-wrap: wrap;
    gap: 8px;
    width: max-content;
    max-width: calc(100% - 28px);
    padding: 7px 8px 7px 14px;
    border-radius: var(--r-6);
    background: var(--intent-fill);
    color: #fff;
    font-size: var(--fs-12);
    box-shadow: var(--shadow-pop);
  }
  .hint.why {
    background: var(--bg-2);
    color: var(--text-1);
    border: 1px solid var(--line-2);
  }
  .hint button {
    display: grid;
    place-items: center;
    min-width: 26px;
    height: 24px;
    padding: 0 6px;
    border-radius: var(--r-3);
    color: inherit;
    font-size: var(--fs-12);
  }
  .shapes {
    display: inline-flex;
    gap: 2px;
  }
  .shapes button[aria-checked='true'] {
    background: #fff;
    color: #4a3bbf;
    font-weight: var(--fw-medium);
  }
  .beside {
    position: absolute;
    z-index: 4;
    display: flex;
    align-items: center;
    flex-wrap: wrap;
    gap: 8px;
    max-width: 220px;
    padding: 8px 10px;
    background: var(--bg-2);
    border: 1px solid var(--line-2);
    border-radius: var(--r-4);
    box-shadow: var(--shadow-pop);
    font-size: var(--fs-12);
  }
  .beside.draft {
    pointer-events: none;
  }
  .beside.draft button {
    pointer-events: auto;
  }
  .beside.refused {
    border-color: var(--danger);
  }
  .beside.refused b {
    flex: 1 0 100%;
    color: var(--danger);
  }
  .beside span {
    min-width: 0;
    overflow-wrap: anywhere;
  }
  .beside small {
    display: block;
    color: var(--text-2);
    font-size: var(--fs-11);
  }
  .beside button {
    display: inline-flex;
    align-items: center;
    gap: 6px;
    height: var(--h-control);
    padding: 0 10px;
    border-radius: var(--r-3);
    background: var(--bg-3);
    font-size: var(--fs-12);
  }
  .beside .main {
    background: var(--intent-fill);
    color: #fff;
    font-weight: var(--fw-medium);
  }
  .beside .icon {
    padding: 0 7px;
  }
  .beside .danger {
    color: var(--danger);
  }
`;
