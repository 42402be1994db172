// SPDX-License-Identifier: Apache-2.0
// What the first load of the page takes from the network.
import {readFileSync} from 'node:fs';
import {join} from 'node:path';
import {gzipSync} from 'node:zlib';

/** Paths of all files that a page asks for from now on. */
export function watchLoads(page) {
  const loaded = new Set();
  page.on(
    'request',
    (request) => /^https?:/.test(request.url()) && loaded.add(new URL(request.url()).pathname),
  );
  return loaded;
}

/** Bytes of these files as the GUI Server sends them. Fonts are compressed already. */
export function sizeOf(loaded, built) {
  const size = (path) => {
    const bytes = readFileSync(join(built, path === '/' ? 'index.html' : path));
    return /\.woff2$/.test(path) ? bytes.length : gzipSync(bytes).length;
  };
  return [...loaded]
    .filter((path) => path !== '/ws' && path !== '/ticket')
    .reduce((sum, path) => sum + size(path), 0);
}
