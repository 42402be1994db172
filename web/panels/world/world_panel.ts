// SPDX-License-Identifier: Apache-2.0
import {html, nothing, type TemplateResult} from 'lit';
import {LiveElement} from '../../ui/live_element';
import {controls, glyphs} from '../../ui/styles';
import {Placed} from '../../model/pose_history';
import {viewOf} from '../../model/windows';
import {AutoFit, motion} from './auto_fit';
import {kLayers, readLayers, type Layers, type Poses} from './layers';
import {sensorsToRead} from './reading_layer';
import {orderStyles} from './orders/order_cards';
import type {Tool} from './orders/order_desk';
import {WorldOrders} from './orders/world_orders';
import {savePicture} from './save_picture';
import type {Stage, StageContext} from './stage';
import {TopStage} from './top_stage';
import {placeTruth} from './truth_layer';
import {renderFollowed, renderModes, renderTools, worldSummary, type Mode} from './world_bar';
import {renderCard, worldCardStyles} from './world_card';
import {pressWorldKey} from './world_keys';
import {renderColourBy, renderLegend, renderMenu, worldMenuStyles} from './world_menu';
import {worldPanelStyles} from './world_panel_styles';

const kKept = 'world';
const kKeptMode = 'world.mode';
/** From this number of robots on the colours are at hand without the menu. */
const kCrowd = 100;
/** From this share of the page on it is the only panel. */
const kAlone = 0.9;
const kCard_ms = 250;
/** The same while an order is drawn or on its way. */
const kDrawn_ms = 60;

/** Robots and bodies where they are, from above or in perspective. */
export class WorldPanel extends LiveElement {
  readonly placed = new Placed();
  /** True poses, while they are drawn beside reported ones. */
  readonly truth = new Placed();
  /** Pictures so far, and the time they took: for measuring. */
  painted = 0;
  paint_ms = 0;
  /** When robots were on the screen for the first time, milliseconds since the page was asked
   * for. */
  first_ms = 0;
  private mode: Mode = 'top';
  private stage!: Stage;
  /** The view from above. */
  top!: TopStage;
  private orders!: WorldOrders;
  private perspective: Stage | null = null;
  private layers: Layers = kLayers;
  private menuOpen = false;
  private readonly autoFit = new AutoFit();
  private shownRun = '';
  private drawQueued = false;
  private cardAt_ms = 0;
  private readonly resized = new ResizeObserver(() => this.resize());

  protected override listen(): (() => void)[] {
    // A picture that another window was to draw does not come.
    this.drawQueued = false;
    const {model, palette, selection, kept, link} = this.context;
    this.layers = readLayers(kept.read(kKept));
    this.orders ??= new WorldOrders(
      this.context,
      () => this.refreshOrders(),
      () => void this.setMode('top'),
    );
    this.top ??= new TopStage(this.stageContext());
    this.stage ??= this.top;
    const refresh = () => {
      this.stage.refresh();
      this.lookAround();
      this.requestUpdate();
      this.draw();
    };
    this.shownRun = model.hello?.run.name ?? '';
    this.stage.refresh();
    this.lookAround();
    this.resized.observe(this);
    if (this.keptMode === '3d') void this.setMode('3d');
    return [
      ...this.orders.listen(),
      model.rosterChanged.on(() => {
        // The same run, as its replay or after a lost link, is shown from where the person looked.
        const run = model.hello?.run.name ?? '';
        if (run !== this.shownRun) this.autoFit.reset();
        this.shownRun = run;
        refresh();
      }),
      model.sceneChanged.on(refresh),
      palette.changed.on(refresh),
      kept.changed.on(() => {
        this.layers = readLayers(kept.read(kKept));
        void this.setMode(this.keptMode);
        refresh();
      }),
      model.pictureChanged.on(() => this.draw()),
      model.maps.namesChanged.on(() => this.requestUpdate()),
      model.maps.overlayChanged.on(() => {
        this.requestUpdate();
        this.draw();
      }),
      selection.changed.on(() => {
        this.lookAround();
        this.requestUpdate();
        this.draw();
      }),
      () => {
        link.look(this, []);
        link.lookAtTruth(false);
        link.lookAtVariances([]);
        this.resized.disconnect();
      },
    ];
  }

  override firstUpdated(): void {
    this.place().append(this.stage.element);
    this.resize();
  }

  private stageContext(): StageContext {
    return {
      ...this.context,
      placed: this.placed,
      truth: this.truth,
      layers: () => this.layers,
      redraw: () => this.draw(),
      moved: () => this.autoFit.move(),
      desk: this.orders.desk,
      menu: (px, py) =>
        this.orders.openMenu(px, py, this.top.slotAt(px, py), this.top.camera.toWorld(px, py), [
          this.clientWidth,
          this.place().clientHeight,
        ]),
    };
  }

  private refreshOrders(): void {
    this.requestUpdate();
    this.dispatchEvent(new CustomEvent('tool', {bubbles: true, composed: true}));
    this.draw();
  }

  get tool(): Tool {
    return this.orders.desk.tool;
  }

  /** V G W O B, and the buttons of small screens. */
  chooseTool(tool: Tool): void {
    this.orders.choose(tool);
  }

  /** A stick lies over the lower `stick_px` of the picture: the driven robot stays above it, with
   * where it is in two seconds at full speed. 0: none. */
  driveOver(stick_px: number, full_mps: number): void {
    if (stick_px === this.top.camera.covered.bottom) return;
    this.toggleAttribute('driving', stick_px > 0);
    this.top.cover(stick_px, full_mps, this.clientWidth, this.clientHeight);
    if (stick_px > 0) this.autoFit.move();
    this.context.selection.follow(stick_px > 0);
    void this.setMode('top');
  }

  /** Enter: sends what is drawn. */
  sendDraft(): void {
    void this.orders.desk.send();
  }

  /** Delete: the obstacle with handles. */
  removeBody(): void {
    if (this.context.model.may('edit')) void this.orders.desk.remove();
  }

  private place(): HTMLElement {
    return this.renderRoot.querySelector('.canvas') as HTMLElement;
  }

  private get keptMode(): Mode {
    return this.context.kept.read(kKeptMode) === '3d' ? '3d' : 'top';
  }

  /** From above, or in perspective. The renderer of the latter is loaded when it is first asked
   * for. */
  async setMode(mode: Mode): Promise<void> {
    this.mode = mode;
    this.context.kept.write(kKeptMode, mode);
    this.requestUpdate();
    if (mode === '3d' && this.perspective === null) {
      const {PerspectiveStage} = await import('./perspective/perspective_stage');
      this.perspective ??= new PerspectiveStage(this.stageContext());
    }
    const next = this.mode === '3d' ? this.perspective : this.top;
    if (next === null || next === this.stage) return;
    this.stage.element.remove();
    this.stage = next;
    this.stage.refresh();
    if (!this.hasUpdated) return;
    this.place().append(this.stage.element);
    this.resize();
    if (mode === '3d') this.autoFit.again();
    this.draw();
  }

  toggleMode(): void {
    void this.setMode(this.mode === 'top' ? '3d' : 'top');
  }

  /** Shows everything; where everything is shown already, the selection. */
  fit(animate = true): void {
    this.context.selection.follow(false);
    this.autoFit.ask(this.stage, animate && motion());
    this.draw();
  }

  viewpoint(): string {
    return this.stage.viewpoint();
  }

  lookFrom(text: string): void {
    this.autoFit.move();
    void this.setMode(text.startsWith('3d') ? '3d' : 'top').then(() => {
      this.stage.lookFrom(text);
      this.draw();
    });
  }

  screenOf(slot: number): [number, number] {
    return this.stage.screenOf(slot);
  }

  /** The picture as a PNG. */
  picture(): void {
    savePicture(
      this.stage.snapshot(),
      `${this.context.model.hello?.run.name ?? 'rave'}-${this.placed.time_s.toFixed(2)}s.png`,
    );
  }

  toggleMeasure(): void {
    this.top.measure.toggle();
    if (this.top.measure.on) void this.setMode('top');
    this.requestUpdate();
    this.draw();
  }

  /** A key on the focused picture. */
  private press(event: KeyboardEvent): void {
    if (!pressWorldKey(event, this.stage)) return;
    event.preventDefault();
    this.requestUpdate();
  }

  private toggleMenu(): void {
    this.menuOpen = !this.menuOpen;
    this.requestUpdate();
  }

  /** While Z is held; it lies over the top view. */
  lens(on: boolean): void {
    if (this.top.lens.on === on) return;
    this.top.lens.on = on;
    if (on) void this.setMode('top');
    this.draw();
  }

  /** Esc: ends a measurement, a box or the menu; false if there was nothing. */
  drop(): boolean {
    const dropped = this.orders.drop() || this.stage.drop() || this.menuOpen;
    this.menuOpen = false;
    if (dropped) this.requestUpdate();
    this.draw();
    return dropped;
  }

  /** Says which sensors are drawn: those of the selection, and of a few real robots. */
  private lookAround(): void {
    const {model, link, selection} = this.context;
    link.look(this, sensorsToRead(model, selection, this.layers));
    link.lookAtTruth(this.poses !== 'reported');
    link.lookAtVariances(this.layers.uncertainty ? selection.slots : []);
  }

  private resize(): void {
    if (!this.hasUpdated) return;
    const {clientWidth, clientHeight} = this.place();
    if (clientWidth === 0 || clientHeight === 0) return;
    this.stage.resize(clientWidth, clientHeight);
    this.requestUpdate();
    this.autoFit.again();
    this.paint();
  }

  /** No other panel is beside it. */
  private get alone(): boolean {
    const {innerWidth, innerHeight} = viewOf(this);
    return (
      innerWidth >= 600 &&
      this.clientWidth > kAlone * innerWidth &&
      this.clientHeight > 0.6 * innerHeight
    );
  }

  /** Poses that are drawn; who may not have true ones is shown reported ones. */
  private get poses(): Poses {
    return this.context.model.may('true_pose') ? this.layers.poses : 'reported';
  }

  private draw(): void {
    if (this.drawQueued) return;
    this.drawQueued = true;
    viewOf(this).requestAnimationFrame(() => {
      this.drawQueued = false;
      this.paint();
    });
  }

  private paint(): void {
    if (!this.isConnected || !this.hasUpdated || this.place().clientWidth === 0) return;
    const now_ms = performance.now();
    const {model} = this.context;
    model.poses.interpolate(now_ms, this.placed);
    placeTruth(model, this.poses, now_ms, this.placed, this.truth);
    if (model.poses.newest !== null && !this.context.selection.following)
      this.autoFit.look(this.stage, this.placed, now_ms, motion());
    const going = this.stage.paint(now_ms);
    // Cards stand beside things that move.
    const drawn = this.orders.desk.draft !== null || this.context.commands.pending.length > 0;
    const shown = this.alone && this.context.selection.primary !== null;
    if (now_ms - this.cardAt_ms > (drawn ? kDrawn_ms : shown ? kCard_ms : Infinity)) {
      this.cardAt_ms = now_ms;
      this.requestUpdate();
    }
    ++this.painted;
    if (this.first_ms === 0 && this.placed.count > 0) this.first_ms = performance.now();
    this.paint_ms += performance.now() - now_ms;
    if (going || model.poses.moving(now_ms)) this.draw();
  }

  private setLayers(layers: Layers): void {
    this.layers = layers;
    this.context.kept.write(kKept, layers);
    this.lookAround();
    this.requestUpdate();
    this.draw();
  }

  override render(): TemplateResult {
    const {model, palette} = this.context;
    const set = (layers: Layers) => this.setLayers(layers);
    return html` <div class="bar">
        ${renderModes(this.mode, (mode) => void this.setMode(mode))}
        <i class="rule"></i>
        ${this.orders.tools()}
        ${renderLegend(this.context, this.layers, set, () => this.toggleMenu())}
        <span class="space"></span>
        ${model.robots.length >= kCrowd ? renderColourBy(this.layers, set) : nothing}
        ${renderTools(this, this.context, {
          mode: this.mode,
          measuring: this.top.measure.on,
          menuOpen: this.menuOpen,
          layers: () => this.toggleMenu(),
        })}
      </div>
      <div class="stage">
        <div
          class="canvas"
          tabindex="0"
          role="application"
          aria-label=${worldSummary(model)}
          @keydown=${(event: KeyboardEvent) => this.press(event)}></div>
        <span class="said" role="status">${this.top.measure.text}</span>
        ${renderFollowed(this.context)}
        ${this.orders.render(
          this.stage.screenAt === undefined ? null : ([x, y]) => this.top.screenAt(x, y),
        )}
        ${this.alone ? renderCard(this.context, this.placed) : nothing}
        ${this.menuOpen
          ? renderMenu(
              this.context,
              this.layers,
              this.top.tint.scale(this.layers.colourBy),
              palette.theme,
              set,
            )
          : nothing}
      </div>`;
  }

  static override styles = [
    controls,
    glyphs,
    worldMenuStyles,
    worldCardStyles,
    orderStyles,
    worldPanelStyles,
  ];
}

customElements.define('rave-world', WorldPanel);
