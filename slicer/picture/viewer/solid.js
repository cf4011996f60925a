// The part as a solid, whole or up to the layer in hand, on WebGL. Layers are
// drawn as the plates that they are, but lit by the slope from layer to layer, so
// that steps do not show.
//
// The work grows with the corners alone: each has two distances looked up, to
// the layers some way below and above, for the slope; and of a layer's bottom
// and top only what the next layer leaves free is made at all, by one sweep over
// the edges of both. A large part is drawn from few layers at first.
//
// Supports are a body of their own, whose tips the part hides: to show or hide
// them makes nothing anew.
//
// Another part is made while the one before is shown, and then takes its place.

const kFirst = {finest: 1 / 1000, corners: 12000};  // the finest bends, of the
const kFull = {finest: 1 / 4000, corners: 150000};  // part's size; and of all layers
const kSamples = 24;          // layers from which corners are estimated
const kSlopeLength = .0018;   // of the part's size: slopes are taken over this
const kSlopeReach = 20;       // such lengths: tops that are level so far are level
const kSmoothCosine = .8;     // of the angle between edges that make a curve
const kPieces = 40;           // across the part: longer edges are divided
const kNarrowest = 1e-5;      // of the part's size: what is narrower is not seen
const kQuad = [0, 1, 2, 0, 2, 3];  // corners of its two triangles
const kPatience = 8;          // of the page, while the solid is made [ms]
const kWaitFirst = 16;        // at most, for the page to be idle: for the first solid
const kWaitFull = 100;        // of a part, and for the full one [ms]
const kSlowDraw = 25;         // of a browser without a graphics card [ms]
const kRest = 300;            // there, what is shown must be the same for so long [ms]
const kLook = 4;              // until the next look whether it is drawn [ms]

// How deep places lie in a layer, as far as `reach`; less than 0 outside. Edges
// near a place are looked at in rings of cells, until no nearer one can come.
class Depths extends EdgeGrid {
  constructor(contours, reach) {
    super(contours, (width, height, count) => Math.min(reach / 4,
        Math.max(reach / 16, Math.sqrt(width * height / count) || 0)));
    this.reach = reach;
    this.findInside();
  }

  // The winding around the middle of each cell.
  findInside() {
    const {edges, cell, columns} = this;
    this.windings = new Int16Array(this.rows * columns);
    for (let i = 0; i < edges.length; i += 4) {
      const ax = (edges[i] - this.left) / cell;
      const ay = (edges[i + 1] - this.low) / cell;
      const by = (edges[i + 3] - this.low) / cell;
      const run = ((edges[i + 2] - this.left) / cell - ax) / (by - ay);
      const end = Math.ceil(Math.max(ay, by) - .5);
      for (let row = Math.ceil(Math.min(ay, by) - .5); row < end; ++row) {
        const column = Math.ceil(ax + run * (row + .5 - ay) - .5);
        if (column < columns) this.windings[row * columns + column] += by > ay ? -1 : 1;
      }
    }
    for (let i = 0; i < this.windings.length; ++i) {
      if (i % columns) this.windings[i] += this.windings[i - 1];
    }
  }

  at(x, y) {
    const {cell, columns, rows} = this;
    if (rows === 0) return -this.reach;
    const column = Math.floor((x - this.left) / cell);
    const row = Math.floor((y - this.low) / cell);
    const isInside = column >= 0 && column < columns && row >= 0 && row < rows &&
      this.windings[row * columns + column] !== 0;
    this.nearest = this.reach ** 2;
    this.side = isInside ? 1 : -1;
    const margin = Math.min(x - this.left - column * cell, y - this.low - row * cell,
        this.left + (column + 1) * cell - x, this.low + (row + 1) * cell - y);
    for (let ring = 0; ; ++ring) {
      const last = Math.min(rows - 1, row + ring);
      for (let r = Math.max(0, row - ring); r <= last; ++r) {
        const isEnd = r === row - ring || r === row + ring;
        const step = isEnd ? 1 : Math.max(1, 2 * ring);
        for (let c = column - ring; c <= column + ring; c += step) {
          if (c >= 0 && c < columns) this.look(r * columns + c, x, y);
        }
      }
      if ((ring * cell + margin) ** 2 >= this.nearest) break;
    }
    return Math.sqrt(this.nearest) * (this.side < 0 ? -1 : 1);
  }

  // Keeps the nearest edge of a cell. Of two that meet in the nearest corner, the
  // one that the place is farther beside tells the side.
  look(cell, x, y) {
    const {edges, listed} = this;
    const end = this.begins[cell + 1];
    for (let i = this.begins[cell]; i < end; ++i) {
      const edge = listed[i];
      const px = x - edges[edge];
      const py = y - edges[edge + 1];
      const dx = edges[edge + 2] - edges[edge];
      const dy = edges[edge + 3] - edges[edge + 1];
      const square = dx * dx + dy * dy;
      if (square === 0) continue;
      const t = Math.min(1, Math.max(0, (px * dx + py * dy) / square));
      const away = (px - t * dx) ** 2 + (py - t * dy) ** 2;
      if (away > this.nearest * (1 + 1e-9)) continue;
      const side = (dx * py - dy * px) / Math.sqrt(square);
      if (away > this.nearest * (1 - 1e-9) && Math.abs(side) <= Math.abs(this.side)) continue;
      this.nearest = Math.min(this.nearest, away);
      this.side = side;
    }
  }
}

// Calls visit(left, right, bottom, top) for trapezoids that cover what only one
// of two layers has, if it is no narrower than `least`. Edges are {x, y, x1, y1,
// winding, …} with y < y1.
function sweep(below, above, least, visit) {
  for (const edge of below) edge.layer = 0;
  for (const edge of above) edge.layer = 1;
  const edges = [...below, ...above].filter(({winding}) => winding)
      .sort((a, b) => a.y - b.y);
  const heights = new Float64Array(2 * edges.length);
  edges.forEach((edge, i) => {
    edge.strip = null;
    heights[2 * i] = edge.y;
    heights[2 * i + 1] = edge.y1;
  });
  heights.sort();
  const active = [];
  let strips = [];
  let next = 0;
  const close = (height) => {
    for (const strip of strips) {
      if (strip.top < height) visit(strip.left, strip.right, strip.bottom, strip.top);
    }
  };
  for (let i = 0; i + 1 < heights.length; ++i) {
    const bottom = heights[i];
    const top = heights[i + 1];
    if (top === bottom) continue;
    // Take the edges of this height, in order.
    let count = 0;
    for (const edge of active) if (edge.y1 > bottom) active[count++] = edge;
    active.length = count;
    while (next < edges.length && edges[next].y <= bottom) active.push(edges[next++]);
    const middle = (bottom + top) / 2;
    for (let k = 0; k < active.length; ++k) {
      const edge = active[k];
      edge.at = edge.x + (edge.x1 - edge.x) * (middle - edge.y) / (edge.y1 - edge.y);
      let place = k;
      for (; place > 0 && active[place - 1].at > edge.at; --place) {
        active[place] = active[place - 1];
      }
      active[place] = edge;
    }
    // Go on with strips between the same edges, and begin others.
    const fresh = [];
    const windings = [0, 0];
    let left = null;
    for (const edge of active) {
      windings[edge.layer] += edge.winding;
      const isSeen = (windings[0] === 0) !== (windings[1] === 0);
      if (isSeen === (left !== null)) continue;
      if (isSeen) {
        left = edge;
        continue;
      }
      if (edge.at - left.at >= least) {
        if (!left.strip || left.strip.right !== edge || left.strip.top !== bottom) {
          left.strip = {left, right: edge, bottom, top};
        }
        left.strip.top = top;
        fresh.push(left.strip);
      }
      left = null;
    }
    close(top);
    strips = fresh;
  }
  close(Infinity);
}

// A loop with no edge longer than `longest`.
function divideEdges(loop, longest) {
  const points = [];
  const edges = edgesOf([loop]);
  for (let i = 0; i < edges.length; i += 4) {
    const [ax, ay, bx, by] = edges.subarray(i, i + 4);
    const count = Math.ceil(Math.hypot(bx - ax, by - ay) / longest);
    for (let k = 0; k < count; ++k) {
      points.push(ax + (bx - ax) * k / count, ay + (by - ay) * k / count);
    }
  }
  return points;
}

// A loop without the corners that are nearer than `finest` to the line past them
// (Douglas and Peucker).
function simplify(loop, finest) {
  const count = loop.length / 2;
  const isKept = new Uint8Array(count);
  let away = 0;
  const farthest = (from, to) => {
    const ax = loop[2 * from];
    const ay = loop[2 * from + 1];
    const bx = loop[2 * (to % count)] - ax;
    const by = loop[2 * (to % count) + 1] - ay;
    const length = Math.hypot(bx, by);
    let best = from;
    away = 0;
    for (let i = from + 1; i < to; ++i) {
      const x = loop[2 * i] - ax;
      const y = loop[2 * i + 1] - ay;
      const ofThis = length > 0 ? Math.abs(x * by - y * bx) / length : Math.hypot(x, y);
      if (ofThis > away) [away, best] = [ofThis, i];
    }
    return best;
  };
  isKept[0] = 1;
  const opposite = farthest(0, count);
  const spans = opposite > 0 ? [[0, opposite], [opposite, count]] : [];
  while (spans.length) {
    const [from, to] = spans.pop();
    isKept[from] = 1;
    const middle = farthest(from, to);
    if (away > finest) spans.push([from, middle], [middle, to]);
  }
  return loop.filter((_, i) => isKept[i >> 1]);
}

// The corners of quads: place, and direction of the surface.
class Quads {
  constructor() {
    this.values = new Float32Array(24 << 12);
    this.end = 0;
  }

  get count() {
    return this.end / 24;
  }

  add(x, y, z, nx, ny, nz) {
    if (this.end === this.values.length) {
      const values = new Float32Array(2 * this.end);
      values.set(this.values);
      this.values = values;
    }
    const {values, end} = this;
    values[end] = x;
    values[end + 1] = y;
    values[end + 2] = z;
    values[end + 3] = nx;
    values[end + 4] = ny;
    values[end + 5] = nz;
    this.end = end + 6;
  }

  // A trapezoid between two edges, lit as they are, or from above.
  addLevel(left, right, y0, y1, z, isSection) {
    const addAt = (edge, y) => {
      const t = (y - edge.y) / (edge.y1 - edge.y);
      const between = (a, b) => a + t * (b - a);
      const {n, n1} = edge;
      this.add(between(edge.x, edge.x1), y, z, ...isSection ? [0, 0, 1] :
        [between(n[0], n1[0]), between(n[1], n1[1]), between(n[2], n1[2])]);
    };
    addAt(left, y0);
    addAt(right, y0);
    addAt(right, y1);
    addAt(left, y1);
  }
}

// All plates, ordered by layer: what is seen of its bottom and of the top of the
// layer below, then its sides.
class PlateMesh {
  constructor({layers, size}, {finest, corners}) {
    const length = Math.hypot(...size);
    this.finest = finest * length;
    this.narrowest = kNarrowest * length;
    this.piece = Math.max(...size) / kPieces;
    this.base = layers[0].bottom;
    this.top = size[2];
    const samples = layers.filter((_, i) => i % Math.ceil(layers.length / kSamples) === 0);
    this.corners = layers.length / samples.length * samples.reduce((sum, layer) =>
      sum + this.loopsOf(layer).reduce((ofLayer, loop) => ofLayer + loop.length / 2, 0), 0);
    this.stride = Math.ceil(this.corners / corners) || 1;
    this.layers = layers.filter((_, i) => i % this.stride === 0);
    this.thickness = size[2] / this.layers.length || 1;
    const slope = Math.max(this.thickness, kSlopeLength * length);
    this.half = Math.max(1, Math.round(slope / this.thickness / 2));
    this.reach = kSlopeReach * slope;
    this.depths = [];
    this.quads = new Quads();
    this.ends = [];  // of a layer: the quads of it and of those below
    this.edges = [];
  }

  // Makes it, layer by layer.
  *build() {
    for (let i = 0; i < this.layers.length; ++i) {
      this.add(i);
      delete this.depths[i - this.half - 1];
      yield;
    }
    this.addLevels([], this.top);
    this.depths = [];
  }

  // What is drawn of a layer's contours.
  loopsOf(layer) {
    return layer.contours.map((loop) => simplify(loop, this.finest))
        .filter((loop) => loop.length > 4).map((loop) => divideEdges(loop, this.piece));
  }

  // Of a layer's plate, or above all of them their top.
  bottomOf(i) {
    return i < this.layers.length ? this.layers[i].bottom - this.base : this.top;
  }

  // Of a layer; those beyond the stack are empty.
  depthsOf(i) {
    this.depths[i] ||= new Depths(i in this.layers ? this.layers[i].contours : [], this.reach);
    return this.depths[i];
  }

  add(i) {
    const [low, high] = [this.bottomOf(i), this.bottomOf(i + 1)];
    const edges = this.edgesAt(i);
    this.addLevels(edges, low);
    for (const {x, y, x1, y1, n, n1} of edges) {
      this.quads.add(x, y, low, ...n);
      this.quads.add(x1, y1, low, ...n1);
      this.quads.add(x1, y1, high, ...n1);
      this.quads.add(x, y, high, ...n);
    }
    this.ends.push(this.quads.count);
  }

  // Adds what only one of two layers has, at the height between them.
  addLevels(edges, z) {
    const below = this.edges;
    this.edges = edges;
    const isSame = (edge, i) =>
      ["x", "y", "x1", "y1", "winding"].every((name) => edge[name] === below[i][name]);
    if (edges.length === below.length && edges.every(isSame)) return;
    sweep(below, edges, this.narrowest, (left, right, y0, y1) =>
      this.quads.addLevel(left, right, y0, y1, z));
  }

  // The edges of a layer, with the surface's direction at their ends.
  edgesAt(i) {
    const [from, to] = [this.depthsOf(i - this.half), this.depthsOf(i + this.half)];
    const slopeAt = (x, y) =>
      (from.at(x, y) - to.at(x, y)) / (2 * this.half * this.thickness);
    return this.litEdges(this.layers[i], slopeAt);
  }

  litEdges(layer, slopeAt) {
    const edges = [];
    for (const loop of this.loopsOf(layer)) {
      const sides = edgesOf([loop]);
      const count = sides.length / 4;
      const outward = Array.from({length: count}, (_, k) => {
        const dx = sides[4 * k + 2] - sides[4 * k];
        const dy = sides[4 * k + 3] - sides[4 * k + 1];
        const length = Math.hypot(dx, dy) || 1;
        return [dy / length, -dx / length];
      });
      const slopes = outward.map((_, k) => slopeAt(sides[4 * k], sides[4 * k + 1]));
      // At a corner, the direction of the edge, or else that of the curve.
      const directionAt = (edge, corner) => {
        const [x, y] = outward[edge];
        const [ox, oy] = outward[corner === edge ? (edge || count) - 1 : corner];
        const length = x * ox + y * oy > kSmoothCosine ? Math.hypot(x + ox, y + oy) : 0;
        return length ? [(x + ox) / length, (y + oy) / length, slopes[corner]] :
          [x, y, slopes[corner]];
      };
      for (let k = 0; k < count; ++k) {
        const [ax, ay, bx, by] = sides.subarray(4 * k, 4 * k + 4);
        const [a, b] = [directionAt(k, k), directionAt(k, (k + 1) % count)];
        edges.push(ay <= by ?
          {x: ax, y: ay, x1: bx, y1: by, n: a, n1: b, winding: ay < by ? -1 : 0,
            layer: 0, at: 0, strip: null} :
          {x: bx, y: by, x1: ax, y1: ay, n: b, n1: a, winding: 1, layer: 0, at: 0, strip: null});
      }
    }
    return edges;
  }

  // The section at the top of a layer, which may be one that is left out, as quads.
  sectionOf(layer) {
    const quads = new Quads();
    const z = layer.top - this.base;
    sweep(this.litEdges(layer, () => 0), [], 0, (left, right, y0, y1) =>
      quads.addLevel(left, right, y0, y1, z, true));
    return quads;
  }
}

// Runs what yields between its steps while the page has nothing else to do, or has had
// enough to do for `longest` ms, as long as isWanted(). Returns whether all has run.
async function runInIdleTime(steps, longest, isWanted) {
  let end = 0;
  for (const _ of steps) {
    if (performance.now() < end) continue;
    await new Promise((resolve) => window.requestIdleCallback ?
      requestIdleCallback(resolve, {timeout: longest}) : setTimeout(resolve));
    if (!isWanted()) return false;
    end = performance.now() + kPatience;
  }
  return true;
}

const kVertexShader = `#version 300 es
in vec3 place;
in vec3 normal;
uniform mat3 turn;
uniform vec3 center;
uniform vec4 lens;  // distance, focal length, aspect, radius
uniform float dotSize;
out vec3 direction;
void main() {
  vec3 at = turn * (place - center);
  direction = turn * normalize(normal);
  float depth = lens.x - at.z;
  float near = max(lens.x - lens.w, .02 * lens.x);
  float far = lens.x + lens.w;
  gl_Position = vec4(lens.y * at.x / lens.z, lens.y * at.y,
      (depth * (far + near) - 2. * far * near) / (far - near), depth);
  gl_PointSize = dotSize;
}`;

// The studio of lamina's pictures (stack_picture.cpp).
const kFragmentShader = `#version 300 es
precision highp float;
in vec3 direction;
uniform vec3 solid;
uniform float shine;  // share of the light that is mirrored
out vec4 color;
const float s = .581, c = .8139;  // of the viewer's elevation
const vec3 key = vec3(-.5994, -.3384, .7251);
const vec3 fill = vec3(.8552, -.4528, .2515);
float lamp(vec3 to, vec3 axis, vec2 size) {
  vec3 across = normalize(cross(vec3(0, 0, 1), axis));
  vec2 p = vec2(dot(to, across), dot(to, cross(axis, across))) / max(dot(to, axis), .001);
  vec2 inside = 1. - smoothstep(size - .12, size + .12, abs(p));
  return inside.x * inside.y;
}
float room(vec3 to) {
  return .06 + .34 * smoothstep(-.08, .55, to.z) + .16 * smoothstep(.05, 1., -to.z) +
      1.05 * lamp(to, key, vec2(.62, .45)) + .7 * lamp(to, fill, vec2(.16, .7)) +
      .4 * lamp(to, vec3(-.9539, .2, .2236), vec2(.22, .9)) +
      .35 * smoothstep(.35, .9, to.y) * smoothstep(-.1, .3, to.z);
}
void main() {
  vec3 n = normalize(direction);
  if (n.z < 0.) n.z = -n.z;
  vec3 inRoom = vec3(n.x, s * n.y - c * n.z, c * n.y + s * n.z);
  vec3 viewer = vec3(0, -c, s);
  float facing = max(0., dot(inRoom, viewer));
  vec3 to = 2. * facing * inRoom - viewer;
  float diffuse = .75 * max(0., dot(inRoom, key)) +
      .15 * max(0., dot(inRoom, fill)) + .14 + .14 * inRoom.z;
  vec3 light = solid * diffuse * (1. - .7 * shine) +
      mix(solid, vec3(1), .7 * pow(1. - facing, 5.)) * room(to) * shine;
  light += .7 * max(0., max(light.r, max(light.g, light.b)) - .9);
  color = vec4(pow(light, vec3(1. / 2.2)), 1);
}`;

// One colour: the section, the layer's outline, and the marks, which are round.
const kFlatShader = `#version 300 es
precision highp float;
uniform vec4 flatColor;
uniform float dotSize;
out vec4 color;
void main() {
  color = flatColor;
  if (dotSize == 0.) return;
  float away = dotSize * length(gl_PointCoord - .5);
  if (away > .5 * dotSize) discard;
  if (away > .36 * dotSize) color.rgb = vec3(1);
}`;

const kGold = [.92, .58, .16];  // linear light
const kSupportDepth = 2;
const kPlainShine = .25;        // as in stack_picture.cpp
const kGamma = 2.2;             // of the shader's light
const kFocal = 4;               // focal length, of half the picture's height

// "#rrggbb" as numbers from 0 to 1.
function rgbOf(name) {
  const digits = parseInt(name.trim().slice(1), 16);
  return [digits >> 16 & 255, digits >> 8 & 255, digits & 255].map((value) => value / 255);
}

class Solid {
  constructor(canvas) {
    this.canvas = canvas;
    this.wanted = null;  // the part that is made or shown
    this.first = null;   // fulfilled when the first solid is made that now is
    this.drawTime = 0;   // that the last drawing took [ms]
    this.forget();
    this.reset();
  }

  // Begins anew where the browser has lost what was drawn.
  forget() {
    this.gl = null;
    this.part = null;  // the part that is shown, and what is drawn of it
    this.bodies = [];
    this.marks = null;
  }

  reset() {
    this.yaw = -.43;
    this.pitch = .6;
    this.zoomed = 1;
  }

  // Makes what is drawn of a part, a rough solid first where the full one takes
  // long, and calls draw() with each. Until the first is made, the part before is
  // shown; then it is finished, even where yet another part is waiting, so that a row
  // of parts is seen to change. Without a graphics card that would keep back the
  // layers: there only the last of a row is made. Returns false where another part came meanwhile, and
  // throws where there is no WebGL.
  async show(part, draw) {
    this.wanted = part;
    this.open();
    const isWanted = () => this.wanted === part;
    if (this.drawTime > kSlowDraw) await new Promise((resolve) => setTimeout(resolve, kRest));
    if (!isWanted()) return false;
    while (this.first) {
      await this.first.catch(() => {});
      if (!isWanted()) return false;
    }
    const bodies = this.bodiesOf(part);
    const full = bodies.map((body) => new PlateMesh(body, kFull));
    const corners = full.reduce((sum, mesh) => sum + mesh.corners, 0);
    const isLarge = corners > 2 * kFirst.corners;
    const first = isLarge ? bodies.map((body) => new PlateMesh(body, kFirst)) : full;
    this.first = this.build(first, kWaitFirst, () => true).finally(() => { this.first = null; });
    await this.first;
    this.take(part, bodies, first);
    draw();
    if (!isLarge) return isWanted();
    if (!isWanted() || !await this.build(full, kWaitFull, isWanted) || !isWanted()) return false;
    this.takeMeshes(full);
    draw();
    return true;
  }

  async build(meshes, longest, isWanted) {
    for (const mesh of meshes) {
      if (!await runInIdleTime(mesh.build(), longest, isWanted)) return false;
    }
    return true;
  }

  open() {
    if (this.gl) return;
    const gl = this.canvas.getContext("webgl2", {antialias: true, preserveDrawingBuffer: true});
    if (!gl) throw new Error(word("noSolid"));
    this.lit = this.program(gl, kFragmentShader);
    this.flat = this.program(gl, kFlatShader);
    this.outline = this.corners(gl);
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LEQUAL);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
    this.gl = gl;
  }

  // Notes how long it takes until what has been drawn is there.
  timeDraw() {
    const {gl} = this;
    const begin = performance.now();
    const fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    gl.flush();
    if (!fence) return;  // the browser has lost what was drawn
    const look = () => {
      if (gl.clientWaitSync(fence, 0, 0) === gl.TIMEOUT_EXPIRED) {
        setTimeout(look, kLook);
        return;
      }
      gl.deleteSync(fence);
      this.drawTime = performance.now() - begin;
    };
    setTimeout(look);
  }

  // Shows another part from now on, and frees what was made of the one before.
  take(part, bodies, meshes) {
    const {gl} = this;
    for (const body of this.bodies) [body.surface, body.section].forEach((old) => this.free(old));
    if (this.marks) this.free(this.marks);
    this.part = part;
    this.bodies = bodies;
    for (const body of bodies) {
      body.surface = this.corners(gl, true);
      body.section = this.corners(gl, true);
    }
    this.marks = this.corners(gl);
    this.fill(gl, this.marks, this.markPlaces());
    this.takeMeshes(meshes);
  }

  takeMeshes(meshes) {
    this.bodies.forEach((body, i) => {
      body.mesh = meshes[i];
      body.cut = null;
      this.fillQuads(this.gl, body.surface, body.mesh.quads);
    });
  }

  // The part, what of it has a color, and the supports if there are any: layers in
  // one colour, which is in linear light. Where several are at one place, that with
  // the least depth is seen.
  bodiesOf({partLayers, supports, colored, size}) {
    const bodyOf = (layers, depth, shine, color) => ({
      layers, size, depth, shine, color, mesh: null, cut: null, sectionQuads: null,
      surface: null, section: null,
    });
    const linear = (rgb) => rgbOf(rgb).map((value) => value ** kGamma);
    return [bodyOf(partLayers, 1, 1, () => kGold),
      ...colored.map((own) => bodyOf(own.layers, 0, kPlainShine, () => linear(own.color))),
      ...supports ?
        [bodyOf(supports.layers, kSupportDepth, kPlainShine, () => linear(color("support")))] : []];
  }

  program(gl, fragmentShader) {
    const program = gl.createProgram();
    for (const [kind, text] of [[gl.VERTEX_SHADER, kVertexShader],
      [gl.FRAGMENT_SHADER, fragmentShader]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
    }
    gl.bindAttribLocation(program, 0, "place");
    gl.bindAttribLocation(program, 1, "normal");
    gl.linkProgram(program);
    return program;
  }

  // A vertex array of places, and of directions where it is lit.
  corners(gl, isLit = false) {
    const corners = gl.createVertexArray();
    gl.bindVertexArray(corners);
    corners.buffer = gl.createBuffer();
    gl.bindBuffer(gl.ARRAY_BUFFER, corners.buffer);
    for (const at of isLit ? [0, 1] : [0]) {
      gl.vertexAttribPointer(at, 3, gl.FLOAT, false, isLit ? 24 : 12, 12 * at);
      gl.enableVertexAttribArray(at);
    }
    corners.indices = isLit ? gl.createBuffer() : null;
    if (isLit) gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, corners.indices);
    return corners;
  }

  free(corners) {
    const {gl} = this;
    gl.deleteBuffer(corners.buffer);
    gl.deleteBuffer(corners.indices);
    gl.deleteVertexArray(corners);
  }

  fill(gl, corners, data) {
    gl.bindVertexArray(corners);
    gl.bindBuffer(gl.ARRAY_BUFFER, corners.buffer);
    gl.bufferData(gl.ARRAY_BUFFER, data, gl.STATIC_DRAW);
  }

  fillQuads(gl, corners, quads) {
    this.fill(gl, corners, quads.values.subarray(0, quads.end));
    const indices = new Uint32Array(6 * quads.count);
    for (let i = 0; i < indices.length; ++i) indices[i] = 4 * Math.floor(i / 6) + kQuad[i % 6];
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, indices, gl.STATIC_DRAW);
  }

  markPlaces() {
    const {found, layers} = this.part;
    return new Float32Array((found ? found.places : []).flatMap(
        ({place, layer}) => [...place, layers[layer - 1].z - layers[0].bottom]));
  }

  turn(dx, dy) {
    this.yaw += dx * .008;
    this.pitch = Math.min(1.57, Math.max(-1.57, this.pitch + dy * .008));
  }

  // Brings a place to the side of the viewer, who looks from above: the cut at
  // its layer leaves nothing between. The whole solid is in the picture.
  //
  // size  of the part
  turnTo([x, y], [width, depth]) {
    this.yaw = -Math.PI / 2 - Math.atan2(y - depth / 2, x - width / 2);
    this.pitch = .6;
    this.zoomed = Math.min(this.zoomed, 1);
  }

  // How far the eye must be for the part to fit, whichever way it is turned
  // around z.
  distance(aspect) {
    const [radius, half] = [Math.hypot(this.part.size[0], this.part.size[1]) / 2,
      this.part.size[2] / 2];
    const [e, f] = [Math.cos(.6), Math.sin(.6)];
    let distance = 0;
    for (let i = 0; i < 32; ++i) {
      const angle = Math.PI * i / 16;
      for (const z of [-half, half]) {
        const [x, y] = [radius * Math.cos(angle), radius * Math.sin(angle)];
        distance = Math.max(distance, z * f - y * e +
            1.12 * kFocal * Math.max(Math.abs(x) / aspect, Math.abs(y * f + z * e)));
      }
    }
    return distance;
  }

  // How much higher a place in the middle is that is one pixel higher in the picture
  // [mm]; from above, as if it were seen from its side.
  heightOfPixel() {
    const {clientWidth, clientHeight} = this.canvas;
    const distance = this.distance(clientWidth / clientHeight) / this.zoomed;
    return 2 * distance / (clientHeight * kFocal * Math.max(.25, Math.cos(this.pitch)));
  }

  // Where the corner of the part's box that is farthest to the right is in the
  // picture, at a height above the bed [pixels]; null where nothing is shown.
  sectionEnd(height) {
    if (!this.part) return null;
    const {clientWidth, clientHeight} = this.canvas;
    const [width, depth, tall] = this.part.size;
    const [c, s] = [Math.cos(this.yaw), Math.sin(this.yaw)];
    const [e, f] = [Math.cos(this.pitch), Math.sin(this.pitch)];
    const aspect = clientWidth / clientHeight;
    const distance = this.distance(aspect) / this.zoomed;
    const z = height - tall / 2;
    const places = [[1, 1], [1, -1], [-1, 1], [-1, -1]].map(([i, j]) => {
      const [x, y] = [i * width / 2, j * depth / 2];
      const scale = kFocal / (distance - (f * z - s * e * x - c * e * y)) / 2;
      return [(.5 + scale * (c * x - s * y) / aspect) * clientWidth,
        (.5 - scale * (s * f * x + c * f * y + e * z)) * clientHeight];
    });
    return places.reduce((best, place) => place[0] > best[0] ? place : best);
  }

  // Draws the part up to the layer at a height above the bed, or all of it with
  // that layer's outline.
  //
  // state: {marks, supports}
  draw(state, height, isWhole) {
    const {gl, canvas, part} = this;
    const bodies = this.bodies.filter(
        ({depth}) => state.supports || depth !== kSupportDepth);
    if (bodies.length === 0) return;
    const index = layerAt(part.layers, height);
    const ratio = window.devicePixelRatio || 1;
    canvas.width = Math.round(canvas.clientWidth * ratio);
    canvas.height = Math.round(canvas.clientHeight * ratio);
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    const [c, s] = [Math.cos(this.yaw), Math.sin(this.yaw)];
    const [e, f] = [Math.cos(this.pitch), Math.sin(this.pitch)];
    const aspect = canvas.width / canvas.height;
    const use = (program, dotSize) => {
      const uniform = (name) => gl.getUniformLocation(program, name);
      gl.useProgram(program);
      // Columns: where x, y and z go; right, up, towards the viewer.
      gl.uniformMatrix3fv(uniform("turn"), false,
          [c, s * f, -s * e, -s, c * f, -c * e, 0, e, f]);
      gl.uniform3fv(uniform("center"), part.size.map((length) => length / 2));
      gl.uniform4f(uniform("lens"), this.distance(aspect) / this.zoomed, kFocal,
          aspect, Math.hypot(...part.size) / 2 * 1.01);
      gl.uniform1f(uniform("dotSize"), dotSize);
      return {
        light: (solid, shine) => {
          gl.uniform3fv(uniform("solid"), solid);
          gl.uniform1f(uniform("shine"), shine);
        },
        paint: (rgb, alpha) => gl.uniform4f(uniform("flatColor"), ...rgb, alpha),
      };
    };
    const isCut = !isWhole && index + 1 < part.layers.length;
    const {light} = use(this.lit, 0);
    this.forBodies(bodies, (body) => {
      light(body.color(), body.shine);
      this.drawSurface(body, isCut ? index : Infinity);
    });
    const {paint} = use(this.flat, 0);
    if (isCut) {
      this.forBodies(bodies, (body) => {
        paint(body.color().map((value) => .25 + .75 * value ** (1 / kGamma)), 1);
        this.drawSection(body, index);
      });
    }
    paint(rgbOf(color("outline")), 1);
    this.drawOutline(shownLayers(part, state)[index]);
    if (state.marks) this.drawMarks(ratio, use, isWhole ? Infinity : index);
    this.timeDraw();
  }

  forBodies(bodies, drawBody) {
    const {gl} = this;
    gl.enable(gl.POLYGON_OFFSET_FILL);
    for (const body of bodies) {
      gl.polygonOffset(body.depth, 4 * body.depth);
      drawBody(body);
    }
    gl.disable(gl.POLYGON_OFFSET_FILL);
  }

  // All of it, or as far as a layer.
  drawSurface({mesh, surface}, index) {
    const {gl} = this;
    gl.bindVertexArray(surface);
    const at = Math.min(mesh.ends.length - 1, Math.floor(index / mesh.stride));
    gl.drawElements(gl.TRIANGLES, 6 * (index < Infinity ? mesh.ends[at] : mesh.quads.count),
        gl.UNSIGNED_INT, 0);
  }

  drawSection(body, index) {
    const {gl} = this;
    if (body.cut !== index) {
      body.cut = index;
      body.sectionQuads = body.mesh.sectionOf(body.layers[index]);
      this.fillQuads(gl, body.section, body.sectionQuads);
    }
    gl.bindVertexArray(body.section);
    gl.drawElements(gl.TRIANGLES, 6 * body.sectionQuads.count, gl.UNSIGNED_INT, 0);
  }

  drawOutline(layer) {
    const {gl, part} = this;
    const z = layer.top - part.layers[0].bottom;
    const edges = edgesOf(layer.contours);
    const lines = new Float32Array(edges.length * 3 / 2);
    for (let i = 0; i < lines.length; ++i) {
      lines[i] = i % 3 === 2 ? z : edges[2 * Math.floor(i / 3) + i % 3];
    }
    this.fill(gl, this.outline, lines);
    gl.drawArrays(gl.LINES, 0, lines.length / 3);
  }

  // Marks the places up to a layer. Those behind the part shine through; many are
  // drawn smaller.
  drawMarks(ratio, use, last) {
    const {gl} = this;
    const places = this.part.found ? this.part.found.places : [];
    const size = ratio * Math.min(15, Math.max(5, 15 * Math.sqrt(40 / places.length)));
    const {paint} = use(this.flat, size);
    gl.bindVertexArray(this.marks);
    gl.enable(gl.BLEND);
    gl.depthMask(false);
    for (const [depthFunc, alpha] of [[gl.GREATER, .35], [gl.LEQUAL, 1]]) {
      gl.depthFunc(depthFunc);
      places.forEach(({kind, layer}, i) => {
        if (i === 0 || kind !== places[i - 1].kind) paint(rgbOf(colorOf(kind)), alpha);
        if (layer <= last + 1) gl.drawArrays(gl.POINTS, i, 1);
      });
    }
    gl.depthFunc(gl.LEQUAL);
    gl.depthMask(true);
    gl.disable(gl.BLEND);
  }
}
