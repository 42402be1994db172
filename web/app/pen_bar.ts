// SPDX-License-Identifier: Apache-2.0
import {css, html, type TemplateResult} from 'lit';
import type {PanelContext} from '../panel_api';
import type {WorldPanel} from '../panels/world/world_panel';
import {icon, type IconName} from './icons';
import './stop_button';

/** At the bottom of a small screen: three tools, the stick and STOP, large enough for a pen. */
export function renderPenBar(context: PanelContext, panel: string, world: WorldPanel | null, show: (id: string) => void): TemplateResult {
  const inWorld = panel === 'world';
  const tool = (name: 'select' | 'goal' | 'path', label: string, glyph: IconName) => html`
    <button aria-pressed=${inWorld && (world?.tool ?? 'select') === name} @click=${() => {
      if (!inWorld) show('world');
      world?.chooseTool(name);
    }}>${icon(glyph, 22)}${label}</button>`;
  return html`<div class="pen-bar" role="toolbar" aria-label="Tools">
    ${tool('select', 'Select', 'pointer')}${tool('goal', 'Goal', 'target')}${tool('path', 'Path', 'route')}
    <button aria-pressed=${panel === 'joystick'} @click=${() => show(panel === 'joystick' ? 'world' : 'joystick')}>${icon('joystick', 22)}Drive</button>
    <rave-stop pen .context=${context}></rave-stop></div>`;
}

export const penStyles = css`
  .pen-bar { display: flex; gap: 6px; flex: none; padding: 8px; background: var(--bg-1); border-top: 1px solid var(--line-2); }
  .pen-bar > button { display: flex; flex: 1; flex-direction: column; align-items: center; justify-content: center; gap: 5px; min-width: 0; height: 62px; border: 1px solid var(--line-3); border-radius: var(--r-4); background: var(--bg-2); color: var(--text-1); font-weight: var(--fw-medium); }
  .pen-bar > button[aria-pressed='true'] { background: var(--intent-fill); border-color: var(--intent-fill); color: #fff; }
  .pen-bar rave-stop { flex: none; }
`;
