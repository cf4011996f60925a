// The rival of bench/rivals that makes the Boolean mesh: Manifold, compiled to
// WebAssembly (npm package manifold-3d), then one slice for each layer.
//
//   node manifold_rival.mjs PACKAGE design.csg out.slc BOTTOM THICKNESS
//
// PACKAGE is the folder of manifold-3d. The design is OpenSCAD's tree (.csg),
// with the operators that the scenes of bench/scenes need. Leaves have
// OpenSCAD's vertices; spheres, cylinders and tori are made by Manifold's own
// constructors. Layers begin at BOTTOM, which is taken from lamina's output, so
// that both cut at the same heights.
import {readFileSync, writeFileSync} from 'node:fs';
import {pathToFileURL} from 'node:url';

const IDENTITY = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];

// --- .csg to a tree of {name, arguments, children} --------------------------

function parse(text) {
  const tokens = text.match(/[-+]?[\d.]+(?:e[-+]?\d+)?|\$?\w+|"[^"]*"|[^\s]/g);
  let at = 0;
  const take = (expected) => {
    if (tokens[at++] !== expected) {
      throw new Error(`expected ${expected} before token ${at}`);
    }
  };
  const value = () => {
    const token = tokens[at++];
    if (token !== '[') return token === 'true' || Number(token);
    const list = [];
    while (tokens[at] !== ']') {
      list.push(value());
      if (tokens[at] === ',') ++at;
    }
    ++at;
    return list;
  };
  const parameters = () => {
    const result = {};
    take('(');
    for (let i = 0; tokens[at] !== ')'; ++i) {
      let name = i;
      if (tokens[at + 1] === '=') {
        name = tokens[at];
        at += 2;
      }
      result[name] = value();
      if (tokens[at] === ',') ++at;
    }
    ++at;
    return result;
  };
  const list = (end) => {
    const nodes = [];
    while (tokens[at] !== end) nodes.push(node());
    return nodes;
  };
  const node = () => {
    const name = tokens[at++];
    const result = {name, parameters: parameters(), children: []};
    if (tokens[at++] === '{') {
      result.children = list('}');
      ++at;
    }
    return result;
  };
  return list(undefined);
}

// --- The tree to a Manifold -------------------------------------------------

// OpenSCAD's number of vertices of a circle.
function fragments(r, {$fn, $fa, $fs}) {
  if ($fn > 0) return Math.max($fn, 3);
  return Math.ceil(Math.max(Math.min(360 / $fa, r * 2 * Math.PI / $fs), 5));
}

// Half of a sphere's outline: rings of vertices between flat caps.
function sphereOutline(r, count) {
  const rings = Math.floor((count + 1) / 2);
  const points = [];
  for (let i = rings - 1; i >= 0; --i) {
    const angle = Math.PI * (i + 0.5) / rings;
    points.push([r * Math.sin(angle), r * Math.cos(angle)]);
  }
  return [[0, points[0][1]], ...points, [0, points[rings - 1][1]]];
}

// OpenSCAD's rows to Manifold's columns.
function transposed(rows) {
  return IDENTITY.map((_, i) => rows[i % 4][Math.floor(i / 4)]);
}

class Builder {
  constructor(Manifold) {
    this.Manifold = Manifold;
  }

  union(nodes) {
    const parts = nodes.map((node) => this.solid(node));
    return parts.length === 1 ? parts[0] : this.Manifold.union(parts);
  }

  solid({name, parameters: p, children}) {
    const {Manifold} = this;
    switch (name) {
      case 'group':
      case 'union':
        return this.union(children);
      case 'difference':
        return Manifold.difference(children.map((child) => this.solid(child)));
      case 'intersection':
        return Manifold.intersection(children.map((c) => this.solid(c)));
      case 'multmatrix':
        return this.union(children).transform(transposed(p[0]));
      case 'cube':
        return Manifold.cube(p.size, p.center);
      case 'cylinder':
        return Manifold.cylinder(p.h, p.r1, p.r2,
                                 fragments(Math.max(p.r1, p.r2), p), p.center);
      case 'sphere': {
        const count = fragments(p.r, p);
        return Manifold.revolve([sphereOutline(p.r, count)], count);
      }
      case 'rotate_extrude': {
        const outlines = children.flatMap((child) => this.outlines(child));
        const reach = Math.max(...outlines.flat().map(([x]) => x));
        return Manifold.revolve(outlines, fragments(reach, p));
      }
    }
    throw new Error(`${name}: no such operator here`);
  }

  // Polygons of a 2D subtree, which must not overlap.
  outlines({name, parameters: p, children}) {
    const below = children.flatMap((child) => this.outlines(child));
    switch (name) {
      case 'group':
        return below;
      case 'multmatrix': {
        const [[a, b, , c], [d, e, , f]] = p[0];
        return below.map((outline) => outline.map(
          ([x, y]) => [a * x + b * y + c, d * x + e * y + f]));
      }
      case 'circle': {
        const count = fragments(p.r, p);
        return [Array.from({length: count}, (_, i) => {
          const angle = 2 * Math.PI * i / count;
          return [p.r * Math.cos(angle), p.r * Math.sin(angle)];
        })];
      }
    }
    throw new Error(`${name}: no such 2D operator here`);
  }
}

// --- Layers -----------------------------------------------------------------

function float32(...values) {
  return Buffer.from(Float32Array.from(values).buffer);
}

function uint32(...values) {
  return Buffer.from(Uint32Array.from(values).buffer);
}

function* slc(solid, bottom, thickness) {
  yield Buffer.from('-SLCVER 2.0 -UNIT MM -TYPE PART -PACKAGE manifold-3d' +
                    '\r\n\x1A', 'latin1');
  yield Buffer.alloc(256);
  yield Buffer.from([1]);
  yield float32(bottom, thickness, 0, 0);
  const top = solid.boundingBox().max[2];
  const count = Math.ceil((top - bottom) / thickness);
  for (let layer = 0; layer < count; ++layer) {
    const section = solid.slice(bottom + (layer + 0.5) * thickness);
    const polygons = section.toPolygons();
    section.delete();
    if (polygons.length === 0) continue;
    yield float32(bottom + layer * thickness);
    yield uint32(polygons.length);
    for (const polygon of polygons) {
      yield uint32(polygon.length + 1, 0);
      yield float32(...polygon.flat(), ...polygon[0]);
    }
  }
  yield float32(bottom + count * thickness);
  yield uint32(0xFFFFFFFF);
}

const [folder, design, output, bottom, thickness] = process.argv.slice(2);
const {default: load} = await import(pathToFileURL(`${folder}/manifold.js`));
const module = await load();
module.setup();
const tree = parse(readFileSync(design, 'latin1'));
const solid = new Builder(module.Manifold).union(tree);
writeFileSync(output,
              Buffer.concat([...slc(solid, Number(bottom), Number(thickness))]));
