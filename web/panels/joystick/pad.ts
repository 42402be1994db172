// SPDX-License-Identifier: Apache-2.0

/** Sticks that are let go are not quite at zero. */
const kDead = 0.12;

/** The left stick of the first gamepad, or its cross; null: there is none, or it is at rest. */
export function readPad(): {name: string; x: number; y: number; held: boolean} | null {
  for (const pad of navigator.getGamepads?.() ?? []) {
    if (pad === null || !pad.connected) continue;
    const pressed = (i: number) => (pad.buttons[i]?.pressed ? 1 : 0);
    let x = pad.axes[0] ?? 0;
    let y = -(pad.axes[1] ?? 0);
    if (Math.hypot(x, y) < kDead) [x, y] = [pressed(15) - pressed(14), pressed(12) - pressed(13)];
    return {name: pad.id, x, y, held: Math.hypot(x, y) >= kDead};
  }
  return null;
}

/** The first gamepad as a vehicle: left stick steers, right trigger is the throttle, left one the
 * brake, shoulder buttons change the gear. Null: there is none. */
export function readCarPad(): {
  name: string;
  steering: number;
  throttle: number;
  brake: number;
  down: boolean;
  up: boolean;
} | null {
  for (const pad of navigator.getGamepads?.() ?? []) {
    if (pad === null || !pad.connected) continue;
    const steering = pad.axes[0] ?? 0;
    const value = (i: number) => pad.buttons[i]?.value ?? 0;
    return {
      name: pad.id,
      steering: Math.abs(steering) < kDead ? 0 : steering,
      throttle: value(7),
      brake: value(6),
      down: pad.buttons[4]?.pressed ?? false,
      up: pad.buttons[5]?.pressed ?? false,
    };
  }
  return null;
}
