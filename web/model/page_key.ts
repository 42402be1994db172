// SPDX-License-Identifier: Apache-2.0
import {base64url} from '../protocol/line';

const kKind = {name: 'ECDSA', namedCurve: 'P-256'} as const;

/** The key of this page. Its private half never leaves the browser, nor can the page read it. */
export class PageKey {
  private constructor(
    private readonly pair: CryptoKeyPair,
    /** As tickets have it. */
    readonly point: string,
  ) {}

  /** Fails where there is no WebCrypto: on a page that came over plain HTTP from another
   * machine. */
  static async make(): Promise<PageKey> {
    const pair = await crypto.subtle.generateKey(kKind, false, ['sign']);
    return new PageKey(pair, base64url(await crypto.subtle.exportKey('raw', pair.publicKey)));
  }

  async sign(text: string): Promise<string> {
    const bytes = new TextEncoder().encode(text);
    return base64url(
      await crypto.subtle.sign({name: 'ECDSA', hash: 'SHA-256'}, this.pair.privateKey, bytes),
    );
  }
}
