// SPDX-License-Identifier: Apache-2.0
import {LitElement, css, html, nothing, type TemplateResult} from 'lit';
import {icon} from '../../app/icons';
import {controls, glyphs} from '../../app/styles';
import {Placed} from '../../model/pose_history';
import type {PanelContext} from '../../panel_api';
import {RobotFlag} from '../../protocol/frames';
import {Camera, type Bounds} from './camera';
import {kLayers, readLayers, type Kind, type Layers} from './layers';
import {drawnSensors} from './scan_layer';
import {TopView} from './top_view';

const kKept = 'rave.world';
const kKinds: readonly [Kind, string][] = [
  ['real', 'real'],
  ['simulated', 'simulated'],
  ['virtual', 'virtual'],
  ['landmark', 'tubes'],
  ['wall', 'walls'],
];
/** Sensors of so many robots are drawn at a time. */
const kScanned = 12;

/** Robots and bodies where they are, seen from above. */
export class WorldPanel extends LitElement {
  declare context: PanelContext;
  private readonly camera = new Camera();
  private readonly placed = new Placed();
  private view!: TopView;
  private canvas: HTMLCanvasElement | null = null;
  private layers: Layers = kLayers;
  private menuOpen = false;
  private fitted = false;
  /** The person has chosen what is shown: it is not fitted again by itself. */
  private moved = false;
  private drawQueued = false;
  private measuring = false;
  private measured: [number, number, number, number] | null = null;
  private pointers = new Map<number, {x: number; y: number}>();
  private pressed: {x: number; y: number; moved: boolean; box: boolean} | null = null;
  private box: [number, number, number, number] | null = null;
  private readonly ends: (() => void)[] = [];
  private readonly resized = new ResizeObserver(() => this.resize());

  override connectedCallback(): void {
    super.connectedCallback();
    const {model, palette, selection} = this.context;
    this.layers = readLayers(JSON.parse(localStorage.getItem(kKept) ?? 'null'));
    this.view = new TopView(model, palette, selection);
    const refresh = () => {
      this.view.refresh();
      this.lookAround();
      this.requestUpdate();
      this.draw();
    };
    this.ends.push(
      model.rosterChanged.on(() => {
        this.fitted = this.moved = false;
        refresh();
      }),
      model.sceneChanged.on(refresh),
      palette.changed.on(refresh),
      model.pictureChanged.on(() => this.draw()),
      selection.changed.on(() => {
        this.lookAround();
        this.requestUpdate();
        this.draw();
      }),
    );
    this.view.refresh();
    this.lookAround();
    this.resized.observe(this);
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    this.context.link.look(this, []);
    this.resized.disconnect();
    for (const end of this.ends.splice(0)) end();
  }

  override firstUpdated(): void {
    this.canvas = this.renderRoot.querySelector('canvas');
    // A wheel that zooms must not scroll the page.
    this.canvas?.addEventListener('wheel', (event) => this.wheel(event), {passive: false});
    this.resize();
  }

  /** Shows everything, or the selected robots when everything is shown already. */
  fit(animate = true): void {
    const bounds = this.bounds();
    if (bounds === null) return;
    this.camera.go(this.camera.fitted(bounds), performance.now(), animate && motion());
    this.context.selection.follow(false);
    this.draw();
  }

  /** The picture as a PNG. */
  picture(): void {
    this.canvas?.toBlob((blob) => {
      if (blob === null) return;
      const anchor = document.createElement('a');
      anchor.href = URL.createObjectURL(blob);
      anchor.download = `${this.context.model.hello?.run.name ?? 'rave'}-${this.placed.time_s.toFixed(2)}s.png`;
      anchor.click();
      URL.revokeObjectURL(anchor.href);
    });
  }

  toggleMeasure(): void {
    this.measuring = !this.measuring;
    this.measured = null;
    this.requestUpdate();
    this.draw();
  }

  private bounds(): Bounds | null {
    const {model, selection} = this.context;
    const bounds = {x0: Infinity, y0: Infinity, x1: -Infinity, y1: -Infinity};
    const add = (x: number, y: number, r: number) => {
      bounds.x0 = Math.min(bounds.x0, x - r);
      bounds.y0 = Math.min(bounds.y0, y - r);
      bounds.x1 = Math.max(bounds.x1, x + r);
      bounds.y1 = Math.max(bounds.y1, y + r);
    };
    const frame = model.poses.newest;
    if (frame !== null) {
      for (let slot = 0; slot < frame.x.length; ++slot) {
        if ((frame.flags[slot] & RobotFlag.known) !== 0) add(frame.x[slot], frame.y[slot], this.view.radius(slot));
      }
    }
    if (selection.slots.length === 0 || frame === null) {
      for (const body of model.bodies.values()) {
        if (body.kind === 'wall' && frame !== null && frame.x.length > 0) continue;
        add(body.pose[0], body.pose[1], 0.3);
      }
    }
    return bounds.x0 <= bounds.x1 ? bounds : null;
  }

  /** Says which sensors are drawn: those of the selection, and of a few real robots. */
  private lookAround(): void {
    const {model, link, selection} = this.context;
    const wanted = new Set<number>(selection.primary === null ? [] : [selection.primary]);
    if (this.layers.scans === 'real') {
      model.robots.forEach((robot, slot) => {
        if (robot.kind === 'real' && wanted.size < kScanned) wanted.add(slot);
      });
    }
    if (this.layers.scans === 'off') wanted.clear();
    const pairs: [number, number][] = [];
    for (const slot of wanted) {
      const robot = model.robots[slot];
      if (robot) for (const sensor of drawnSensors(robot)) pairs.push([slot, sensor]);
    }
    link.look(this, pairs);
  }

  private resize(): void {
    const canvas = this.canvas;
    if (canvas === null) return;
    const {clientWidth, clientHeight} = canvas;
    if (clientWidth === 0 || clientHeight === 0) return;
    this.camera.width = clientWidth;
    this.camera.height = clientHeight;
    canvas.width = Math.round(clientWidth * devicePixelRatio);
    canvas.height = Math.round(clientHeight * devicePixelRatio);
    if (!this.moved) this.fitted = false;
    this.paint();
  }

  private draw(): void {
    if (this.drawQueued) return;
    this.drawQueued = true;
    requestAnimationFrame(() => {
      this.drawQueued = false;
      this.paint();
    });
  }

  private paint(): void {
    const ctx = this.canvas?.getContext('2d');
    if (!ctx || this.camera.width <= 1) return;
    const now_ms = performance.now();
    const {model, selection} = this.context;
    model.poses.interpolate(now_ms, this.placed);
    if (!this.fitted && (this.placed.count > 0 || model.bodies.size > 0) && model.poses.newest !== null) {
      this.fitted = true;
      this.fit(false);
    }
    const primary = selection.primary;
    if (selection.following && primary !== null && primary < this.placed.count) {
      this.camera.x = this.placed.x[primary];
      this.camera.y = this.placed.y[primary];
    }
    const going = this.camera.advance(now_ms);
    ctx.setTransform(devicePixelRatio, 0, 0, devicePixelRatio, 0, 0);
    this.view.draw(ctx, this.camera, this.placed, this.layers);
    this.drawBox(ctx);
    this.drawMeasure(ctx);
    if (going || model.poses.moving(now_ms)) this.draw();
  }

  private drawBox(ctx: CanvasRenderingContext2D): void {
    if (this.box === null) return;
    const [x0, y0, x1, y1] = this.box;
    ctx.strokeStyle = this.context.palette.token('intent');
    ctx.fillStyle = this.context.palette.token('intent-soft');
    ctx.setLineDash([4, 3]);
    ctx.fillRect(x0, y0, x1 - x0, y1 - y0);
    ctx.strokeRect(x0, y0, x1 - x0, y1 - y0);
    ctx.setLineDash([]);
  }

  private drawMeasure(ctx: CanvasRenderingContext2D): void {
    if (this.measured === null) return;
    const [ax, ay, bx, by] = this.measured;
    const {camera} = this;
    const [x0, y0] = [camera.toScreenX(ax), camera.toScreenY(ay)];
    const [x1, y1] = [camera.toScreenX(bx), camera.toScreenY(by)];
    ctx.strokeStyle = this.context.palette.token('intent');
    ctx.lineWidth = 1.5;
    ctx.beginPath();
    ctx.moveTo(x0, y0);
    ctx.lineTo(x1, y1);
    ctx.stroke();
    const degrees = (Math.atan2(by - ay, bx - ax) * 180) / Math.PI;
    const text = `${Math.hypot(bx - ax, by - ay).toFixed(2)} m, ${degrees.toFixed(0)}°`;
    ctx.font = '500 12px "Inter Variable", system-ui, sans-serif';
    const w = ctx.measureText(text).width + 12;
    ctx.fillStyle = this.context.palette.token('bg-2');
    ctx.fillRect(x1 + 8, y1 - 24, w, 20);
    ctx.fillStyle = this.context.palette.token('intent');
    ctx.textAlign = 'left';
    ctx.textBaseline = 'middle';
    ctx.fillText(text, x1 + 14, y1 - 14);
  }

  private slotAt(px: number, py: number): number | null {
    const touch = matchMedia('(pointer: coarse)').matches ? 22 : 8;
    let best: number | null = null;
    let least = Infinity;
    for (let slot = 0; slot < this.placed.count; ++slot) {
      if ((this.placed.flags[slot] & RobotFlag.known) === 0) continue;
      const d = Math.hypot(
        this.camera.toScreenX(this.placed.x[slot]) - px,
        this.camera.toScreenY(this.placed.y[slot]) - py,
      );
      const reach = Math.max(this.view.radius(slot) * this.camera.scale, touch);
      if (d <= reach && d < least) {
        least = d;
        best = slot;
      }
    }
    return best;
  }

  private wheel(event: WheelEvent): void {
    event.preventDefault();
    this.moved = true;
    this.camera.zoom(Math.exp(-event.deltaY * (event.deltaMode === 1 ? 0.05 : 0.0015)), event.offsetX, event.offsetY);
    this.draw();
  }

  private down(event: PointerEvent): void {
    (event.target as HTMLElement).setPointerCapture(event.pointerId);
    this.pointers.set(event.pointerId, {x: event.offsetX, y: event.offsetY});
    this.pressed = {x: event.offsetX, y: event.offsetY, moved: false, box: event.shiftKey};
    if (this.measuring) {
      const [x, y] = this.camera.toWorld(event.offsetX, event.offsetY);
      this.measured = [x, y, x, y];
    }
  }

  private move(event: PointerEvent): void {
    const last = this.pointers.get(event.pointerId);
    if (last === undefined) {
      this.context.selection.hover(this.slotAt(event.offsetX, event.offsetY));
      return;
    }
    const dx = event.offsetX - last.x;
    const dy = event.offsetY - last.y;
    if (this.pointers.size === 2) this.pinch(event, last);
    this.pointers.set(event.pointerId, {x: event.offsetX, y: event.offsetY});
    const pressed = this.pressed;
    if (pressed === null || this.pointers.size !== 1) return;
    if (Math.hypot(event.offsetX - pressed.x, event.offsetY - pressed.y) > 4) pressed.moved = true;
    if (!pressed.moved) return;
    if (this.measured !== null && this.measuring) {
      [this.measured[2], this.measured[3]] = this.camera.toWorld(event.offsetX, event.offsetY);
    } else if (pressed.box) {
      this.box = [pressed.x, pressed.y, event.offsetX, event.offsetY];
    } else {
      this.camera.pan(dx, dy);
      this.moved = true;
      this.context.selection.follow(false);
    }
    this.draw();
  }

  private pinch(event: PointerEvent, last: {x: number; y: number}): void {
    for (const [id, other] of this.pointers) {
      if (id === event.pointerId) continue;
      const before = Math.hypot(last.x - other.x, last.y - other.y);
      const after = Math.hypot(event.offsetX - other.x, event.offsetY - other.y);
      if (before > 1) this.camera.zoom(after / before, (event.offsetX + other.x) / 2, (event.offsetY + other.y) / 2);
      this.camera.pan((event.offsetX - last.x) / 2, (event.offsetY - last.y) / 2);
      this.draw();
    }
    this.moved = true;
    if (this.pressed) this.pressed.moved = true;
  }

  private up(event: PointerEvent): void {
    this.pointers.delete(event.pointerId);
    const pressed = this.pressed;
    if (pressed === null || this.pointers.size > 0) return;
    this.pressed = null;
    const {selection} = this.context;
    if (this.box !== null) {
      selection.set(this.slotsIn(this.box));
      this.box = null;
    } else if (!pressed.moved && !this.measuring) {
      const slot = this.slotAt(event.offsetX, event.offsetY);
      if (slot === null) selection.set([]);
      else if (event.ctrlKey || event.metaKey) selection.toggle(slot);
      else selection.set([slot]);
    }
    this.draw();
  }

  private slotsIn([ax, ay, bx, by]: [number, number, number, number]): number[] {
    const slots: number[] = [];
    for (let slot = 0; slot < this.placed.count; ++slot) {
      const x = this.camera.toScreenX(this.placed.x[slot]);
      const y = this.camera.toScreenY(this.placed.y[slot]);
      const inside = x >= Math.min(ax, bx) && x <= Math.max(ax, bx) && y >= Math.min(ay, by) && y <= Math.max(ay, by);
      if (inside && (this.placed.flags[slot] & RobotFlag.known) !== 0) slots.push(slot);
    }
    return slots;
  }

  private setLayers(layers: Layers): void {
    this.layers = layers;
    localStorage.setItem(kKept, JSON.stringify(layers));
    this.lookAround();
    this.requestUpdate();
    this.draw();
  }

  private toggleKind(kind: Kind, alone: boolean): void {
    const {hidden} = this.layers;
    const others = kKinds.map(([other]) => other).filter((other) => other !== kind);
    if (alone) this.setLayers({...this.layers, hidden: hidden.length === others.length ? [] : others});
    else {
      const next = hidden.includes(kind) ? hidden.filter((other) => other !== kind) : [...hidden, kind];
      this.setLayers({...this.layers, hidden: next});
    }
  }

  private counts(): Map<Kind, number> {
    const counts = new Map<Kind, number>();
    const add = (kind: Kind) => counts.set(kind, (counts.get(kind) ?? 0) + 1);
    for (const robot of this.context.model.robots) add(robot.kind);
    for (const body of this.context.model.bodies.values()) add(body.kind);
    return counts;
  }

  override render(): TemplateResult {
    const {selection, model} = this.context;
    const counts = this.counts();
    const primary = selection.primary;
    return html`
      <div class="bar">
        <div class="legend" role="group" aria-label="Kinds; press to hide, with Alt to show alone">
          ${kKinds.map(([kind, word]) => {
            const count = counts.get(kind);
            if (count === undefined) {
              if (kind !== 'virtual' || !model.hidden.includes('virtual')) return nothing;
              return html`<span class="kind withheld" title=${model.whyNot('obstacles')}>${icon('lock', 13)} virtual obstacles</span>`;
            }
            const hidden = this.layers.hidden.includes(kind);
            return html`<button class="kind" aria-pressed=${!hidden} title="Hide or show ${word}"
              @click=${(event: MouseEvent) => this.toggleKind(kind, event.altKey)}>
              <span class="glyph ${kind}"></span><b>${count}</b> ${word}</button>`;
          })}
        </div>
        <span class="space"></span>
        <button class="icon-button" title="Show everything (F)" aria-label="Show everything" @click=${() => this.fit()}>${icon('maximize')}</button>
        <button class="icon-button" title="Follow the selected robot (C)" aria-label="Follow the selected robot"
          aria-pressed=${selection.following} ?disabled=${primary === null}
          @click=${() => selection.follow(!selection.following)}>${icon('crosshair')}</button>
        <button class="icon-button" title="Measure (M)" aria-label="Measure" aria-pressed=${this.measuring} @click=${() => this.toggleMeasure()}>${icon('ruler')}</button>
        <button class="icon-button" title="Layers" aria-label="Layers" aria-expanded=${this.menuOpen} aria-pressed=${this.menuOpen}
          @click=${() => { this.menuOpen = !this.menuOpen; this.requestUpdate(); }}>${icon('layers')}</button>
        <button class="icon-button" title="Save a picture (P)" aria-label="Save a picture" @click=${() => this.picture()}>${icon('camera')}</button>
      </div>
      <div class="stage">
        <canvas tabindex="0" role="img" aria-label=${this.summary()}
          @pointerdown=${this.down} @pointermove=${this.move} @pointerup=${this.up} @pointercancel=${this.up}
          @pointerleave=${() => selection.hover(null)}></canvas>
        ${selection.following && primary !== null
          ? html`<div class="note">${icon('crosshair', 14)} following <b style="color:${this.context.palette.hue(primary).ink}">${model.robots[primary]?.name}</b> <span>Esc ends</span></div>`
          : nothing}
        ${this.menuOpen ? this.renderMenu() : nothing}
      </div>`;
  }

  private summary(): string {
    const {model} = this.context;
    return `World View: ${model.robots.length} robots, ${model.bodies.size} bodies. The panel Robots lists them.`;
  }

  private renderMenu(): TemplateResult {
    const flag = (name: 'trails' | 'sightings' | 'hits' | 'names' | 'grid', text: string, note = '') => html`
      <label><span>${text}</span><em>${note}</em>
        <input type="checkbox" role="switch" .checked=${this.layers[name]}
          @change=${() => this.setLayers({...this.layers, [name]: !this.layers[name]})}></label>`;
    return html`<div class="menu" role="group" aria-label="Layers">
      <header>Layers <em>saved with the layout</em></header>
      ${flag('trails', 'Trails', '10 s')}
      <label><span>Scans</span>
        <select @change=${(event: Event) => this.setLayers({...this.layers, scans: (event.target as HTMLSelectElement).value as Layers['scans']})}>
          ${(['off', 'selected', 'real'] as const).map((value) => html`<option value=${value} ?selected=${this.layers.scans === value}>${value === 'real' ? 'selected and real' : value}</option>`)}
        </select></label>
      ${flag('sightings', 'Camera sightings')}
      ${flag('hits', 'Where readings hit')}
      ${flag('names', 'Names')}
      ${flag('grid', 'Grid')}
    </div>`;
  }

  static override styles = [
    controls,
    glyphs,
    css`
      :host { display: flex; flex-direction: column; height: 100%; background: var(--bg-1); }
      .bar { display: flex; align-items: center; gap: 2px; height: 40px; padding: 0 10px; border-bottom: 1px solid var(--line-1); overflow: hidden; }
      .legend { display: flex; gap: 4px; overflow: hidden; }
      .kind { display: inline-flex; align-items: center; gap: 6px; height: 26px; padding: 0 8px; border-radius: var(--r-2); color: var(--text-2); font-size: var(--fs-12); white-space: nowrap; }
      .kind b { color: var(--text-1); font-weight: var(--fw-strong); }
      .kind:hover { background: var(--bg-3); }
      .kind[aria-pressed='false'] { opacity: 0.4; text-decoration: line-through; }
      .withheld { color: var(--text-3); }
      .space { flex: 1; }
      .stage { position: relative; flex: 1; min-height: 0; }
      canvas { position: absolute; inset: 0; width: 100%; height: 100%; touch-action: none; display: block; }
      canvas:focus-visible { outline-offset: -2px; }
      .note { position: absolute; left: 14px; top: 26px; display: flex; gap: 7px; align-items: center; height: 30px; padding: 0 12px; background: var(--bg-2); border: 1px solid var(--line-1); border-radius: var(--r-3); font-size: var(--fs-12); color: var(--text-2); }
      .note svg { color: var(--intent); }
      .menu { position: absolute; right: 10px; top: 10px; width: 250px; padding: 8px 14px; background: var(--bg-2); border: 1px solid var(--line-2); border-radius: var(--r-4); box-shadow: var(--shadow-pop); font-size: var(--fs-12); }
      .menu header { display: flex; justify-content: space-between; padding: 4px 0 6px; font-weight: var(--fw-medium); color: var(--text-2); }
      .menu label { display: flex; align-items: center; gap: 8px; height: 28px; cursor: pointer; }
      .menu label span { flex: 1; }
      .menu em { font-style: normal; font-weight: 400; color: var(--text-3); font-size: var(--fs-11); }
      .menu input { appearance: none; width: 26px; height: 15px; border-radius: 99px; border: 1px solid var(--line-3); position: relative; margin: 0; cursor: pointer; }
      .menu input::after { content: ''; position: absolute; left: 2px; top: 2px; width: 9px; height: 9px; border-radius: 50%; background: var(--line-3); }
      .menu input:checked { background: var(--intent-fill); border-color: var(--intent-fill); }
      .menu input:checked::after { left: 13px; background: #fff; }
      .menu select { font: inherit; color: var(--text-1); background: var(--bg-3); border: 1px solid var(--line-2); border-radius: var(--r-2); height: 22px; }
      @media (max-width: 700px) { .kind { padding: 0 5px; font-size: var(--fs-11); } }
    `,
  ];
}

function motion(): boolean {
  return !matchMedia('(prefers-reduced-motion: reduce)').matches;
}

customElements.define('rave-world', WorldPanel);
