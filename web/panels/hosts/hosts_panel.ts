// SPDX-License-Identifier: Apache-2.0
import {LitElement, css, html, nothing, svg, type TemplateResult} from 'lit';
import {icon} from '../../app/icons';
import {controls} from '../../app/styles';
import type {PanelContext} from '../../panel_api';
import type {Host} from '../../protocol/messages';
import {Rates, shortTime} from './rates';

const kPlot = [40, 12] as const;

/** The processes of the run, in the columns and words of `rave top`. */
export class HostsPanel extends LitElement {
  declare context: PanelContext;
  private readonly rates = new Rates();
  private readonly ends: (() => void)[] = [];

  override connectedCallback(): void {
    super.connectedCallback();
    // The dock takes panels out while they are hidden: what came meanwhile is to be shown.
    this.requestUpdate();
    const {model} = this.context;
    this.rates.add(model.hosts);
    this.ends.push(
      model.hostsChanged.on(() => {
        this.rates.add(model.hosts);
        this.requestUpdate();
      }),
      model.runChanged.on(() => this.requestUpdate()),
    );
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    for (const end of this.ends.splice(0)) end();
  }

  override render(): TemplateResult {
    const {model} = this.context;
    if (model.hosts.length === 0) {
      return html`<p>${model.live ? 'This run is one process: it has no other hosts.' : 'A recording does not say how its hosts were.'}</p>`;
    }
    const late = model.hosts.filter((host) => host.state !== 'here');
    return html`<div class="scroll" tabindex="0" role="region" aria-label="Hosts"><table>
      <thead><tr><th>Host</th><th>State</th><th class="n">Real+sim</th><th class="n">Step</th><th class="n" colspan="2">Steps/s</th><th class="n">Delay</th><th class="n">CPU</th><th class="n">Lost</th></tr></thead>
      <tbody>${model.hosts.map((host) => this.renderRow(host))}</tbody></table></div>
      ${late.length === 0 ? nothing : html`<div class="waits">${icon('hourglass', 15)}<span>${lateText(late)}</span></div>`}`;
  }

  private renderRow(host: Host): TemplateResult {
    const state = host.state === 'late' && host.late_s !== undefined ? `late ${shortTime(host.late_s)}` : host.state;
    const robots = host.real + host.simulated > 0;
    return html`<tr tabindex=${robots ? '0' : nothing} title=${robots ? 'Select its robots' : ''} @click=${() => this.select(host)}
        @keydown=${(event: KeyboardEvent) => { if (event.key === 'Enter') this.select(host); }}>
      <td><b>${host.name}</b> <em>${host.machine}</em></td>
      <td><span class="state ${host.state}">${state}</span></td>
      <td class="n">${robots ? `${host.real}+${host.simulated}` : ''}</td>
      <td class="n">${host.step}</td>
      <td class="n">${Number(host.steps_per_s.toPrecision(3))}</td>
      <td class="plot"><svg width=${kPlot[0]} height=${kPlot[1]} class=${host.state} aria-hidden="true">${svg`<polyline points=${this.rates.points(host.name, ...kPlot)} />`}</svg></td>
      <td class="n">${host.delay_s === null ? '' : shortTime(host.delay_s)}</td>
      <td class="n">${host.cpu === null ? '' : `${Math.round(100 * host.cpu)} %`}</td>
      <td class="n ${host.lost > 0 ? 'care' : 'zero'}">${host.lost}</td></tr>`;
  }

  private select(host: Host): void {
    const {model, selection} = this.context;
    const slots = model.robots.flatMap((robot, slot) => (robot.host === host.name ? [slot] : []));
    if (slots.length > 0) selection.set(slots);
  }

  static override styles = [
    controls,
    css`
      :host { display: block; height: 100%; background: var(--bg-1); overflow: auto; font-size: var(--fs-12); }
      .scroll { overflow-x: auto; }
      table { border-collapse: collapse; width: 100%; white-space: nowrap; }
      th { position: sticky; top: 0; height: 30px; background: var(--bg-1); color: var(--text-3); font-weight: 400; font-size: var(--fs-11); text-align: left; }
      th, td { padding: 0 8px; border-bottom: 1px solid var(--line-1); }
      th:first-child, td:first-child { padding-left: 14px; }
      td { height: var(--h-row); }
      tbody tr[tabindex] { cursor: pointer; }
      tbody tr:hover { background: var(--bg-2); }
      .n { text-align: right; }
      .plot { padding: 0; }
      b { font-weight: var(--fw-strong); }
      em { font-style: normal; color: var(--text-3); }
      .state { padding: 1px 7px; border-radius: var(--r-2); }
      .state.here { background: var(--ok-soft); color: var(--ok); }
      .state.late { background: var(--warn-soft); color: var(--warn); }
      .state.gone { background: var(--danger-soft); color: var(--danger); }
      .zero { color: var(--text-3); } .care { color: var(--warn); font-weight: var(--fw-strong); }
      polyline { fill: none; stroke: var(--text-2); stroke-width: 1; }
      svg.late polyline, svg.gone polyline { stroke: var(--warn); }
      .waits { display: flex; align-items: center; gap: 10px; margin: 10px; padding: 8px 12px; border-radius: var(--r-3); background: var(--warn-soft); color: var(--warn); }
      .waits span { color: var(--text-1); }
      p { margin: 12px 14px; color: var(--text-3); }
    `,
  ];
}

function lateText(hosts: readonly Host[]): string {
  const names = hosts.map((host) => host.name).join(', ');
  if (hosts.every((host) => host.state === 'gone')) return `${names}: gone`;
  return `No answer from ${names}${hosts.length === 1 && hosts[0].late_s !== undefined ? ` for ${shortTime(hosts[0].late_s)}` : ''}`;
}

customElements.define('rave-hosts', HostsPanel);
