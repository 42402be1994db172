// SPDX-License-Identifier: Apache-2.0
// What goes over the direct line to a host, and how a page gets the ticket for it;
// docs/explanation/gui-protocol.md describes both.

/** What a person does with a car, as shares; steering is positive to the left. */
export interface LinePedals {
  steering: number;
  throttle: number;
  brake: number;
  gear: -1 | 0 | 1;
}

/** What is asked of a robot. Without a robot: of all that the ticket covers (stop, release,
 * cancel). */
export interface LineOrder extends Partial<LinePedals> {
  kind:
    | 'drive'
    | 'goal'
    | 'path'
    | 'cancel'
    | 'text'
    | 'place'
    | 'take'
    | 'give'
    | 'stop'
    | 'release';
  robot?: string;
  v?: number;
  w?: number;
  vy?: number;
  points?: [number, number][];
  yaw?: number;
  speed?: number;
  text?: string;
  force?: boolean;
  to?: string;
  /** A drive that was accepted is answered, too. */
  echo?: boolean;
}

/** What came of it. */
export interface LineAnswer {
  good: boolean;
  text: string;
}

/** What a host says. */
export type HostMessage =
  | {type: 'challenge'; host: string; challenge: string}
  | {type: 'welcome'; host: string; user: string; until: number}
  | {type: 'renewed'; until: number}
  | ({type: 'answer'; id?: number} & LineAnswer)
  | {type: 'state'; leases: Record<string, string>; stopped: string[]}
  | {type: 'pong'; id: number};

/** The way to one host. */
export interface LineTicket {
  host: string;
  url: string;
  ticket: string;
  /** Seconds since 1970. */
  expires: number;
  /** Those that this page may order about or stop. */
  robots: string[];
}

/** The answer to `POST /ticket`. */
export interface Tickets {
  /** Orders may go through the server where there is no line. */
  relay: boolean;
  lines: LineTicket[];
}

export const kLineProtocol = 'rave.line.1';

/** The text that shows a host that the page has the key of its ticket. */
export function proofText(challenge: string, address: string, ticket: string): string {
  return `rave line proof 1\n${challenge}\n${address}\n${ticket}\n`;
}

export function base64url(bytes: ArrayBuffer): string {
  const text = btoa(String.fromCharCode(...new Uint8Array(bytes)));
  return text.replaceAll('+', '-').replaceAll('/', '_').replaceAll('=', '');
}
