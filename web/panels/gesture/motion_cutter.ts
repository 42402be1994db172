// SPDX-License-Identifier: Apache-2.0

/** An acceleration without gravity, m/s², in the axes of the phone. */
export type Acceleration = readonly [number, number, number];

/** A hand moves above this, and rests below half of it; m/s². */
const kMoves_mps2 = 2;
/** A motion is over when the hand rests for so long. */
const kRest_s = 0.35;
/** Shorter ones are a twitch, longer ones are none that is meant. */
const kShortest_s = 0.3;
const kLongest_s = 6;
/** How fast gravity is learnt from a sensor that cannot tell it apart, per second. */
const kGravity_ps = 0.8;

/** Cuts single motions out of what a sensor of acceleration says, while the key is held. */
export class MotionCutter {
  private samples: {at_s: number; a: Acceleration}[] = [];
  private moved_s = -Infinity;
  private gravity: [number, number, number] | null = null;

  begin(): void {
    this.samples = [];
    this.moved_s = -Infinity;
    this.gravity = null;
  }

  /** The same without what changes slowly: for sensors whose values have gravity in them. */
  withoutGravity(a: Acceleration, dt_s: number): Acceleration {
    this.gravity ??= [...a];
    const share = Math.min(1, kGravity_ps * dt_s);
    for (const axis of [0, 1, 2]) this.gravity[axis] += share * (a[axis] - this.gravity[axis]);
    return [a[0] - this.gravity[0], a[1] - this.gravity[1], a[2] - this.gravity[2]];
  }

  /** A sample; the motion that ends with it, or null. */
  take(at_s: number, a: Acceleration): Acceleration[] | null {
    const size = Math.hypot(...a);
    const moving = this.samples.length > 0;
    if (size > kMoves_mps2 || (moving && size > kMoves_mps2 / 2)) this.moved_s = at_s;
    if (!moving && this.moved_s !== at_s) return null;
    this.samples.push({at_s, a});
    const long_s = at_s - this.samples[0].at_s;
    if (at_s - this.moved_s < kRest_s && long_s < kLongest_s) return null;
    const motion = this.samples.filter((one) => one.at_s <= this.moved_s);
    const lasted_s = this.moved_s - this.samples[0].at_s;
    this.samples = [];
    return lasted_s < kShortest_s || long_s >= kLongest_s ? null : motion.map((one) => one.a);
  }
}

/** Listens to the phone's sensor; returns what ends it. `said`: why there is nothing to hear. */
export function listenToMotion(
  cutter: MotionCutter,
  made: (motion: Acceleration[]) => void,
  said: (why: string) => void,
): () => void {
  if (!window.isSecureContext || typeof DeviceMotionEvent === 'undefined') {
    said('This page gets no motions of the phone: draw, or open it by https.');
    return () => {};
  }
  // Browsers of phones ask the person first.
  const asking = DeviceMotionEvent as unknown as {requestPermission?: () => Promise<string>};
  asking
    .requestPermission?.()
    .then((answer) => answer !== 'granted' && said('The phone does not share its motions: draw.'))
    .catch(() => said('The phone does not share its motions: draw.'));
  cutter.begin();
  let last_s = -1;
  const take = (event: DeviceMotionEvent) => {
    const at_s = event.timeStamp / 1000;
    const dt_s = last_s < 0 ? 0 : at_s - last_s;
    last_s = at_s;
    const [own, whole] = [event.acceleration, event.accelerationIncludingGravity];
    const values = (from: DeviceMotionEventAcceleration): Acceleration => [
      from.x ?? 0,
      from.y ?? 0,
      from.z ?? 0,
    ];
    if (own?.x == null && whole?.x == null) return;
    const a = own?.x != null ? values(own) : cutter.withoutGravity(values(whole!), dt_s);
    const motion = cutter.take(at_s, a);
    if (motion !== null) made(motion);
  };
  window.addEventListener('devicemotion', take);
  return () => window.removeEventListener('devicemotion', take);
}
