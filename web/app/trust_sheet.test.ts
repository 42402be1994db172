// SPDX-License-Identifier: Apache-2.0
import {expect, it} from 'vitest';
import {Signal} from '../model/signal';
import type {PanelContext} from '../panel_api';
import type {TrustSheet} from './trust_sheet';
import './trust_sheet';

it('says what to do about each host that is not trusted, until all answer', async () => {
  const line = (host: string, state: string) => ({
    state,
    ticket: {host, url: `wss://${host}.lab:7001/ws`},
  });
  const lines = new Map([
    ['left', line('left', 'untrusted')],
    ['right', line('right', 'open')],
  ]);
  const changed = new Signal();
  const sheet = document.createElement('rave-trust') as TrustSheet;
  sheet.context = {link: {direct: {lines, changed}}} as unknown as PanelContext;
  document.body.append(sheet);
  await sheet.updateComplete;
  const links = () =>
    [...(sheet.shadowRoot?.querySelectorAll('a') ?? [])].map((a) => [a.textContent, a.href]);
  expect(links()).toEqual([['left', 'https://left.lab:7001/']]);
  const text = () => sheet.shadowRoot?.textContent ?? '';
  expect(text()).toContain('does not trust the certificate');
  expect(text()).toContain('authority.pem');
  lines.set('left', line('left', 'open'));
  changed.emit();
  await sheet.updateComplete;
  expect(links()).toEqual([]);
  expect(text()).toContain('All hosts answer now.');
  sheet.remove();
});
