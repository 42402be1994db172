// SPDX-License-Identifier: Apache-2.0
import {Color, DoubleSide, ShaderMaterial} from 'three';

const kStep_px = 7;
const kWidth_px = 1.1;

/** Lines at 45 degrees in pixels of the screen, over a faint fill: virtual, from any distance. */
export function hatchMaterial(colour: string, light: boolean): ShaderMaterial {
  return new ShaderMaterial({
    transparent: true,
    depthWrite: false,
    side: DoubleSide,
    uniforms: {
      colour: {value: new Color(colour)},
      step_px: {value: 1},
      width_px: {value: 1},
      fill: {value: light ? 0.12 : 0.09},
      line: {value: 0.55},
    },
    vertexShader:
      'void main() { gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }',
    fragmentShader: `uniform vec3 colour; uniform float step_px; uniform float width_px;
      uniform float fill; uniform float line;
      void main() {
        float along = mod(gl_FragCoord.x - gl_FragCoord.y, step_px);
        float away = abs(along - 0.5 * step_px) * 2.0;
        float ink = 1.0 - smoothstep(width_px - 0.7, width_px + 0.7, away);
        gl_FragColor = vec4(colour, mix(fill, line, ink));
      }`,
  });
}

/** Gives the hatch its width for the given number of pixels of the picture to one of the screen. */
export function scaleHatch(material: ShaderMaterial, ratio: number): void {
  material.uniforms['step_px'].value = kStep_px * Math.SQRT2 * ratio;
  material.uniforms['width_px'].value = kWidth_px * Math.SQRT2 * ratio;
}
