// SPDX-License-Identifier: Apache-2.0
import type {Robot} from '../protocol/messages';
import {Signal} from '../model/signal';

/** Fill for areas, ink for lines and text. */
export interface Hue {
  fill: string;
  ink: string;
}

const kRealHues = 5;
const kKindHues = 3;

/** The colours of tokens.css as they are in the present theme, for what is drawn on a canvas. */
export class Palette {
  theme: 'dark' | 'light' = 'dark';
  readonly changed = new Signal();
  private readonly known = new Map<string, string>();
  private hueNames: string[] = [];

  constructor(private readonly root: HTMLElement) {}

  set(theme: 'dark' | 'light'): void {
    this.theme = theme;
    this.root.dataset['theme'] = theme;
    this.known.clear();
    this.changed.emit();
  }

  /** Value of a token, such as `floor`. */
  token(name: string): string {
    let value = this.known.get(name);
    if (value === undefined) {
      value = getComputedStyle(this.root).getPropertyValue(`--${name}`).trim();
      this.known.set(name, value);
    }
    return value;
  }

  /** Gives the robots of a roster their hues: real ones in order, simulated ones by their kind,
   * each kind one of its own. */
  assign(robots: readonly Robot[]): void {
    let real = 0;
    const kinds = [...new Set(robots.map(({word}) => word).filter((word) => word !== ''))];
    this.hueNames = robots.map((robot) => {
      if (robot.kind === 'real') return `real-${(real++ % kRealHues) + 1}`;
      return robot.word === '' ? 'sim' : `kind-${(kinds.indexOf(robot.word) % kKindHues) + 1}`;
    });
  }

  hueName(slot: number): string {
    return this.hueNames[slot] ?? 'sim';
  }

  hue(slot: number): Hue {
    const name = this.hueName(slot);
    return {fill: this.token(name), ink: this.token(`${name}-ink`)};
  }
}
