// SPDX-License-Identifier: Apache-2.0
import {html, nothing, type TemplateResult} from 'lit';
import {icon, type IconName} from '../../ui/icons';
import type {RunModel} from '../../model/run_model';
import type {PanelContext} from '../../panel_api';

export type Mode = 'top' | '3d';

/** From above or in perspective. */
export function renderModes(mode: Mode, set: (mode: Mode) => void): TemplateResult {
  return html`<div class="segments" role="radiogroup" aria-label="View">
    ${(['top', '3d'] as const).map(
      (other) =>
        html`<button
          role="radio"
          aria-checked=${mode === other}
          title="Top or 3-D (T)"
          @click=${() => set(other)}>
          ${other === 'top' ? 'Top' : '3-D'}
        </button>`,
    )}
  </div>`;
}

/** What the buttons of the picture act on: each as its key. */
export interface WorldTools {
  toggleMode(): void;
  fit(): void;
  toggleMeasure(): void;
  picture(): void;
}

export interface ToolState {
  mode: Mode;
  measuring: boolean;
  menuOpen: boolean;
  layers(): void;
}

export function renderTools(
  tools: WorldTools,
  {selection}: PanelContext,
  state: ToolState,
): TemplateResult {
  return html`<div class="tools">
    <button class="icon-button mode" aria-label="Top or 3-D" @click=${() => tools.toggleMode()}>
      ${state.mode === 'top' ? '3-D' : 'Top'}
    </button>
    ${button('maximize', 'Show everything (F)', null, () => tools.fit())}
    ${button(
      'crosshair',
      'Follow the selected robot (C)',
      selection.following,
      () => selection.follow(!selection.following),
      selection.primary === null,
    )}
    ${button('ruler', 'Measure (M)', state.measuring, () => tools.toggleMeasure())}
    ${button('layers', 'Layers', state.menuOpen, () => state.layers())}
    ${button('camera', 'Save a picture (P)', null, () => tools.picture())}
  </div>`;
}

/** Which robot the picture follows. */
export function renderFollowed(context: PanelContext): TemplateResult | typeof nothing {
  const {selection, model, palette} = context;
  const {primary} = selection;
  return selection.following && primary !== null
    ? html`<div class="note">
        ${icon('crosshair', 14)} following
        <b style="color:${palette.hue(primary).ink}">${model.robots[primary]?.name}</b>
        <span>Esc ends</span>
      </div>`
    : nothing;
}

/** The picture in words. */
export function worldSummary(model: RunModel): string {
  const counts = `${model.robots.length} robots, ${model.bodies.size} bodies`;
  const keys = 'Arrows move the picture, plus and minus zoom it.';
  return `World View: ${counts}. The panel Robots lists them. ${keys}`;
}

/** `title`: the label, and behind it the key in brackets. */
function button(
  name: IconName,
  title: string,
  pressed: boolean | null,
  act: () => void,
  disabled = false,
): TemplateResult {
  return html` <button
    class="icon-button ${name}"
    title=${title}
    aria-label=${title.replace(/ \(.*\)$/, '')}
    aria-pressed=${pressed ?? nothing}
    ?disabled=${disabled}
    @click=${act}>
    ${icon(name)}
  </button>`;
}
