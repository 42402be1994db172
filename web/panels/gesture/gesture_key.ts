// SPDX-License-Identifier: Apache-2.0
import {html, nothing, svg, type TemplateResult} from 'lit';
import type {Point} from '../../protocol/messages';
import {icon} from '../../ui/icons';
import {LiveElement} from '../../ui/live_element';
import {controls} from '../../ui/styles';
import {radiusOf} from '../world/outlines';
import type {WorldPanel} from '../world/world_panel';
import {GestureDesk} from './gesture_desk';
import {gestureStyles} from './gesture_styles';
import {kGestureNames, kGestures, type GestureName, type Proposal} from './meanings';
import {listenToMotion, MotionCutter} from './motion_cutter';

/** The key that is held while the hand makes a gesture, and what it was taken for. A motion counts
 * only while the key is held, and letting go of it drops what was not sent. */
export class GestureKey extends LiveElement {
  static override properties = {world: {attribute: false}};
  /** The picture that gestures are made over. */
  declare world: () => WorldPanel | null;
  private desk!: GestureDesk;
  private held = false;
  private teachOpen = false;
  /** The stroke so far, pixels of the page. */
  private stroke: Point[] = [];
  private readonly cutter = new MotionCutter();
  private endMotion: (() => void) | null = null;

  protected override listen(): (() => void)[] {
    this.desk ??= new GestureDesk(this.context);
    const {kept, model} = this.context;
    return [
      ...this.renderAfter(this.desk.changed, model.runChanged),
      kept.changed.on(() => this.desk.taught.load()),
      () => this.hold(false),
    ];
  }

  private hold(on: boolean): void {
    if (this.held === on) return;
    this.held = on;
    this.stroke = [];
    this.endMotion?.();
    this.endMotion = null;
    if (on) {
      this.desk.note = '';
      this.endMotion = listenToMotion(
        this.cutter,
        (motion) => this.desk.take(motion, this.scene([])),
        (why) => {
          this.desk.note = why;
          this.requestUpdate();
        },
      );
    } else this.desk.drop();
    this.requestUpdate();
  }

  private scene(stroke: readonly Point[]) {
    const world = this.world();
    const box = world?.top.element.getBoundingClientRect();
    if (!world || !box) throw new Error('gestures are made over the world');
    const {camera} = world.top;
    const {x, y, yaw} = world.placed;
    return this.desk.sceneOf(
      stroke.map(([px, py]) => camera.toWorld(px - box.left, py - box.top)),
      camera.toWorld(box.width / 2, box.height / 2),
      {x, y, yaw, radiusOf},
    );
  }

  private press(event: PointerEvent): void {
    // The finger may slide off the key while it is held.
    (event.currentTarget as HTMLElement).setPointerCapture(event.pointerId);
    this.hold(true);
  }

  private pressKey(event: KeyboardEvent, on: boolean): void {
    if (event.key !== ' ' || event.repeat) return;
    event.preventDefault();
    event.stopPropagation();
    this.hold(on);
  }

  private draw(event: PointerEvent): void {
    event.preventDefault();
    if (event.type === 'pointerdown') {
      (event.currentTarget as HTMLElement).setPointerCapture(event.pointerId);
      this.desk.proposals = [];
      this.stroke = [];
    } else if (event.buttons === 0 && event.type === 'pointermove') return;
    this.stroke = [...this.stroke, [event.clientX, event.clientY]];
    if (event.type === 'pointerup' && this.world() !== null) {
      const stroke = this.stroke;
      // Upwards is positive, as in the world.
      const motion = stroke.map(([x, y]) => [x, -y]);
      this.desk.take(motion, this.scene(stroke));
    }
    this.requestUpdate();
  }

  override render(): TemplateResult {
    const {note} = this.desk;
    const busy = this.held || this.teachOpen || note !== '';
    return html`${this.held ? this.renderPaper() : nothing} ${busy ? this.renderCard() : nothing}
      <div class="row">
        <button
          class="key"
          aria-pressed=${this.held}
          title="Held while you make a gesture (Space)"
          @pointerdown=${(event: PointerEvent) => this.press(event)}
          @pointerup=${() => this.hold(false)}
          @pointercancel=${() => this.hold(false)}
          @lostpointercapture=${() => this.hold(false)}
          @contextmenu=${(event: Event) => event.preventDefault()}
          @keydown=${(event: KeyboardEvent) => this.pressKey(event, true)}
          @keyup=${(event: KeyboardEvent) => this.pressKey(event, false)}
          @blur=${() => this.hold(false)}>
          ${icon('hand', 22)}<span>${this.held ? 'held' : 'Gesture'}</span>
        </button>
        ${this.held
          ? nothing
          : html`<button
              class="teach"
              aria-pressed=${this.teachOpen}
              @click=${() => this.openTeach()}>
              Teach
            </button>`}
      </div>`;
  }

  private openTeach(): void {
    this.teachOpen = !this.teachOpen;
    if (!this.teachOpen) this.desk.choose(null);
    this.requestUpdate();
  }

  /** Where the other hand draws: all of the world. */
  private renderPaper(): TemplateResult {
    const box = this.world()?.top.element.getBoundingClientRect();
    if (box === undefined) return html``;
    const draw = (event: PointerEvent) => this.draw(event);
    const line = this.stroke.map(([x, y]) => `${x - box.left},${y - box.top}`).join(' ');
    return html`<div
      class="paper"
      style="left:${box.left}px;top:${box.top}px;width:${box.width}px;height:${box.height}px"
      @pointerdown=${draw}
      @pointermove=${draw}
      @pointerup=${draw}
      @mousedown=${keepFocus}>
      <svg>${svg`<polyline points=${line} />`}</svg>
    </div>`;
  }

  private renderCard(): TemplateResult {
    const {proposals, note} = this.desk;
    return html`<div class="card" role="status" @mousedown=${keepFocus}>
      ${proposals.length > 0 ? this.renderProposals(proposals) : nothing}
      ${note !== '' ? html`<p class="note">${note}</p>` : nothing}
      ${this.teachOpen ? this.renderTeach() : nothing}
      ${this.held && proposals.length === 0 && !this.teachOpen ? this.renderLegend() : nothing}
    </div>`;
  }

  private renderProposals(proposals: readonly Proposal[]): TemplateResult {
    const unsure = proposals.length > 1;
    return html`${unsure ? html`<p class="note">It is one of these. Which?</p>` : nothing}
      ${proposals.map(
        (one) =>
          html`<div class="proposal">
            <b>${one.title}</b><small>${one.why === '' ? one.detail : one.why}</small>
            <button
              class="send"
              ?disabled=${one.why !== ''}
              @pointerup=${() => this.desk.send(one)}
              @click=${byKey(() => this.desk.send(one))}>
              ${icon('send', 18)} ${one.slots.length > 0 ? `Send to ${one.slots.length}` : 'Send'}
            </button>
          </div>`,
      )}
      <button
        class="cancel"
        @pointerup=${() => this.desk.drop()}
        @click=${byKey(() => this.desk.drop())}>
        ${icon('x', 18)} Cancel
      </button>
      <small>Nothing is sent yet. Letting go of the key cancels.</small>`;
  }

  private renderLegend(): TemplateResult {
    return html`<ul>
      ${kGestureNames.map(
        (name) => html`<li><b>${kGestures[name].shape}</b> ${kGestures[name].means}</li>`,
      )}
    </ul>`;
  }

  private renderTeach(): TemplateResult {
    const {desk} = this;
    return html`<div class="lessons">
      ${kGestureNames.map(
        (name: GestureName) =>
          html`<button
              class="lesson"
              aria-pressed=${desk.teaching === name}
              @click=${() => desk.choose(desk.teaching === name ? null : name)}>
              ${kGestures[name].means} <i>${desk.taught.count(name)}</i>
            </button>
            <button
              class="forget"
              ?disabled=${desk.taught.count(name) === 0}
              aria-label="Forget what was taught for ${kGestures[name].means}"
              @click=${() => desk.forget(name)}>
              ${icon('x', 16)}
            </button>`,
      )}
    </div>`;
  }

  static override styles = [controls, gestureStyles];
}

/** The key keeps the focus, which tells that it is held. */
const keepFocus = (event: Event) => event.preventDefault();

/** While one finger holds the key, browsers make no clicks of another: buttons listen to pointers,
 * and to clicks of the keyboard. */
const byKey = (act: () => void) => (event: MouseEvent) => {
  if (event.detail === 0) act();
};

customElements.define('rave-gesture', GestureKey);
