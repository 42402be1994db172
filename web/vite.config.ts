// SPDX-License-Identifier: Apache-2.0
import {defineConfig} from 'vitest/config';

export default defineConfig({
  base: './',
  build: {
    target: 'es2022',
    outDir: 'dist',
    assetsInlineLimit: 0,
    // The 3-D renderer is loaded on demand.
    chunkSizeWarningLimit: 800,
  },
  server: {proxy: {'/ws': {target: 'ws://127.0.0.1:8080', ws: true}}},
  test: {environment: 'happy-dom', include: ['**/*.test.ts']},
});
