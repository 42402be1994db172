// SPDX-License-Identifier: Apache-2.0
import type {Camera} from '../world/camera';

const kKeyPan_px = 60;
const kKeyZoom = 1.3;

/** Mouse, fingers, wheel and keys over a map: pan and zoom. `moved` is called after each change. */
export class MapGestures {
  private readonly pointers = new Map<number, {x: number; y: number}>();

  constructor(
    private readonly camera: Camera,
    private readonly moved: () => void,
  ) {}

  readonly down = (event: PointerEvent): void => {
    (event.currentTarget as HTMLElement).setPointerCapture(event.pointerId);
    this.pointers.set(event.pointerId, {x: event.offsetX, y: event.offsetY});
  };

  readonly move = (event: PointerEvent): void => {
    const last = this.pointers.get(event.pointerId);
    if (last === undefined) return;
    const {offsetX: x, offsetY: y} = event;
    const others = [...this.pointers].filter(([id]) => id !== event.pointerId);
    for (const [, other] of others) {
      const before = Math.hypot(last.x - other.x, last.y - other.y);
      const after = Math.hypot(x - other.x, y - other.y);
      if (before > 1) this.camera.zoom(after / before, (x + other.x) / 2, (y + other.y) / 2);
    }
    // Each of two fingers moves the picture by its half.
    this.camera.pan((x - last.x) / (1 + others.length), (y - last.y) / (1 + others.length));
    this.pointers.set(event.pointerId, {x, y});
    this.moved();
  };

  readonly up = (event: PointerEvent): void => {
    this.pointers.delete(event.pointerId);
  };

  readonly wheel = (event: WheelEvent): void => {
    event.preventDefault();
    this.camera.zoom(
      Math.exp(-event.deltaY * (event.deltaMode === 1 ? 0.05 : 0.0015)),
      event.offsetX,
      event.offsetY,
    );
    this.moved();
  };

  readonly key = (event: KeyboardEvent): void => {
    const pans: Record<string, [number, number]> = {
      ArrowLeft: [1, 0],
      ArrowRight: [-1, 0],
      ArrowUp: [0, 1],
      ArrowDown: [0, -1],
    };
    const pan = pans[event.key];
    if (event.ctrlKey || event.metaKey || event.altKey || event.shiftKey) return;
    if (pan !== undefined) this.camera.pan(kKeyPan_px * pan[0], kKeyPan_px * pan[1]);
    else if (event.key === '+' || event.key === '-')
      this.zoom(event.key === '+' ? kKeyZoom : 1 / kKeyZoom);
    else return;
    event.preventDefault();
    event.stopPropagation();
    this.moved();
  };

  /** About the middle. */
  zoom(factor: number): void {
    this.camera.zoom(factor, this.camera.width / 2, this.camera.height / 2);
    this.moved();
  }
}
