// SPDX-License-Identifier: Apache-2.0
import {css, html, nothing, type TemplateResult} from 'lit';
import {icon} from '../../ui/icons';
import {keyOf} from '../../model/maps';
import type {RunModel} from '../../model/run_model';
import type {PanelContext} from '../../panel_api';
import {kColourBy, type ColourBy, type Flag, type Kind, type Layers} from './layers';
import {notYoursText} from '../../model/withheld';
import {renderNote, withheldStyles} from '../withheld';
import {rampColour} from './ramp';
import {renderChoice, renderFlag} from './menu_fields';

/** With the word for one, and that for several. */
const kKinds: readonly [Kind, string, string][] = [
  ['real', 'real', 'real'],
  ['simulated', 'simulated', 'simulated'],
  ['virtual', 'virtual', 'virtual'],
  ['landmark', 'tube', 'tubes'],
  ['wall', 'wall', 'walls'],
];
const kRampSteps = 8;
/** How strong a map lies over the world at first. */
const kMapOpacity = 0.6;

/** The layers after a click on a kind: hidden or shown, or with Alt shown alone. */
export function withKind(layers: Layers, kind: Kind, alone: boolean): Layers {
  const {hidden} = layers;
  const others = kKinds.map(([other]) => other).filter((other) => other !== kind);
  if (alone)
    return {
      ...layers,
      hidden: hidden.length === others.length && !hidden.includes(kind) ? [] : others,
    };
  return {
    ...layers,
    hidden: hidden.includes(kind) ? hidden.filter((other) => other !== kind) : [...hidden, kind],
  };
}

function countKinds(context: PanelContext): Map<Kind, number> {
  const counts = new Map<Kind, number>();
  const add = (kind: Kind) => counts.set(kind, (counts.get(kind) ?? 0) + 1);
  for (const robot of context.model.robots) add(robot.kind);
  for (const body of context.model.bodies.values()) add(body.kind);
  return counts;
}

/** Kinds with their numbers; a click hides one. */
export function renderLegend(
  context: PanelContext,
  layers: Layers,
  set: (layers: Layers) => void,
  explain: () => void,
): TemplateResult {
  const {model} = context;
  const counts = countKinds(context);
  return html`<div
    class="legend"
    role="group"
    aria-label="Kinds; press to hide, with Alt to show alone">
    ${kKinds.map(([kind, one, several]) => {
      const count = counts.get(kind);
      const word = count === 1 ? one : several;
      if (count === undefined) {
        if (kind !== 'virtual' || !model.hidden.includes('virtual')) return nothing;
        return html`<button
          class="kind lacking"
          title=${model.whyNot('obstacles')}
          @click=${explain}>
          ${icon('lock', 13)} <i>virtual obstacles</i>
        </button>`;
      }
      return html`<button
        class="kind"
        aria-pressed=${!layers.hidden.includes(kind)}
        title="Hide or show ${several}"
        aria-label="${count} ${word}"
        @click=${(event: MouseEvent) => set(withKind(layers, kind, event.altKey))}>
        <span class="glyph ${kind}"></span><b>${count}</b> <i>${word}</i>
      </button>`;
    })}
  </div>`;
}

/** How simulated robots are tinted, at hand without the menu. */
export function renderColourBy(layers: Layers, set: (layers: Layers) => void): TemplateResult {
  return html`<span class="colour-by"
    >Colour by
    <div class="segments" role="radiogroup" aria-label="Colour by">
      ${kColourBy.map(
        (by) =>
          html` <button
            role="radio"
            aria-checked=${layers.colourBy === by}
            @click=${() => set({...layers, colourBy: by})}>
            ${by}
          </button>`,
      )}
    </div></span
  >`;
}

/** What is shown over the floor. */
export function renderMenu(
  context: PanelContext,
  layers: Layers,
  scale: [string, string],
  theme: 'dark' | 'light',
  set: (layers: Layers) => void,
): TemplateResult {
  const {model} = context;
  const flag = (name: Flag, text: string, note = '') =>
    renderFlag(text, note, layers[name], () => set({...layers, [name]: !layers[name]}));
  const choice = <T extends string>(
    text: string,
    value: T,
    values: readonly (readonly [T, string])[],
    take: (value: T) => Layers,
  ) => renderChoice(text, value, values, (to) => set(take(to)));
  return html`<div class="menu" role="group" aria-label="Layers">
    <header>Layers <em>saved with the layout</em></header>
    ${model.may('true_pose')
      ? choice(
          'Poses',
          layers.poses,
          [
            ['reported', 'reported'],
            ['both', 'reported and true'],
            ['true', 'true'],
          ],
          (poses) => ({...layers, poses}),
        )
      : nothing}
    ${flag('trails', 'Trails', '10 s')}
    ${choice(
      'Scans',
      layers.scans,
      [
        ['off', 'off'],
        ['selected', 'selected'],
        ['real', 'selected and real'],
      ],
      (scans) => ({...layers, scans}),
    )}
    ${flag('sightings', 'Camera sightings')} ${flag('hits', 'Where readings hit')}
    ${flag('uncertainty', 'Uncertainty of reported poses')}
    ${flag('shadows', 'Shadows of real robots')}
    <hr />
    ${choice(
      'Colour by',
      layers.colourBy,
      kColourBy.map((by) => [by, by] as const),
      (colourBy: ColourBy) => ({...layers, colourBy}),
    )}
    ${layers.colourBy === 'kind' ? nothing : renderScale(scale, theme)}
    ${flag('density', 'Density of crowds', 'far')} ${flag('minimap', 'Small map', 'far')}
    <hr />
    ${flag('names', 'Names')} ${flag('grid', 'Grid')} ${renderMaps(model)} ${renderLacking(context)}
  </div>`;
}

/** What the world is drawn without for this person. */
function renderLacking(context: PanelContext): TemplateResult | typeof nothing {
  const {model} = context;
  const lacking = (['obstacles', 'true_pose', 'readings', 'maps'] as const).filter((power) =>
    model.isWithheld(power),
  );
  return lacking.length === 0
    ? nothing
    : html`<hr />
        ${lacking.map((power, i) =>
          i === lacking.length - 1
            ? renderNote(context, model.whyNot(power))
            : renderNote(context, notYoursText(power), false),
        )}`;
}

/** Which map lies over the world, and how strong. */
function renderMaps(model: RunModel): TemplateResult | typeof nothing {
  const {maps} = model;
  if (!model.may('maps') || maps.names.length === 0) return nothing;
  const {overlay} = maps;
  const show = (index: number) => {
    const name = maps.names[index];
    maps.show(
      name === undefined ? null : {key: keyOf(name), opacity: overlay?.opacity ?? kMapOpacity},
    );
  };
  return html`<hr />
    <label
      ><span>Map</span
      ><select
        aria-label="Map over the world"
        @change=${(event: Event) => show(Number((event.target as HTMLSelectElement).value))}>
        <option value="-1" ?selected=${overlay === null}>none</option>
        ${maps.names.map(
          (name, i) =>
            html`<option value=${i} ?selected=${overlay?.key === keyOf(name)}>
              ${name.name}
            </option>`,
        )}
      </select></label
    >
    ${overlay === null
      ? nothing
      : html`<label
          ><span>Opacity</span><em>${Math.round(100 * overlay.opacity)} %</em>
          <input
            type="range"
            min="10"
            max="100"
            step="5"
            aria-label="Opacity of the map"
            .value=${String(Math.round(100 * overlay.opacity))}
            @input=${(event: Event) =>
              maps.show({
                ...overlay,
                opacity: Number((event.target as HTMLInputElement).value) / 100,
              })}
        /></label>`}`;
}

function renderScale([low, high]: [string, string], theme: 'dark' | 'light'): TemplateResult {
  return html`<div class="ramp">
    <em>${low}</em>${Array.from(
      {length: kRampSteps},
      (_, i) => html`<i style="background:${rampColour(i / (kRampSteps - 1), theme)}"></i>`,
    )}<em>${high}</em>
  </div>`;
}

export const worldMenuStyles = css`
  ${withheldStyles}
  .legend {
    display: flex;
    gap: 4px;
    overflow: hidden;
  }
  .kind {
    display: inline-flex;
    align-items: center;
    gap: 6px;
    height: 26px;
    padding: 0 8px;
    border-radius: var(--r-2);
    color: var(--text-2);
    font-size: var(--fs-12);
    white-space: nowrap;
  }
  .kind b {
    color: var(--text-1);
    font-weight: var(--fw-strong);
  }
  .kind i {
    font-style: normal;
  }
  .kind:hover {
    background: var(--bg-3);
  }
  .kind[aria-pressed='false'] {
    text-decoration: line-through;
    color: var(--text-3);
  }
  .kind[aria-pressed='false'] b {
    color: var(--text-3);
  }
  .kind[aria-pressed='false'] .glyph {
    opacity: 0.4;
  }
  .lacking {
    color: var(--text-3);
  }
  .menu .withheld {
    margin: 6px 0;
    font-size: var(--fs-11);
  }
  .menu {
    position: absolute;
    right: 10px;
    top: 10px;
    z-index: 4;
    width: 260px;
    padding: 8px 14px;
    max-height: calc(100% - 20px);
    overflow: auto;
    box-sizing: border-box;
    background: var(--bg-2);
    border: 1px solid var(--line-2);
    border-radius: var(--r-4);
    box-shadow: var(--shadow-pop);
    font-size: var(--fs-12);
  }
  .menu header {
    display: flex;
    justify-content: space-between;
    padding: 4px 0 6px;
    font-weight: var(--fw-medium);
    color: var(--text-2);
  }
  .menu label {
    display: flex;
    align-items: center;
    gap: 8px;
    min-height: 28px;
    cursor: pointer;
  }
  .menu label span {
    flex: 1;
  }
  .menu hr {
    border: 0;
    border-top: 1px solid var(--line-1);
    margin: 5px -14px;
  }
  .menu em,
  .ramp em {
    font-style: normal;
    font-weight: 400;
    color: var(--text-3);
    font-size: var(--fs-11);
  }
  .menu input[type='range'] {
    width: 96px;
    accent-color: var(--intent-fill);
  }
  .menu input[type='checkbox'] {
    appearance: none;
    width: 26px;
    height: 15px;
    border-radius: 99px;
    border: 1px solid var(--line-3);
    position: relative;
    margin: 0;
    cursor: pointer;
  }
  .menu input[type='checkbox']::after {
    content: '';
    position: absolute;
    left: 2px;
    top: 2px;
    width: 9px;
    height: 9px;
    border-radius: 50%;
    background: var(--line-3);
  }
  .menu input[type='checkbox']:checked {
    background: var(--intent-fill);
    border-color: var(--intent-fill);
  }
  .menu input[type='checkbox']:checked::after {
    left: 13px;
    background: #fff;
  }
  .menu select {
    font: inherit;
    color: var(--text-1);
    background: var(--bg-3);
    border: 1px solid var(--line-2);
    border-radius: var(--r-2);
    height: 22px;
  }
  .ramp {
    display: flex;
    align-items: center;
    justify-content: flex-end;
    gap: 1px;
    padding: 2px 0 6px;
  }
  .ramp i {
    width: 16px;
    height: 8px;
  }
  .ramp em {
    padding: 0 6px;
  }
`;
