// The part as a solid, whole or up to the layer in hand, on WebGL. Layers are
// drawn as the plates that they are, but lit by the slope from layer to layer, so
// that steps do not show.

const kMostCorners = 150000;  // of all layers drawn: of more, some are left out
const kFinest = 1 / 4000;     // of the part's size: smaller bends are not drawn
const kSlopeLength = .0018;   // of the part's size: slopes are taken over this
const kSlopeReach = 20;       // such lengths: tops that are level so far are level
const kSmoothCosine = .8;     // of the angle between edges that make a curve
const kPieces = 40;           // across the part: larger ones are divided
const kPatience = 25;         // of the page, while the solid is made [ms]

// How deep places lie in a layer, as far as `reach`; less than 0 outside.
class Depths {
  constructor(contours, reach) {
    this.reach = reach;
    this.rows = [];
    const ys = contours.flatMap((loop) => Array.from(loop).filter((_, i) => i % 2));
    this.low = ys.reduce((a, b) => Math.min(a, b), Infinity);
    const high = ys.reduce((a, b) => Math.max(a, b), -Infinity);
    const count = Math.min(256, Math.max(1, ys.length >> 1));
    this.height = Math.max((high - this.low) / count, 1e-9);
    if (ys.length === 0) return;
    this.rows = Array.from({length: count}, () => []);
    forEdges(contours, (ax, ay, bx, by) => {
      const rows = [this.rowOf(ay), this.rowOf(by)].sort((a, b) => a - b);
      for (let row = rows[0]; row <= rows[1]; ++row) {
        this.rows[row].push(ax, ay, bx, by);
      }
    });
  }

  rowOf(y) {
    return Math.min(this.rows.length - 1,
        Math.max(0, Math.floor((y - this.low) / this.height)));
  }

  at(x, y) {
    if (this.rows.length === 0) return -this.reach;
    const middle = this.rowOf(y);
    let nearest = this.reach ** 2;
    let winding = 0;
    const look = (row, isOwn) => {
      const edges = this.rows[row];
      for (let i = 0; i < edges.length; i += 4) {
        const ax = edges[i];
        const ay = edges[i + 1];
        const dx = edges[i + 2] - ax;
        const dy = edges[i + 3] - ay;
        const t = Math.min(1, Math.max(0,
            ((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy || 1)));
        nearest = Math.min(nearest, (x - ax - t * dx) ** 2 + (y - ay - t * dy) ** 2);
        if (isOwn && (ay <= y) !== (ay + dy <= y) && ax + dx * (y - ay) / dy < x) {
          winding += dy > 0 ? 1 : -1;
        }
      }
    };
    look(middle, true);
    for (const step of [-1, 1]) {
      for (let row = middle + step; row in this.rows; row += step) {
        const side = this.low + (step < 0 ? row + 1 : row) * this.height;
        const gap = (side - y) * step;
        if (gap > 0 && gap * gap >= nearest) break;
        look(row, false);
      }
    }
    return Math.sqrt(nearest) * (winding === 0 ? -1 : 1);
  }
}

function forEdges(contours, visit) {
  for (const loop of contours) {
    const count = loop.length / 2;
    for (let i = 0; i < count; ++i) {
      const j = (i + 1) % count;
      visit(loop[2 * i], loop[2 * i + 1], loop[2 * j], loop[2 * j + 1], loop, i);
    }
  }
}

// Calls visit(edge, edge, bottom, top) for trapezoids that cover what the edges
// enclose: {x, y, x1, y1, …} with y < y1 and their winding.
function sweep(edges, heights, visit) {
  edges.sort((a, b) => a.y - b.y);
  heights.sort((a, b) => a - b);
  const xAt = (edge, y) => edge.x + (edge.x1 - edge.x) * (y - edge.y) / (edge.y1 - edge.y);
  let active = [];
  let strips = [];
  let next = 0;
  const replace = (fresh, height) => {
    for (const old of strips) {
      const same = fresh.find((s) => s.left === old.left && s.right === old.right);
      if (same) same.bottom = old.bottom;
      else visit(old.left, old.right, old.bottom, height);
    }
    strips = fresh;
  };
  for (let i = 0; i + 1 < heights.length; ++i) {
    const bottom = heights[i];
    if (heights[i + 1] === bottom) continue;
    const middle = (bottom + heights[i + 1]) / 2;
    active = active.filter((edge) => edge.y1 > bottom);
    while (next < edges.length && edges[next].y <= bottom) active.push(edges[next++]);
    for (const edge of active) edge.at = xAt(edge, middle);
    active.sort((a, b) => a.at - b.at);
    const fresh = [];
    let winding = 0;
    for (const edge of active) {
      if (winding === 0) fresh.push({left: edge, right: edge, bottom});
      winding += edge.winding;
      if (winding === 0) fresh[fresh.length - 1].right = edge;
    }
    replace(fresh, bottom);
  }
  replace([], heights[heights.length - 1]);
}

// Loops with no edge longer than `longest`.
function divideEdges(contours, longest) {
  return contours.map((loop) => {
    const points = [];
    forEdges([loop], (ax, ay, bx, by) => {
      const count = Math.ceil(Math.hypot(bx - ax, by - ay) / longest) || 1;
      for (let i = 0; i < count; ++i) {
        points.push(ax + (bx - ax) * i / count, ay + (by - ay) * i / count);
      }
    });
    return points;
  });
}

// A loop without the corners that are nearer than `finest` to the line past them
// (Douglas and Peucker).
function simplify(loop, finest) {
  const count = loop.length / 2;
  const isKept = new Uint8Array(count);
  const farthest = (from, to) => {
    const [ax, ay] = [loop[2 * from], loop[2 * from + 1]];
    const [bx, by] = [loop[2 * (to % count)] - ax, loop[2 * (to % count) + 1] - ay];
    const length = Math.hypot(bx, by);
    let best = [0, from];
    for (let i = from + 1; i < to; ++i) {
      const [x, y] = [loop[2 * i] - ax, loop[2 * i + 1] - ay];
      const away = length > 0 ? Math.abs(x * by - y * bx) / length : Math.hypot(x, y);
      if (away > best[0]) best = [away, i];
    }
    return best;
  };
  isKept[0] = 1;
  const spans = [[0, farthest(0, count)[1]]];
  if (spans[0][1] > 0) spans.push([spans[0][1], count]);
  while (spans.length) {
    const [from, to] = spans.pop();
    isKept[from] = 1;
    const [away, middle] = farthest(from, to);
    if (away > finest) spans.push([from, middle], [middle, to]);
  }
  return Array.from(loop).filter((_, i) => isKept[i >> 1]);
}

// Corners of all plates: place, and direction of the surface; ordered by layer:
// sides, then what is seen of the bottom, then of the top. The section, all of
// it, is apart: it is drawn of the last layer only.
class PlateMesh {
  constructor(part) {
    this.part = part;
    this.places = [];
    this.normals = [];
    this.indices = [];
    this.sections = [];
    this.ends = [];  // of a layer: {bottoms, tops, section}, in indices
    const length = Math.hypot(...part.size);
    this.piece = Math.max(...part.size) / kPieces;
    let layers = part.layers.map((layer) => ({...layer,
      drawn: layer.contours.map((loop) => simplify(loop, kFinest * length))
          .filter((loop) => loop.length > 4)}));
    const corners = layers.reduce((sum, {drawn}) =>
      drawn.reduce((ofLayer, loop) => ofLayer + loop.length / 2, sum), 0);
    this.stride = Math.max(1, Math.ceil(corners / kMostCorners));
    this.layers = layers.filter((_, i) => i % this.stride === 0);
    this.thickness = part.size[2] / this.layers.length || 1;
    const slope = Math.max(this.thickness, kSlopeLength * length);
    this.half = Math.max(1, Math.round(slope / this.thickness / 2));
    this.reach = kSlopeReach * slope;
    this.depths = [];
  }

  // Adds all layers, and gives the page its turn now and then.
  async build() {
    let begin = performance.now();
    for (let i = 0; i < this.layers.length; ++i) {
      this.add(i);
      delete this.depths[i - this.half - 1];
      if (performance.now() - begin < kPatience) continue;
      await new Promise((resolve) => setTimeout(resolve));
      begin = performance.now();
    }
    this.places = new Float32Array(this.places);
    this.normals = new Float32Array(this.normals);
    this.sectionBegin = this.indices.length;
    this.indices = new Uint32Array([this.indices, this.sections].flat());
  }

  // Of a layer; those beyond the stack are empty.
  depthsOf(i) {
    this.depths[i] ||= new Depths(i in this.layers ? this.layers[i].contours : [], this.reach);
    return this.depths[i];
  }

  add(i) {
    const base = this.part.layers[0].bottom;
    const layer = this.layers[i];
    const next = this.layers[i + 1];
    const low = layer.bottom - base;
    const high = (next ? next.bottom : layer.top) - base;
    const [below, above] = [this.depthsOf(i - 1), this.depthsOf(i + 1)];
    const [from, to] = [this.depthsOf(i - this.half), this.depthsOf(i + this.half)];
    const slopeAt = (x, y) =>
      (from.at(x, y) - to.at(x, y)) / (2 * this.half * this.thickness);
    const edges = [];
    const heights = [];
    for (const loop of divideEdges(layer.drawn, this.piece)) {
      const slopes = Array.from({length: loop.length / 2},
          (_, k) => slopeAt(loop[2 * k], loop[2 * k + 1]));
      forEdges([loop], (ax, ay, bx, by, _, k) => {
        const a = this.direction(loop, k, k, slopes);
        const b = this.direction(loop, k, (k + 1) % slopes.length, slopes);
        this.quad(this.indices, [ax, ay, low], a, [bx, by, low], b,
            [bx, by, high], b, [ax, ay, high], a);
        heights.push(ay);
        if (ay < by) edges.push({x: ax, y: ay, x1: bx, y1: by, n: a, n1: b, winding: -1});
        if (ay > by) edges.push({x: bx, y: by, x1: ax, y1: ay, n: b, n1: a, winding: 1});
      });
    }
    const caps = [];
    if (heights.length) sweep(edges, heights, (...cap) => caps.push(cap));
    for (const cap of caps) this.addCap(cap, low, below, slopeAt);
    const bottoms = this.indices.length;
    for (const cap of caps) this.addCap(cap, high, above, slopeAt);
    for (const [left, right, y0, y1] of caps) {
      this.quad(this.sections, ...[[left, y0], [right, y0], [right, y1], [left, y1]]
          .flatMap(([edge, y]) => [[...this.onEdge(edge, y).slice(0, 2), high], [0, 0, 1]]));
    }
    this.ends.push({bottoms, tops: this.indices.length, section: this.sections.length});
  }

  // Where an edge is at a height, and its surface's direction there: x, y, nx, ny.
  onEdge(edge, y) {
    const t = (y - edge.y) / (edge.y1 - edge.y);
    return [edge.x + t * (edge.x1 - edge.x), y,
      edge.n[0] + t * (edge.n1[0] - edge.n[0]), edge.n[1] + t * (edge.n1[1] - edge.n[1])];
  }

  // What the neighbouring layer leaves free of a trapezoid, in pieces.
  addCap([left, right, y0, y1], z, cover, slopeAt) {
    const ends = [y0, y1].map((y) => [this.onEdge(left, y), this.onEdge(right, y)]);
    const width = Math.max(...ends.map(([a, b]) => b[0] - a[0]));
    const count = Math.ceil(width / this.piece) || 1;
    const reach = Math.min(Math.hypot(width / count, y1 - y0), .999 * cover.reach);
    const columns = Array.from({length: count + 1}, (_, i) => ends.map(([a, b]) => {
      const [x, y, nx, ny] = a.map((value, k) => value + (b[k] - value) * i / count);
      return {place: [x, y, z], normal: [nx, ny, slopeAt(x, y)],
        isCovered: cover.at(x, y) >= reach};
    }));
    for (let i = 0; i < count; ++i) {
      const corners = [columns[i][0], columns[i + 1][0], columns[i + 1][1], columns[i][1]];
      if (corners.every((corner) => corner.isCovered)) continue;
      this.quad(this.indices, ...corners.flatMap(({place, normal}) => [place, normal]));
    }
  }

  // Of the surface at a corner of edge i: the edge's, or that of the curve.
  direction(loop, i, corner, slopes) {
    const count = loop.length / 2;
    const outward = (k) => {
      const j = (k + 1) % count;
      const dx = loop[2 * j] - loop[2 * k];
      const dy = loop[2 * j + 1] - loop[2 * k + 1];
      const length = Math.hypot(dx, dy) || 1;
      return [dy / length, -dx / length];
    };
    let [x, y] = outward(i);
    const [ox, oy] = outward(corner === i ? (i + count - 1) % count : corner);
    if (x * ox + y * oy > kSmoothCosine) {
      const length = Math.hypot(x + ox, y + oy);
      [x, y] = [(x + ox) / length, (y + oy) / length];
    }
    return [x, y, slopes[corner]];
  }

  quad(indices, ...corners) {
    const first = this.places.length / 3;
    for (let i = 0; i < 8; i += 2) {
      this.places.push(...corners[i]);
      this.normals.push(...corners[i + 1]);
    }
    indices.push(first, first + 1, first + 2, first, first + 2, first + 3);
  }
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
  vec3 light = solid * diffuse * .3 +
      mix(solid, vec3(1), .7 * pow(1. - facing, 5.)) * room(to);
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

// "#rrggbb" as numbers from 0 to 1.
function rgbOf(name) {
  const digits = parseInt(name.trim().slice(1), 16);
  return [digits >> 16 & 255, digits >> 8 & 255, digits & 255].map((value) => value / 255);
}

class Solid {
  constructor(canvas, part) {
    this.canvas = canvas;
    this.part = part;
    this.reset();
  }

  reset() {
    this.yaw = -.43;
    this.pitch = .6;
    this.zoomed = 1;
  }

  // Makes what is drawn. Throws where there is no WebGL.
  async open() {
    const gl = this.canvas.getContext("webgl2", {antialias: true, preserveDrawingBuffer: true});
    if (!gl) throw new Error("This browser has no WebGL 2, or has it turned off: no solid.");
    const mesh = new PlateMesh(this.part);
    await mesh.build();
    this.mesh = mesh;
    this.lit = this.program(gl, kFragmentShader);
    this.flat = this.program(gl, kFlatShader);
    this.surface = this.corners(gl, mesh.places, mesh.normals);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, mesh.indices, gl.STATIC_DRAW);
    this.marks = this.corners(gl, this.markPlaces());
    this.outline = this.corners(gl, new Float32Array());
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LEQUAL);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
    this.gl = gl;
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

  // A vertex array of places, and of normals where there are any.
  corners(gl, ...arrays) {
    const corners = gl.createVertexArray();
    gl.bindVertexArray(corners);
    arrays.forEach((data, at) => {
      corners.buffer = gl.createBuffer();
      gl.bindBuffer(gl.ARRAY_BUFFER, corners.buffer);
      gl.bufferData(gl.ARRAY_BUFFER, data, gl.STATIC_DRAW);
      gl.vertexAttribPointer(at, 3, gl.FLOAT, false, 0, 0);
      gl.enableVertexAttribArray(at);
    });
    return corners;
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

  // How far the eye must be for the part to fit, whichever way it is turned
  // around z.
  distance(focal, aspect) {
    const [radius, half] = [Math.hypot(this.part.size[0], this.part.size[1]) / 2,
      this.part.size[2] / 2];
    const [e, f] = [Math.cos(.6), Math.sin(.6)];
    let distance = 0;
    for (let i = 0; i < 32; ++i) {
      const angle = Math.PI * i / 16;
      for (const z of [-half, half]) {
        const [x, y] = [radius * Math.cos(angle), radius * Math.sin(angle)];
        distance = Math.max(distance, z * f - y * e +
            1.12 * focal * Math.max(Math.abs(x) / aspect, Math.abs(y * f + z * e)));
      }
    }
    return distance;
  }

  // Draws the part up to a layer, or all of it with that layer's outline.
  draw(index, isWhole, hasMarks) {
    const {gl, canvas, part, mesh} = this;
    if (!mesh) return;
    const ratio = window.devicePixelRatio || 1;
    canvas.width = Math.round(canvas.clientWidth * ratio);
    canvas.height = Math.round(canvas.clientHeight * ratio);
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    const [c, s] = [Math.cos(this.yaw), Math.sin(this.yaw)];
    const [e, f] = [Math.cos(this.pitch), Math.sin(this.pitch)];
    const aspect = canvas.width / canvas.height;
    const focal = 4;
    const use = (program, dotSize) => {
      const uniform = (name) => gl.getUniformLocation(program, name);
      gl.useProgram(program);
      // Columns: where x, y and z go; right, up, towards the viewer.
      gl.uniformMatrix3fv(uniform("turn"), false,
          [c, s * f, -s * e, -s, c * f, -c * e, 0, e, f]);
      gl.uniform3fv(uniform("center"), part.size.map((length) => length / 2));
      gl.uniform4f(uniform("lens"), this.distance(focal, aspect) / this.zoomed, focal,
          aspect, Math.hypot(...part.size) / 2 * 1.01);
      gl.uniform3fv(uniform("solid"), kGold);
      gl.uniform1f(uniform("dotSize"), dotSize);
      return (rgb, alpha) => gl.uniform4f(uniform("flatColor"), ...rgb, alpha);
    };
    use(this.lit, 0);
    gl.bindVertexArray(this.surface);
    const at = isWhole ? mesh.ends.length - 1 :
      Math.min(mesh.ends.length - 1, Math.floor(index / mesh.stride));
    const end = mesh.ends[at];
    const isCut = at + 1 < mesh.ends.length;
    gl.drawElements(gl.TRIANGLES, isCut ? end.bottoms : end.tops, gl.UNSIGNED_INT, 0);
    const paint = use(this.flat, 0);
    if (isCut) {
      const begin = at > 0 ? mesh.ends[at - 1].section : 0;
      paint(kGold.map((value) => .25 + .75 * value ** (1 / 2.2)), 1);
      gl.drawElements(gl.TRIANGLES, end.section - begin, gl.UNSIGNED_INT,
          4 * (mesh.sectionBegin + begin));
    }
    paint(rgbOf(color("outline")), 1);
    this.drawOutline(index);
    if (hasMarks) this.drawMarks(ratio, use, isWhole ? Infinity : index);
  }

  drawOutline(index) {
    const {gl, part} = this;
    const layer = part.layers[index];
    const z = layer.top - part.layers[0].bottom;
    const lines = [];
    forEdges(layer.contours, (ax, ay, bx, by) => lines.push(ax, ay, z, bx, by, z));
    gl.bindVertexArray(this.outline);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.outline.buffer);
    gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(lines), gl.DYNAMIC_DRAW);
    gl.drawArrays(gl.LINES, 0, lines.length / 3);
  }

  // Marks the places up to a layer. Those behind the part shine through; many are
  // drawn smaller.
  drawMarks(ratio, use, last) {
    const {gl} = this;
    const places = this.part.found ? this.part.found.places : [];
    const size = ratio * Math.min(15, Math.max(5, 15 * Math.sqrt(40 / places.length)));
    const paint = use(this.flat, size);
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
