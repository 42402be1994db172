// SPDX-License-Identifier: Apache-2.0
import {CanvasTexture, NearestFilter} from 'three';

const kBands = 12;
const kHeight_px = 96;

/** The bands of a tube with a barcode: white and black by the bits of its number. */
export function stripes(code: number): CanvasTexture {
  const canvas = document.createElement('canvas');
  canvas.width = 2;
  canvas.height = kHeight_px;
  const ctx = canvas.getContext('2d');
  if (ctx !== null) {
    ctx.fillStyle = '#e9ecf1';
    ctx.fillRect(0, 0, 2, kHeight_px);
    ctx.fillStyle = '#15181e';
    const band = kHeight_px / kBands;
    for (let i = 1; i < kBands - 1; ++i) {
      const bit = (code >> ((i - 1) >> 1)) & 1;
      // Each digit takes two bands: black above white, or white above black.
      if ((bit === 1) === (i % 2 === 0)) ctx.fillRect(0, i * band, 2, band);
    }
  }
  const texture = new CanvasTexture(canvas);
  texture.magFilter = NearestFilter;
  return texture;
}
