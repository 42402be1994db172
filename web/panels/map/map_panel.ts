// SPDX-License-Identifier: Apache-2.0
import {html, nothing, type TemplateResult} from 'lit';
import {icon} from '../../ui/icons';
import {controls, glyphs} from '../../ui/styles';
import {rightText} from '../../model/withheld';
import {keyOf, type MapKey} from '../../model/maps';
import type {Signal} from '../../model/signal';
import {RobotFlag} from '../../protocol/frames';
import type {MapName} from '../../protocol/messages';
import {LookingPanel} from '../looking_panel';
import {renderNote, renderWithheld, withheldStyles} from '../withheld';
import {Camera} from '../world/camera';
import {drawGrid, drawScale} from '../world/grid_layer';
import {RobotLayer} from '../world/robot_layer';
import {drawTrail, kTrail_s, trailFrames} from '../world/trail_layer';
import {boundsOf, drawMap} from '../world/draw_map';
import {MapGestures} from './map_gestures';
import {mapStyles} from './map_styles';

const kTextRefresh_ms = 500;
const kZoom = 1.4;
/** More robots are not drawn over a global map. */
const kMostRobots = 400;

/** The local map of a robot or a global map, alone or over the world. */
export class MapPanel extends LookingPanel {
  protected readonly refresh_ms = kTextRefresh_ms;
  /** By name, so that it is found again in another roster; null: not chosen yet. */
  private chosen: MapName | null = null;
  private opacity = 0.6;
  private moved = false;
  private fittedTiles = 0;
  private robots: RobotLayer | null = null;
  private readonly camera = new Camera();
  private readonly gestures = new MapGestures(this.camera, () => {
    this.moved = true;
    this.draw();
  });
  protected override signals(): Signal[] {
    const {maps} = this.context.model;
    return [maps.namesChanged, maps.overlayChanged];
  }

  protected lookAway(): void {
    this.context.link.lookAtMap(this, null);
  }

  /** What was chosen, else that of the selected robot, else the first. */
  private get source(): MapName | null {
    const {names} = this.context.model.maps;
    const same = names.find(
      (name) =>
        name.name === this.chosen?.name &&
        (name.slot === undefined) === (this.chosen.slot === undefined),
    );
    return (
      same ??
      names.find(
        (name) => name.slot !== undefined && name.slot === this.context.selection.primary,
      ) ??
      names[0] ??
      null
    );
  }

  private get key(): MapKey | null {
    const {source} = this;
    return source === null ? null : keyOf(source);
  }

  protected lookAround(): void {
    const {model, palette, selection} = this.context;
    this.robots ??= new RobotLayer(palette, selection);
    this.robots.refresh(model.robots);
    // It stays with its source, whatever is selected later.
    this.chosen ??= this.source;
    this.context.link.lookAtMap(this, this.key);
  }

  private get isOver(): boolean {
    const {overlay} = this.context.model.maps;
    return overlay !== null && overlay.key === this.key;
  }

  private choose(index: number): void {
    const {maps} = this.context.model;
    const over = this.isOver;
    this.chosen = maps.names[index] ?? null;
    this.moved = false;
    this.fittedTiles = 0;
    this.lookAround();
    if (over && this.key !== null) maps.show({key: this.key, opacity: this.opacity});
    this.requestUpdate();
    this.draw();
  }

  private setOver(on: boolean): void {
    const {maps} = this.context.model;
    maps.show(on && this.key !== null ? {key: this.key, opacity: this.opacity} : null);
  }

  private setOpacity(percent: number): void {
    this.opacity = percent / 100;
    const {maps} = this.context.model;
    if (maps.overlay !== null && this.isOver) maps.show({...maps.overlay, opacity: this.opacity});
    this.requestUpdate();
  }

  override render(): TemplateResult {
    const {model} = this.context;
    const {source} = this;
    if (!model.may('maps')) return renderWithheld(this.context, 'maps');
    if (source === null)
      return model.seesLess && model.live
        ? renderNote(this.context, this.whyNone())
        : html`<p class="none">${this.whyNone()}</p>`;
    const over = this.isOver;
    // It may have been set in the World View.
    if (over) this.opacity = model.maps.overlay?.opacity ?? this.opacity;
    return html` <div class="head">
        ${this.renderSources(source)}
        <span class="about">${this.about(source)}</span>
        ${this.renderBlend(over)}
      </div>
      <div class="stage">
        <canvas
          tabindex="0"
          role="img"
          aria-label=${this.summary(source)}
          @pointerdown=${this.gestures.down}
          @pointermove=${this.gestures.move}
          @pointerup=${this.gestures.up}
          @pointercancel=${this.gestures.up}
          @wheel=${this.gestures.wheel}
          @keydown=${this.gestures.key}></canvas>
        ${model.maps.of(keyOf(source)) === null
          ? html`<p class="waits">${this.waits(source)}</p>`
          : nothing}
        <div class="legend" aria-hidden="true">
          <span><i class="free"></i>free</span><span><i class="occupied"></i>occupied</span
          ><span><i class="unknown"></i>unknown</span>
        </div>
        ${this.renderZoom()}
      </div>`;
  }

  /** Whether it lies over the World View, and how opaque. */
  private renderBlend(over: boolean): TemplateResult {
    return html`<span class="blend"
      ><label class="over"
        ><input
          type="checkbox"
          role="switch"
          .checked=${over}
          @change=${(event: Event) => this.setOver((event.target as HTMLInputElement).checked)} />
        <span>over the world</span></label
      >
      <input
        class="opacity"
        type="range"
        min="10"
        max="100"
        step="5"
        aria-label="Opacity over the world"
        .value=${String(Math.round(100 * this.opacity))}
        ?disabled=${!over}
        @input=${(event: Event) =>
          this.setOpacity(Number((event.target as HTMLInputElement).value))} />
      <output>${Math.round(100 * this.opacity)} %</output></span
    >`;
  }

  /** Its size, and all of it. */
  private renderZoom(): TemplateResult {
    return html`<div class="zoom">
      <button
        class="icon-button"
        title="Larger (+)"
        aria-label="Larger"
        @click=${() => this.gestures.zoom(kZoom)}>
        ${icon('plus')}
      </button>
      <button
        class="icon-button"
        title="Smaller (-)"
        aria-label="Smaller"
        @click=${() => this.gestures.zoom(1 / kZoom)}>
        ${icon('minus')}
      </button>
      <button
        class="icon-button"
        title="Show all of the map"
        aria-label="Show all of the map"
        @click=${() => {
          this.moved = false;
          this.fittedTiles = 0;
          this.draw();
        }}>
        ${icon('maximize')}
      </button>
    </div>`;
  }

  private renderSources(source: MapName): TemplateResult {
    const {names} = this.context.model.maps;
    const {palette, model} = this.context;
    const options = (local: boolean) =>
      names.map((name, i) =>
        (name.slot !== undefined) === local
          ? html`<option value=${i} ?selected=${name === source}>
              ${local ? 'local' : 'global'}: ${name.name}
            </option>`
          : nothing,
      );
    const robot = source.slot === undefined ? undefined : model.robots[source.slot];
    const hue = source.slot === undefined ? null : palette.hue(source.slot);
    return html`<span class="source">
      ${robot === undefined || hue === null
        ? icon('map', 14)
        : html`<i
            class="glyph ${robot.kind}"
            style="--hue:${robot.kind === 'real' ? hue.fill : hue.ink}"></i>`}
      <select
        aria-label="Map"
        @change=${(event: Event) => this.choose(Number((event.target as HTMLSelectElement).value))}>
        ${names.some((name) => name.slot !== undefined)
          ? html`<optgroup label="Local maps of robots">${options(true)}</optgroup>`
          : nothing}
        ${names.some((name) => name.slot === undefined)
          ? html`<optgroup label="Global maps">${options(false)}</optgroup>`
          : nothing}</select
      >${icon('chevronDown', 14)}</span
    >`;
  }

  private about(source: MapName): string {
    const {model} = this.context;
    const grid = model.maps.of(keyOf(source));
    if (grid === null) return '';
    const cells = `${Number(grid.frame.resolution_m.toPrecision(3))} m cells`;
    if (source.slot === undefined && grid.stamp_s === 0) return cells;
    const age_s = Math.max(0, (model.poses.newest?.time_s ?? grid.stamp_s) - grid.stamp_s);
    return `${cells} · ${age_s.toFixed(1)} s old`;
  }

  private whyNone(): string {
    const {model} = this.context;
    if (!model.live)
      return 'No program of this run has published a map, and its world has nothing to map.';
    if (!model.seesLess)
      return 'There is no map: no robot has a range sensor, and there is no global map.';
    return `There is no map that you may see. ${rightText('maps', model.others)}`;
  }

  private waits(source: MapName): string {
    if (source.slot === undefined) return `${source.name} has no data yet.`;
    if (!this.context.model.live) return `${source.name} had published no map yet at this time.`;
    return `The map of ${source.name} begins now: it shows what the sensors see from this time on.`;
  }

  private summary(source: MapName): string {
    const grid = this.context.model.maps.of(keyOf(source));
    const size =
      grid === null
        ? 'nothing yet'
        : `${grid.tiles.size} tiles of ${grid.frame.columns} x ${grid.frame.rows} cells, ` +
          this.about(source);
    return `Map of ${source.name}: ${size}. Arrows move it, + and - change its size.`;
  }

  protected paint(): void {
    const canvas = this.renderRoot.querySelector('canvas');
    const ctx = canvas?.getContext('2d');
    const {model, palette} = this.context;
    if (!canvas || !ctx || canvas.clientWidth === 0) return;
    const {camera} = this;
    [camera.width, camera.height] = [canvas.clientWidth, canvas.clientHeight];
    const [w, h] = [
      Math.round(camera.width * devicePixelRatio),
      Math.round(camera.height * devicePixelRatio),
    ];
    if (canvas.width !== w || canvas.height !== h) [canvas.width, canvas.height] = [w, h];
    ctx.setTransform(devicePixelRatio, 0, 0, devicePixelRatio, 0, 0);
    ctx.fillStyle = palette.token('floor');
    ctx.fillRect(0, 0, camera.width, camera.height);
    const {key} = this;
    const grid = key === null ? null : model.maps.of(key);
    this.fit();
    drawGrid(ctx, camera, palette);
    if (grid !== null) drawMap(ctx, camera, grid, palette);
    model.poses.interpolate(performance.now(), this.placed);
    this.drawRobots(ctx);
    drawScale(ctx, camera, palette);
    if (model.poses.moving(performance.now())) this.draw();
  }

  /** Shows all that is known, until the person has moved it. */
  private fit(): void {
    const grid = this.key === null ? null : this.context.model.maps.of(this.key);
    if (grid === null || this.moved || grid.tiles.size === this.fittedTiles) return;
    const bounds = boundsOf(grid);
    if (bounds === null) return;
    this.fittedTiles = grid.tiles.size;
    Object.assign(this.camera, this.camera.fitted(bounds, 24));
  }

  /** The robot that makes the map, with its trail; over a global map all of them. */
  private drawRobots(ctx: CanvasRenderingContext2D): void {
    const {model, palette} = this.context;
    const {placed, camera, source} = this;
    const slots =
      source?.slot === undefined ? [...model.robots.keys()].slice(0, kMostRobots) : [source.slot];
    const frames = trailFrames(model.poses.past, placed, kTrail_s);
    for (const slot of slots) {
      const robot = model.robots[slot];
      if (
        robot === undefined ||
        slot >= placed.count ||
        (placed.flags[slot] & RobotFlag.known) === 0
      )
        continue;
      if (frames.length > 1) drawTrail(ctx, camera, placed, frames, slot, robot, palette);
      this.robots?.draw(ctx, camera, placed, slot, robot, null);
    }
  }

  static override styles = [controls, glyphs, mapStyles, withheldStyles];
}

customElements.define('rave-map', MapPanel);
