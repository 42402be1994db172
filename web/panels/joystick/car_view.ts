// SPDX-License-Identifier: Apache-2.0
import {css, html, type TemplateResult} from 'lit';
import {kGears, type Gear, type Pedals} from './car';

/** What the four controls show and do. */
export interface CarView {
  pedals: Pedals;
  gear: Gear;
  disabled: boolean;
  robot: string;
  /** A finger or the mouse is on one of them; `value` as in Pedals. 0: it let go. */
  touch(control: keyof Pedals, value: number): void;
  shift(gear: Gear): void;
  key(event: KeyboardEvent, down: boolean): void;
  blur(): void;
}

const kKeys =
  'hold W or the arrow up for the throttle, S or down for the brake, A and D to steer; ' +
  'E and Q change the gear';

export function renderCar(view: CarView): TemplateResult {
  const {steering, throttle, brake} = view.pedals;
  return html`<div
    class="car"
    tabindex="0"
    role="application"
    aria-disabled=${view.disabled}
    aria-label="Pedals of ${view.robot}: ${kKeys}"
    @keydown=${(event: KeyboardEvent) => view.key(event, true)}
    @keyup=${(event: KeyboardEvent) => view.key(event, false)}
    @blur=${() => view.blur()}
    @contextmenu=${(event: Event) => event.preventDefault()}>
    <div class="gears" role="radiogroup" aria-label="Gear">
      ${kGears.map(
        ({gear, letter, name}) =>
          html`<button
            role="radio"
            tabindex="-1"
            aria-checked=${view.gear === gear}
            aria-label=${name}
            title=${name}
            ?disabled=${view.disabled}
            @click=${() => view.shift(gear)}>
            ${letter}
          </button>`,
      )}
    </div>
    ${pad('steering', 'Steering', (steering + 1) / 2, view, (x) => 2 * x - 1)}
    ${pad('brake', 'Brake', brake, view, (_, y) => y)}${pad(
      'throttle',
      'Throttle',
      throttle,
      view,
      (_, y) => y,
    )}
  </div>`;
}

/** A control that counts only while it is held. */
function pad(
  control: keyof Pedals,
  name: string,
  share: number,
  view: CarView,
  read: (x: number, y: number) => number,
): TemplateResult {
  const point = (event: PointerEvent) => {
    const box = (event.currentTarget as HTMLElement).getBoundingClientRect();
    const within = (value: number) => Math.max(0, Math.min(1, value));
    view.touch(
      control,
      read(
        within((event.clientX - box.left) / box.width),
        within(1 - (event.clientY - box.top) / box.height),
      ),
    );
  };
  const press = (event: PointerEvent) => {
    const element = event.currentTarget as HTMLElement;
    element.setPointerCapture(event.pointerId);
    element.closest<HTMLElement>('.car')?.focus();
    event.preventDefault();
    point(event);
  };
  const held = (event: PointerEvent) =>
    (event.currentTarget as HTMLElement).hasPointerCapture(event.pointerId);
  const level =
    control === 'steering' ? `left:calc(${100 * share}% - 14px)` : `height:${100 * share}%`;
  return html`<div
    class="pad ${control}"
    data-control=${control}
    @pointerdown=${press}
    @pointermove=${(event: PointerEvent) => held(event) && point(event)}
    @pointerup=${() => view.touch(control, 0)}
    @pointercancel=${() => view.touch(control, 0)}
    @lostpointercapture=${() => view.touch(control, 0)}>
    <i style=${level}></i><span>${name}</span>
  </div>`;
}

export const carStyles = css`
  .car {
    position: absolute;
    inset: 8px 14px 6px;
    max-height: 260px;
    margin: auto 0;
    display: grid;
    grid-template: minmax(0, 1fr) / auto 1.6fr 1fr 1fr;
    gap: 10px;
    border-radius: var(--r-4);
  }
  .car[aria-disabled='true'] {
    opacity: 0.45;
    pointer-events: none;
  }
  .gears {
    display: grid;
    grid-template-rows: repeat(3, minmax(20px, 40px));
    align-content: center;
    gap: 4px;
    min-height: 0;
  }
  .gears button {
    width: 36px;
    border-radius: var(--r-3);
    background: var(--bg-3);
    color: var(--text-2);
    font-weight: var(--fw-strong);
  }
  .gears button[aria-checked='true'] {
    background: var(--intent-fill);
    color: #fff;
  }
  .pad {
    position: relative;
    overflow: hidden;
    min-height: 0;
    border: 1px solid var(--line-3);
    border-radius: var(--r-4);
    background: var(--bg-2);
    touch-action: none;
    user-select: none;
    cursor: grab;
  }
  .pad span {
    position: absolute;
    left: 0;
    right: 0;
    bottom: 6px;
    text-align: center;
    color: var(--text-1);
    font-size: var(--fs-12);
    pointer-events: none;
  }
  .pad i {
    position: absolute;
    left: 0;
    right: 0;
    bottom: 0;
    background: var(--intent-soft);
    border-top: 2px solid var(--intent);
    pointer-events: none;
  }
  .pad.brake i {
    background: var(--warn-soft);
    border-top-color: var(--warn);
  }
  .pad.steering {
    align-self: center;
    height: min(84px, 100%);
  }
  .pad.steering i {
    right: auto;
    top: 10px;
    bottom: 30px;
    width: 28px;
    border: 0;
    border-radius: var(--r-3);
    background: var(--intent-fill);
  }
`;
