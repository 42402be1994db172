// SPDX-License-Identifier: Apache-2.0
export type SetValue = string | number | boolean;

/** Values of parameters as the panel shows them: what was asked here until the run says what holds,
 * which another page or a terminal may have set as well. */
export class SetValues {
  /** What was asked, and what held then. */
  private readonly asked = new Map<string, {value: SetValue; over: SetValue | undefined}>();

  /** `present`: as the run tells it. */
  ask(name: string, value: SetValue, present: SetValue | undefined): void {
    this.asked.set(name, {value, over: present});
  }

  refuse(name: string): void {
    this.asked.delete(name);
  }

  shown(name: string, present: SetValue | undefined): SetValue | undefined {
    const asked = this.asked.get(name);
    if (asked === undefined) return present;
    if (asked.over === present) return asked.value;
    this.asked.delete(name);
    return present;
  }
}
