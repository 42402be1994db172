// SPDX-License-Identifier: Apache-2.0
import type {RunModel} from '../model/run_model';
import type {Selection} from '../panel_api/selection';

const kKey = 'rave.selection';

/** A page that is loaded again has the same robots selected, by name. Of one tab, until it is
 * closed. */
export class KeptSelection {
  private kept: string | null;
  private restored = false;

  constructor(
    private readonly model: RunModel,
    private readonly selection: Selection,
  ) {
    this.kept = sessionStorage.getItem(kKey);
    selection.changed.on(() => this.keep());
  }

  private keep(): void {
    // Before the first roster the selection is empty, since no robot is known.
    if (!this.restored) return;
    const names = JSON.stringify(
      this.selection.slots.map((slot) => this.model.robots[slot]?.name ?? ''),
    );
    if (names === this.kept) return;
    this.kept = names;
    sessionStorage.setItem(kKey, names);
  }

  /** Once, with the first roster, unless something is selected already. */
  restore(): void {
    if (this.restored) return;
    this.restored = true;
    if (this.selection.slots.length > 0 || this.kept === null) return this.keep();
    const names = JSON.parse(this.kept) as string[];
    this.selection.set(
      names
        .map((name) => this.model.robots.findIndex((robot) => robot.name === name))
        .filter((slot) => slot >= 0),
    );
  }
}
