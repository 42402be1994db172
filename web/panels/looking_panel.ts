// SPDX-License-Identifier: Apache-2.0
import {LiveElement} from '../ui/live_element';
import {Placed} from '../model/pose_history';
import type {Signal} from '../model/signal';
import {viewOf} from '../model/windows';

/** A panel that looks at something of the run and draws it. It subscribes when it comes into the
 * page and leaves nothing behind when it goes; the dock takes panels out while they are hidden. */
export abstract class LookingPanel extends LiveElement {
  protected readonly placed = new Placed();
  private drawQueued = false;
  private readonly resized = new ResizeObserver(() => this.draw());

  /** How often its texts are made anew, milliseconds. */
  protected abstract readonly refresh_ms: number;
  /** Signals, beside those of roster, colours and selection, after which it looks around anew. */
  protected signals(): Signal[] {
    return [];
  }
  /** What it shows may be another now: says what it looks at. */
  protected abstract lookAround(): void;
  /** It goes: looks at nothing. */
  protected abstract lookAway(): void;
  protected abstract paint(): void;
  /** The slots may mean other robots. */
  protected rosterChanged(): void {}

  protected override listen(): (() => void)[] {
    // A picture that another window was to draw does not come.
    this.drawQueued = false;
    const {model, selection, palette} = this.context;
    const changed = () => this.changed();
    this.resized.observe(this);
    changed();
    return [
      model.rosterChanged.on(() => {
        this.rosterChanged();
        changed();
      }),
      ...[palette.changed, selection.changed, ...this.signals()].map((signal) =>
        signal.on(changed),
      ),
      model.pictureChanged.on(() => this.draw()),
      this.every(this.refresh_ms, () => this.requestUpdate()),
      () => this.lookAway(),
      () => this.resized.disconnect(),
    ];
  }

  override updated(): void {
    this.draw();
  }

  protected changed(): void {
    this.lookAround();
    this.requestUpdate();
    this.draw();
  }

  /** Paints with the next picture of the browser. */
  protected draw(): void {
    if (this.drawQueued) return;
    this.drawQueued = true;
    viewOf(this).requestAnimationFrame(() => {
      this.drawQueued = false;
      if (this.isConnected) this.paint();
    });
  }

  /** Paints on a canvas of the panel, in pixels of the page; does nothing while that is not
   * there. */
  protected onCanvas(
    name: string,
    paint: (ctx: CanvasRenderingContext2D, w: number, h: number) => void,
  ): void {
    const canvas = this.renderRoot.querySelector<HTMLCanvasElement>(name);
    const ctx = canvas?.getContext('2d');
    if (!canvas || !ctx || canvas.clientWidth === 0) return;
    const {clientWidth, clientHeight} = canvas;
    const [w, h] = [
      Math.round(clientWidth * devicePixelRatio),
      Math.round(clientHeight * devicePixelRatio),
    ];
    if (canvas.width !== w || canvas.height !== h) [canvas.width, canvas.height] = [w, h];
    ctx.setTransform(devicePixelRatio, 0, 0, devicePixelRatio, 0, 0);
    ctx.clearRect(0, 0, clientWidth, clientHeight);
    paint(ctx, clientWidth, clientHeight);
  }
}
