// SPDX-License-Identifier: Apache-2.0
import type {RunModel} from '../../model/run_model';
import type {ConductedRun, DueEntry, KnownRecording} from '../../protocol/messages';

/** Whether a run that this server started is in progress. */
export function inProgress(run: ConductedRun | null | undefined): boolean {
  return run != null && run.state !== 'ended' && run.state !== 'failed';
}

/** The state of a run as one word. */
export function stateText(state: ConductedRun['state']): string {
  return {
    starting: 'Starts',
    running: 'In progress',
    ending: 'Ends',
    ended: 'Ended',
    failed: 'Failed',
  }[state];
}

export function verdictText(verdict: KnownRecording['verdict']): string {
  return {passed: 'passed', failed: 'failed', broke_off: 'broke off', none: 'no result'}[verdict];
}

/** How long a scenario runs; empty: unknown. */
export function lengthText(duration_s: number | null | undefined): string {
  if (duration_s === undefined) return '';
  if (duration_s === null) return 'no end';
  return duration_s >= 120 && duration_s % 60 === 0 ? `${duration_s / 60} min` : `${duration_s} s`;
}

/** `happened`, `refused`, or `waits`: what the log says of an entry of the scenario. */
export interface DueState {
  state: 'happened' | 'refused' | 'waits';
  /** Times of the run at which it happened. */
  times_s: number[];
}

/** What became of an entry, as far as the log tells. */
export function dueState(entry: DueEntry, model: RunModel): DueState {
  const names = [entry.name, entry.trigger.replace(/^(when|each time that) /, '')];
  const known = model.events.filter(
    ({kind, text}) =>
      kind === 'scenario' && names.some((name) => name !== '' && text.includes(name)),
  );
  if (known.length > 0)
    return {
      state: 'happened',
      times_s: known.flatMap(({t, until}) => (t === until ? [t] : [t, until])),
    };
  const at_s = entry.at_s;
  if (at_s === undefined) return {state: 'waits', times_s: []};
  const refused = model.events.some(
    ({kind, t}) => kind === 'change refused' && Math.abs(t - at_s) < 0.5,
  );
  if (refused) return {state: 'refused', times_s: [at_s]};
  const now_s = model.time?.now_s ?? 0;
  return now_s >= at_s ? {state: 'happened', times_s: [at_s]} : {state: 'waits', times_s: []};
}
