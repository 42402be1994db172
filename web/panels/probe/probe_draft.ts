// SPDX-License-Identifier: Apache-2.0
import type {Parameter, ProbeRequest, Robot, VirtualSensor} from '../../protocol/messages';

/** Where a sensor sits on its robot, as a robot file has it. */
export const kMount = [
  {key: 'x_m', unit: 'm', most: 0.5, doc: 'Position forward of the origin of the robot.'},
  {key: 'y_m', unit: 'm', most: 0.5, doc: 'Position to the left of the origin of the robot.'},
  {key: 'z_m', unit: 'm', most: 1, doc: 'Height above the floor.'},
  {key: 'yaw_deg', unit: 'deg', most: 180, doc: 'Viewing direction, counter-clockwise from ahead.'},
] as const;
export type MountKey = (typeof kMount)[number]['key'];

export type Setting = number | string | boolean | number[];

/** A virtual sensor as a person is setting it up: what was set is kept, by driver. */
export class ProbeDraft {
  driver = '';
  readonly mount: Record<MountKey, number> = {x_m: 0, y_m: 0, z_m: 0.1, yaw_deg: 0};
  private readonly set_ = new Map<string, Setting>();

  choose(driver: string): void {
    this.driver = driver;
  }

  valueOf(driver: VirtualSensor, parameter: Parameter): Setting | undefined {
    return this.set_.get(`${driver.name} ${parameter.key}`) ?? parameter.value;
  }

  /** What is the default again needs not be said. */
  set(driver: VirtualSensor, parameter: Parameter, value: Setting): void {
    const key = `${driver.name} ${parameter.key}`;
    const plain = Array.isArray(value) ? value.length === 0 : value === parameter.value;
    if (plain) this.set_.delete(key);
    else this.set_.set(key, value);
  }

  /** As the server is asked for it; its name is none that a sensor of the robot has. */
  request(slot: number, robot: Pick<Robot, 'sensors'>, driver: VirtualSensor): ProbeRequest {
    const params: ProbeRequest['params'] = {};
    for (const parameter of driver.parameters) {
      const value = this.set_.get(`${driver.name} ${parameter.key}`);
      // What is no number is refused with the others, by its name.
      if (value !== undefined)
        params[parameter.key] = Array.isArray(value)
          ? value.map((number) => (Number.isFinite(number) ? number : 0))
          : typeof value === 'number' && !Number.isFinite(value)
            ? 0
            : value;
    }
    const {x_m, y_m, z_m, yaw_deg} = this.mount;
    const yaw = (Math.max(-360, Math.min(360, yaw_deg)) * Math.PI) / 180;
    return {
      slot,
      name: freeName(driver.name, robot),
      driver: driver.name,
      mount: [x_m, y_m, yaw],
      z: z_m,
      params,
    };
  }
}

function freeName(driver: string, robot: Pick<Robot, 'sensors'>): string {
  const taken = new Set(robot.sensors.map(({name}) => name));
  let name = driver;
  for (let i = 2; taken.has(name); ++i) name = `${driver}_${i}`;
  return name;
}
