// SPDX-License-Identifier: Apache-2.0

const kUnits: Record<string, [number, number]> = {
  w: [0, 1],
  s: [0, -1],
  a: [-1, 0],
  d: [1, 0],
  arrowup: [0, 1],
  arrowdown: [0, -1],
  arrowleft: [-1, 0],
  arrowright: [1, 0],
};

/** Which of the keys that drive are down. */
export class DriveKeys {
  private readonly down = new Set<string>();

  /** True if it is one of them. */
  press(key: string): boolean {
    const name = key.toLowerCase();
    if (!(name in kUnits)) return false;
    this.down.add(name);
    return true;
  }

  lift(key: string): boolean {
    return this.down.delete(key.toLowerCase());
  }

  clear(): void {
    this.down.clear();
  }

  get held(): boolean {
    return this.down.size > 0;
  }

  /** Where the stick would be. */
  get place(): [number, number] {
    let [x, y] = [0, 0];
    for (const name of this.down) {
      x += kUnits[name][0];
      y += kUnits[name][1];
    }
    return [Math.max(-1, Math.min(1, x)), Math.max(-1, Math.min(1, y))];
  }
}
