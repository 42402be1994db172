// SPDX-License-Identifier: Apache-2.0
import {css, html, nothing, type TemplateResult} from 'lit';
import type {PanelContext, PanelElement, PanelKind} from '../panel_api';
import '../panels/gesture/gesture_key';
import '../panels/joystick/joystick_panel';
import type {JoystickPanel} from '../panels/joystick/joystick_panel';
import type {Tool} from '../panels/world/orders/order_desk';
import type {WorldPanel} from '../panels/world/world_panel';
import {icon, type IconName} from '../ui/icons';
import {nowOf} from '../model/moment';
import {panelsFor} from './panels';
import './pen_bar';
import './robot_bar';
import './sheet';

const kPhone_px = 600;
const kPen_px = 700;

/** The page around it. */
export interface PhoneHost {
  context(): PanelContext;
  update(): void;
  world(): WorldPanel | null;
  joystick(): JoystickPanel | null;
  kind(id: string): PanelKind;
}

/** The page in the hand: one panel, and below it what can be asked of the selected robot. */
export class Phone {
  private readonly small = matchMedia(`(max-width: ${kPhone_px - 1}px)`);
  /** Low as well: orders, the last message and STOP at the bottom, nothing else. */
  private readonly low = matchMedia(
    `(max-width: ${kPhone_px - 1}px) and (max-height: ${kPen_px}px)`,
  );
  private panel = 'world';
  /** The stick lies over the world. */
  driving = false;

  constructor(private readonly host: PhoneHost) {}

  /** The page is in the hand. */
  get is(): boolean {
    return this.small.matches;
  }

  /** `other`: the page has become one in the hand, or is none any more. */
  listen(other: () => void): void {
    const {selection, model} = this.host.context();
    this.low.addEventListener('change', () => this.host.update());
    this.small.addEventListener('change', () => {
      this.driving = false;
      other();
    });
    selection.changed.on(() => this.driving && selection.primary === null && this.drive(false));
    model.runChanged.on(() => this.driving && !this.commands && this.drive(false));
  }

  private get commands(): boolean {
    const {model} = this.host.context();
    return model.live && model.may('command');
  }

  private get tool(): Tool {
    return this.host.world()?.tool ?? 'select';
  }

  show(id: string): void {
    // The world stays in sight of who drives.
    this.panel = id === 'joystick' ? 'world' : id;
    this.drive(id === 'joystick');
  }

  /** Lays the stick over the world, or takes it away. */
  drive(on: boolean): void {
    this.driving = on && this.is;
    if (this.driving && this.tool !== 'select') this.host.world()?.chooseTool('select');
    this.host.update();
  }

  toolChosen(): void {
    this.drive(this.driving && this.tool === 'select');
  }

  /** After the page is drawn: `place` is where the panel goes. */
  fill(place: HTMLElement): void {
    if (place.dataset['panel'] !== this.panel || place.firstElementChild === null) {
      place.dataset['panel'] = this.panel;
      const kind = this.host.kind(this.panel);
      const panel = kind.make?.() ?? (document.createElement(kind.tag) as PanelElement);
      panel.context = this.host.context();
      place.replaceChildren(panel);
    }
    const stick = this.driving ? this.host.joystick() : null;
    this.host.world()?.driveOver(stick?.covers_px ?? 0, stick?.full_mps ?? 0);
  }

  render(): TemplateResult {
    const context = this.host.context();
    // It stays while a tool is in the hand: the picture must not move under a finger that is about
    // to point.
    const glances = this.panel === 'world' && !this.low.matches && !this.driving;
    return html`<div class="phone"></div>
      ${this.driving
        ? html`<rave-joystick
            over
            .context=${context}
            @covers=${() => this.host.update()}></rave-joystick>`
        : nothing}
      ${this.commands && this.panel === 'world' && !this.driving
        ? html`<rave-gesture .context=${context} .world=${() => this.host.world()}></rave-gesture>`
        : nothing}
      ${glances ? html`<rave-sheet .context=${context}></rave-sheet>` : nothing}`;
  }

  renderBars(): TemplateResult {
    const context = this.host.context();
    return html`${this.commands && this.panel === 'world'
      ? html`<rave-robot-bar
          .context=${context}
          .tool=${this.tool}
          .driving=${this.driving}
          @tool=${(event: CustomEvent<Tool>) => {
            this.drive(false);
            this.host.world()?.chooseTool(event.detail);
          }}
          @drive=${() => this.drive(!this.driving)}></rave-robot-bar>`
      : nothing}
    ${this.commands && this.low.matches
      ? html`<rave-pen-bar .context=${context}></rave-pen-bar>`
      : html`<rave-run-bar .context=${context}></rave-run-bar>${this.renderTabs()}`}`;
  }

  private renderTabs(): TemplateResult {
    const {model} = this.host.context();
    const alerts = model.events.filter(
      (event) => event.level !== 'info' && (model.live || event.t <= nowOf(model)),
    ).length;
    return html`<nav aria-label="Panels">
      ${panelsFor(model)
        .filter((kind) => kind.short)
        .map(
          (kind) =>
            html`<button aria-pressed=${this.panel === kind.id} @click=${() => this.show(kind.id)}>
              ${icon(kind.icon as IconName, 20)}<span>${kind.short}</span>${kind.id === 'log' &&
              alerts > 0
                ? html`<i>${alerts}</i>`
                : nothing}
            </button>`,
        )}
    </nav>`;
  }
}

export const phoneStyles = css`
  .phone {
    flex: 1;
    min-height: 0;
  }
  nav {
    display: flex;
    flex: none;
    background: var(--bg-1);
    border-top: 1px solid var(--line-1);
    padding-bottom: env(safe-area-inset-bottom);
  }
  nav button {
    position: relative;
    flex: 1;
    min-height: 56px;
    display: flex;
    flex-direction: column;
    align-items: center;
    gap: 3px;
    padding: 8px 0;
    color: var(--text-3);
    font-size: var(--fs-12);
  }
  nav button[aria-pressed='true'] {
    color: var(--text-1);
  }
  nav i {
    position: absolute;
    left: calc(50% + 6px);
    top: 5px;
    min-width: 16px;
    padding: 0 4px;
    border-radius: 8px;
    background: var(--warn);
    color: var(--bg-1);
    font: 600 10px/16px var(--font-ui);
  }
`;
