// SPDX-License-Identifier: Apache-2.0
import type {Swarm} from './swarm';
import {SwarmGl} from './swarm_gl';
import {SwarmSprites} from './swarm_sprites';

/** With a graphics card one buffer of triangles; where there is none, or WebGL is emulated, sprites that
 * the processor copies: for 10 000 robots these take 4 ms, emulated triangles 60. */
export function makeSwarm(): Swarm {
  return hasCard() ? new SwarmGl() : new SwarmSprites();
}

function hasCard(): boolean {
  const gl = document.createElement('canvas').getContext('webgl2');
  if (gl === null) return false;
  const about = gl.getExtension('WEBGL_debug_renderer_info');
  const name = String(gl.getParameter(about === null ? gl.RENDERER : about.UNMASKED_RENDERER_WEBGL));
  gl.getExtension('WEBGL_lose_context')?.loseContext();
  return !/swiftshader|llvmpipe|softpipe|software|basic render/i.test(name);
}
