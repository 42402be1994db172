// SPDX-License-Identifier: Apache-2.0

let known: boolean | null = null;

/** Whether WebGL is drawn by a graphics card; otherwise the processor emulates it, and each pixel
 * costs. */
export function hasCard(): boolean {
  known ??= askForCard();
  return known;
}

function askForCard(): boolean {
  const gl = document.createElement('canvas').getContext('webgl2');
  if (gl === null) return false;
  const about = gl.getExtension('WEBGL_debug_renderer_info');
  const name = String(
    gl.getParameter(about === null ? gl.RENDERER : about.UNMASKED_RENDERER_WEBGL),
  );
  gl.getExtension('WEBGL_lose_context')?.loseContext();
  return !/swiftshader|llvmpipe|softpipe|software|basic render/i.test(name);
}
