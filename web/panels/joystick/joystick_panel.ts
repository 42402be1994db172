// SPDX-License-Identifier: Apache-2.0
import {html, type TemplateResult} from 'lit';
import {icon} from '../../ui/icons';
import {LiveElement} from '../../ui/live_element';
import {controls, glyphs} from '../../ui/styles';
import '../lease_bar';
import {kCommandsOf} from '../../protocol/frames';
import {guardOf, type GuardAct} from '../robot/guard_act';
import {CarDesk} from './car_desk';
import {carStyles, renderCar} from './car_view';
import {dialStyles, kReach, renderDial} from './dial';
import {DriveLoop} from './drive_loop';
import {kCovers_px, overStyles, renderOver} from './drive_over';
import {driveStyles, renderFigures, renderLine, renderNotes, renderRecent} from './drive_view';
import {DriveKeys} from './keys';
import {readPad} from './pad';
import {joystickStyles} from './joystick_styles';

const kRefresh_ms = 100;
const kPad_ms = 1000 / 60;
/** Where the browser keeps the layout. */
const kLayout = 'rave.joystick';
const kHand = 'rave.joystick.hand';

/** What the stick does, or that there are pedals instead. */
type Layout = 'stick' | 'slide' | 'pedals';
const layoutOf = (kept: string | null): Layout =>
  kept === 'pedals' || kept === 'slide' ? kept : 'stick';

/** A stick for the selected robot: pointer, finger, pen, keys or gamepad; it drives only while
 * held. */
export class JoystickPanel extends LiveElement {
  static override properties = {
    over: {type: Boolean, reflect: true},
    swapped: {type: Boolean, reflect: true},
  };
  /** It lies over the World View, and shows no more than is needed there. */
  declare over: boolean;
  /** The stick over the world stands at the right. */
  declare swapped: boolean;
  private loop!: DriveLoop;
  private readonly keys = new DriveKeys();
  private pad = '';
  private car!: CarDesk;
  private layout: Layout = layoutOf(localStorage.getItem(kLayout));

  protected override listen(): (() => void)[] {
    const {model, selection, commands, link, windows} = this.context;
    this.loop ??= new DriveLoop(commands, () => this.requestUpdate());
    this.loop.slides = this.layout === 'slide';
    this.car ??= new CarDesk(this.loop, this.keys);
    this.swapped ??= localStorage.getItem(kHand) === 'right';
    let chosen = this.driven;
    const choose = () => {
      // A gear that was put in for one robot is not that of the next.
      if (this.driven !== chosen) this.car.letGo();
      chosen = this.driven;
      this.loop.choose(chosen);
      // What is left of the stick behind the guard.
      link.look(this, chosen === null ? [] : [[chosen, kCommandsOf]]);
      this.requestUpdate();
    };
    choose();
    return [
      () => this.letGo(),
      () => link.look(this, []),
      ...[selection.changed, model.drivesChanged, model.runChanged].map((signal) =>
        signal.on(choose),
      ),
      link.changed.on(() => {
        if (!link.reaches) this.letGo();
        choose();
      }),
      // The dead-man: a page that is not visible does not drive.
      windows.left.on(() => this.letGo()),
      this.every(kRefresh_ms, () => this.requestUpdate()),
      this.every(kPad_ms, () => this.readPad()),
    ];
  }

  /** Full stick, m/s. */
  get full_mps(): number {
    return this.loop.v_mps;
  }

  /** What it covers of the picture that it lies over, pixels. */
  get covers_px(): number {
    return this.pedals ? kCovers_px.pedals : kCovers_px.stick;
  }

  /** The robot that is driven: the one that was selected last, if it lets itself be driven. */
  private get driven(): number | null {
    const slot = this.context.selection.primary;
    return slot !== null && this.whyNot(slot) === '' ? slot : null;
  }

  private whyNot(slot: number): string {
    const {model, link} = this.context;
    if (model.live && !link.reachesRobot(slot))
      return `No line to ${model.robots[slot]?.name ?? 'it'}: the link is lost.`;
    const drive = model.drives.get(slot);
    if (drive !== undefined && drive.lease !== '' && !drive.yours) {
      const name = model.robots[slot]?.name ?? '';
      return drive.lease === model.knownAs
        ? `You drive ${name} on another page.`
        : `${drive.lease} drives ${name}.`;
    }
    return model.whyNotTaken(slot, 'drive');
  }

  private letGo(): void {
    this.keys.clear();
    this.car.letGo();
    this.loop.release();
  }

  private get pedals(): boolean {
    return this.layout === 'pedals';
  }

  private setLayout(layout: Layout): void {
    if (layout === this.layout) return;
    this.letGo();
    this.layout = layout;
    this.loop.slides = layout === 'slide';
    localStorage.setItem(kLayout, layout);
    this.dispatchEvent(new CustomEvent('covers'));
    this.requestUpdate();
  }

  private swap(): void {
    this.letGo();
    this.swapped = !this.swapped;
    localStorage.setItem(kHand, this.swapped ? 'right' : 'left');
  }

  private readPad(): void {
    // Pedals read the pad themselves.
    if (this.pedals) {
      this.car.tick(performance.now());
      this.pad = this.car.pad;
      return;
    }
    const pad = readPad();
    this.pad = pad?.name ?? '';
    if (pad?.held === true) this.loop.hold('pad', pad.x, pad.y);
    else this.loop.release('pad');
  }

  private point(event: PointerEvent): void {
    const box = (event.currentTarget as HTMLElement).getBoundingClientRect();
    // The dial is drawn in a view box of 208 units.
    const unit = (kReach / 208) * box.width;
    this.loop.hold(
      'touch',
      (event.clientX - box.left - box.width / 2) / unit,
      -(event.clientY - box.top - box.height / 2) / unit,
    );
  }

  private press(event: PointerEvent): void {
    const stick = event.currentTarget as HTMLElement;
    // A finger that leaves the dial still drives, and lifting it anywhere releases.
    stick.setPointerCapture(event.pointerId);
    stick.focus();
    this.loop.renew('touch');
    this.point(event);
    event.preventDefault();
  }

  private key(event: KeyboardEvent, down: boolean): void {
    // Shortcuts of page and browser, such as Ctrl W.
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const gear = {e: 1, q: -1}[event.key.toLowerCase()];
    if (this.pedals && gear !== undefined) {
      event.preventDefault();
      event.stopPropagation();
      if (down && !event.repeat) this.car.shiftBy(gear);
      return;
    }
    if (!this.move(event.key, down, event.repeat)) return;
    event.preventDefault();
    event.stopPropagation();
  }

  /** Shift and arrows from anywhere on the page. */
  drive(key: string, down: boolean): void {
    this.move(key, down);
  }

  /** True if it is a key that drives. */
  private move(key: string, down: boolean, again = false): boolean {
    const first = down && !again && !this.keys.held;
    if (!(down ? this.keys.press(key) : this.keys.lift(key))) return false;
    if (this.pedals) return true;
    if (first) this.loop.renew('keys');
    if (this.keys.held) this.loop.hold('keys', ...this.keys.place);
    else this.loop.release('keys');
    return true;
  }

  override render(): TemplateResult {
    const {model, selection, palette, link} = this.context;
    const slot = selection.primary;
    const robot = slot === null ? undefined : model.robots[slot];
    if (slot === null || robot === undefined) {
      return html`<div class="empty">
        ${icon('joystick', 28)}
        <p>Select a robot to drive it.</p>
      </div>`;
    }
    const why = this.whyNot(slot);
    const hue = palette.hue(slot);
    const guard = guardOf(model, slot, this.loop.velocity[0]);
    const refusal =
      this.loop.refusal !== '' ? this.loop.refusal : this.pedals ? this.car.car.refusal : '';
    this.toggleAttribute('pedals', this.pedals);
    const controls = this.pedals
      ? this.renderPedals(robot.name, why !== '')
      : this.renderStick(robot.name, why !== '', guard);
    if (this.over) {
      return renderOver(this.context, {
        slot,
        loop: this.loop,
        guard,
        why: refusal || why,
        controls,
        layouts: this.renderLayouts(),
        swap: () => this.swap(),
      });
    }
    return html` <header>
        <i
          class="glyph ${robot.kind}"
          style="--hue:${robot.kind === 'real' ? hue.fill : hue.ink}"></i
        ><b>${robot.name}</b>${this.renderSources()}<span class="space"></span
        >${this.renderLayouts()}
      </header>
      <rave-lease compact .context=${this.context} .robot=${slot}></rave-lease>
      ${renderFigures(model, link, this.loop, slot)}
      <div class="middle">${controls}</div>
      ${renderNotes(this.loop.held !== null, why, refusal, guard)}
      ${renderLine(link, this.loop, robot.name)} ${renderRecent(model)}`;
  }

  private renderStick(name: string, disabled: boolean, guard: GuardAct | null): TemplateResult {
    return html`<div
      class="stick"
      tabindex="0"
      role="application"
      aria-label="Stick of ${name}: hold and move, or hold W A S D or the arrows"
      aria-disabled=${disabled}
      @pointerdown=${this.press}
      @pointermove=${(event: PointerEvent) => this.loop.held === 'touch' && this.point(event)}
      @pointerup=${() => this.loop.release('touch')}
      @pointercancel=${() => this.loop.release('touch')}
      @lostpointercapture=${() => this.loop.release('touch')}
      @keydown=${(event: KeyboardEvent) => this.key(event, true)}
      @keyup=${(event: KeyboardEvent) => this.key(event, false)}
      @blur=${() => {
        this.keys.clear();
        this.loop.release('keys');
      }}
      @contextmenu=${(event: Event) => event.preventDefault()}>
      ${renderDial({
        x: this.loop.x,
        y: this.loop.y,
        held: this.loop.held !== null,
        disabled,
        guard: guard === null ? null : guard.limit_mps / this.loop.v_mps,
      })}
    </div>`;
  }

  private renderPedals(robot: string, disabled: boolean): TemplateResult {
    const {car} = this;
    return renderCar({
      pedals: car.pedals,
      gear: car.car.gear,
      disabled,
      robot,
      touch: (control, value) => car.touch(control, value),
      shift: (gear) => {
        car.shift(gear);
        this.requestUpdate();
      },
      key: (event, down) => this.key(event, down),
      blur: () => this.keys.clear(),
    });
  }

  private renderLayouts(): TemplateResult {
    const layout = (name: Layout, text: string, title: string) =>
      html`<button
        role="radio"
        aria-checked=${this.layout === name}
        title=${title}
        @click=${() => this.setLayout(name)}>
        ${text}
      </button>`;
    return html`<div class="segments" role="radiogroup" aria-label="Controls">
      ${layout('stick', 'Stick', 'One stick for both velocities')}${layout(
        'slide',
        'Slide',
        'The stick moves robots sideways that can, instead of turning them',
      )}${layout('pedals', 'Pedals', 'Steering, throttle, brake and gear')}
    </div>`;
  }

  /** What can hold the stick; lit: it does. */
  private renderSources(): TemplateResult {
    const {held} = this.loop;
    const source = (
      on: boolean,
      there: boolean,
      name: 'gamepad' | 'keyboard' | 'hand',
      text: string,
      title: string,
    ) =>
      html`<span
        class="source ${on ? 'on' : ''} ${there ? '' : 'off'}"
        role="img"
        aria-label=${text}
        title=${title}
        >${icon(name, 15)}</span
      >`;
    return html`<span class="sources">
      ${source(
        held === 'pad',
        this.pad !== '',
        'gamepad',
        'Pad',
        this.pad === '' ? 'No gamepad: connect one and press a button' : this.pad,
      )}
      ${source(
        held === 'keys',
        true,
        'keyboard',
        'Keys',
        'W A S D or arrows on the stick; Shift and arrows anywhere',
      )}
      ${source(held === 'touch', true, 'hand', 'Touch', 'Hold the stick')}</span
    >`;
  }

  static override styles = [
    controls,
    glyphs,
    dialStyles,
    carStyles,
    driveStyles,
    overStyles,
    joystickStyles,
  ];
}

customElements.define('rave-joystick', JoystickPanel);
