// SPDX-License-Identifier: Apache-2.0
import type {Camera} from './camera';
import {kTailParts, type Swarm, type Tone} from './swarm';

/** Two arrowheads, one within the other, are cheaper than an outline of lines. */
const kVertices = 8;
const kTriangles = 4;
const kEdge_px = 1.1;
const kTail = 6 * kTailParts;

const kVertex = `#version 300 es
in vec2 place; in vec4 colour; uniform vec4 map; out vec4 tone;
void main() {
  tone = vec4(colour.rgb * colour.a, colour.a);
  gl_Position = vec4(place * map.xy + map.zw, 0.0, 1.0);
}`;
const kFragment = `#version 300 es
precision mediump float; in vec4 tone; out vec4 pixel; void main() { pixel = tone; }`;

/** Draws any number of robots as arrowheads from one vertex buffer with one call. */
export class SwarmGl implements Swarm {
  readonly canvas = document.createElement('canvas');
  private readonly gl: WebGL2RenderingContext | null;
  private readonly map: WebGLUniformLocation | null = null;
  private capacity = 0;
  private count = 0;
  /** Vertices of tails. */
  private tails = 0;
  private camera: Camera | null = null;
  private places = new Float32Array(0);
  private tones = new Uint8Array(0);
  private buffers: {places: WebGLBuffer; tones: WebGLBuffer; heads: WebGLBuffer} | null = null;

  constructor() {
    this.gl = this.canvas.getContext('webgl2', {
      antialias: true,
      alpha: true,
      preserveDrawingBuffer: false,
    });
    const gl = this.gl;
    if (gl === null) return;
    const program = linked(gl);
    gl.useProgram(program);
    this.map = gl.getUniformLocation(program, 'map');
    gl.enable(gl.BLEND);
    // Colours are multiplied by their alpha in the vertex shader, as the canvas expects them.
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
  }

  get empty(): boolean {
    return this.count === 0;
  }

  dispose(): void {
    // Browsers allow a few contexts only and free one late, so it is given back at once.
    this.gl?.getExtension('WEBGL_lose_context')?.loseContext();
  }

  begin(most: number, camera: Camera): void {
    this.camera = camera;
    this.count = 0;
    this.tails = 0;
    if (most <= this.capacity) return;
    // Some more than needed: a new robot then needs no new buffers.
    this.capacity = Math.ceil(most * 1.25);
    const vertices = this.capacity * (kVertices + kTail);
    this.places = new Float32Array(2 * vertices);
    this.tones = new Uint8Array(4 * vertices);
    this.reserve();
  }

  addTail(points: Float32Array, count: number, tone: Tone): void {
    for (let i = 0; i + 1 < count && i < kTailParts; ++i) {
      const [ax, ay, bx, by] = [
        points[2 * i],
        points[2 * i + 1],
        points[2 * i + 2],
        points[2 * i + 3],
      ];
      const length = Math.hypot(bx - ax, by - ay);
      // Shorter is not seen, and longer is a jump: a robot was placed, or a replay moved on.
      if (length < 0.5 || length > 400) continue;
      const [nx, ny] = [(-0.6 * (by - ay)) / length, (0.6 * (bx - ax)) / length];
      // Tails come behind all heads in the buffer, because they are drawn first and without
      // indices.
      const v = this.capacity * kVertices + this.tails;
      const [from, to] = [30 + (100 * i) / count, 30 + (100 * (i + 1)) / count];
      this.put(v, ax + nx, ay + ny, tone, from);
      this.put(v + 1, ax - nx, ay - ny, tone, from);
      this.put(v + 2, bx + nx, by + ny, tone, to);
      this.put(v + 3, bx + nx, by + ny, tone, to);
      this.put(v + 4, ax - nx, ay - ny, tone, from);
      this.put(v + 5, bx - nx, by - ny, tone, to);
      this.tails += 6;
    }
  }

  add(x: number, y: number, heading: number, r: number, edge: Tone, inside: Tone): void {
    const c = Math.cos(heading);
    const s = Math.sin(heading);
    const v = kVertices * this.count++;
    this.arrowhead(v, x, y, c, s, r, 0, edge);
    this.arrowhead(v + 4, x, y, c, s, r, Math.min(kEdge_px, r / 6), inside);
  }

  draw(): void {
    const {gl, buffers, camera} = this;
    if (gl === null || buffers === null || camera === null) return;
    const [w, h] = [
      Math.round(camera.width * devicePixelRatio),
      Math.round(camera.height * devicePixelRatio),
    ];
    if (this.canvas.width !== w || this.canvas.height !== h)
      [this.canvas.width, this.canvas.height] = [w, h];
    gl.viewport(0, 0, w, h);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT);
    gl.uniform4f(this.map, 2 / camera.width, -2 / camera.height, -1, 1);
    const from = this.capacity * kVertices;
    this.upload(gl, buffers, 0, this.count * kVertices);
    if (this.tails > 0) {
      this.upload(gl, buffers, from, this.tails);
      gl.drawArrays(gl.TRIANGLES, from, this.tails);
    }
    gl.drawElements(gl.TRIANGLES, this.count * kTriangles * 3, gl.UNSIGNED_INT, 0);
  }

  /** Its corners lie `inset` pixels within the edges of the whole one: the factors follow from its
   * angles. */
  private arrowhead(
    v: number,
    x: number,
    y: number,
    c: number,
    s: number,
    r: number,
    inset: number,
    tone: Tone,
  ): void {
    const tip = r - 2.94 * inset;
    const back = -0.8 * r + 2.12 * inset;
    const side = 0.65 * r - 1.83 * inset;
    const notch = -0.45 * r + 1.14 * inset;
    this.put(v, x + tip * c, y + tip * s, tone, 255);
    this.put(v + 1, x + back * c - side * s, y + back * s + side * c, tone, 255);
    this.put(v + 2, x + notch * c, y + notch * s, tone, 255);
    this.put(v + 3, x + back * c + side * s, y + back * s - side * c, tone, 255);
  }

  private put(v: number, x: number, y: number, tone: Tone, alpha: number): void {
    this.places[2 * v] = x;
    this.places[2 * v + 1] = y;
    this.tones[4 * v] = tone[0];
    this.tones[4 * v + 1] = tone[1];
    this.tones[4 * v + 2] = tone[2];
    this.tones[4 * v + 3] = alpha;
  }

  private upload(
    gl: WebGL2RenderingContext,
    buffers: {places: WebGLBuffer; tones: WebGLBuffer},
    from: number,
    vertices: number,
  ): void {
    gl.bindBuffer(gl.ARRAY_BUFFER, buffers.places);
    gl.bufferSubData(gl.ARRAY_BUFFER, 8 * from, this.places, 2 * from, 2 * vertices);
    gl.bindBuffer(gl.ARRAY_BUFFER, buffers.tones);
    gl.bufferSubData(gl.ARRAY_BUFFER, 4 * from, this.tones, 4 * from, 4 * vertices);
  }

  private reserve(): void {
    const {gl} = this;
    if (gl === null) return;
    this.buffers ??= {
      places: gl.createBuffer(),
      tones: gl.createBuffer(),
      heads: gl.createBuffer(),
    };
    const indices = new Uint32Array(this.capacity * kTriangles * 3);
    for (let i = 0, at = 0; i < this.capacity; ++i) {
      for (const v of [kVertices * i, kVertices * i + 4]) {
        indices.set([v, v + 1, v + 2, v, v + 2, v + 3], at);
        at += 6;
      }
    }
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, this.buffers.heads);
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, indices, gl.STATIC_DRAW);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.buffers.places);
    gl.bufferData(gl.ARRAY_BUFFER, this.places.byteLength, gl.DYNAMIC_DRAW);
    gl.enableVertexAttribArray(0);
    gl.vertexAttribPointer(0, 2, gl.FLOAT, false, 0, 0);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.buffers.tones);
    gl.bufferData(gl.ARRAY_BUFFER, this.tones.byteLength, gl.DYNAMIC_DRAW);
    gl.enableVertexAttribArray(1);
    gl.vertexAttribPointer(1, 4, gl.UNSIGNED_BYTE, true, 0, 0);
  }
}

function linked(gl: WebGL2RenderingContext): WebGLProgram {
  const program = gl.createProgram();
  for (const [type, source] of [
    [gl.VERTEX_SHADER, kVertex],
    [gl.FRAGMENT_SHADER, kFragment],
  ] as const) {
    const shader = gl.createShader(type);
    if (shader === null) continue;
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.bindAttribLocation(program, 0, 'place');
  gl.bindAttribLocation(program, 1, 'colour');
  gl.linkProgram(program);
  return program;
}
