// The part: what the page was given, as numbers.

// Integers as lamina writes them: 7 bits a byte, low ones first.
class Numbers {
  constructor(bytes) {
    this.bytes = bytes;
    this.place = 0;
  }

  count() {
    let value = 0;
    let weight = 1;
    for (;;) {
      const byte = this.bytes[this.place++];
      value += (byte & 0x7f) * weight;
      if (byte < 0x80) return value;
      weight *= 128;
    }
  }

  signed() {
    const value = this.count();
    return value % 2 ? -(value + 1) / 2 : value / 2;
  }
}

// By hand where the browser cannot: Uint8Array.from() would take ten times as long.
function bytesOf(base64) {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(base64);
  const letters = atob(base64);
  const bytes = new Uint8Array(letters.length);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = letters.charCodeAt(i);
  return bytes;
}

async function inflate(bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(
      new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// Places in mm, counted from the part's lower left corner: small numbers, that
// a canvas can draw exactly.
class Places {
  constructor(numbers, step) {
    this.numbers = numbers;
    this.step = step;
    this.x = 0;
    this.y = 0;
  }

  next() {
    this.x += this.numbers.signed();
    this.y += this.numbers.signed();
    return [this.x * this.step, this.y * this.step];
  }
}

// A list of loops, which are flat arrays x, y, x, y, ….
function readLoops(numbers, places) {
  return Array.from({length: numbers.count()}, () => {
    const loop = new Float64Array(2 * numbers.count());
    for (let i = 0; i < loop.length; i += 2) loop.set(places.next(), i);
    return loop;
  });
}

// The loops of some bodies by themselves: loops of the whole, each with its owner,
// and what is left of each body.
function readBodies(numbers, places, contours, count) {
  const owners = contours.map(() => numbers.count());
  return Array.from({length: count}, (_, owner) => [
    ...contours.filter((_, i) => owners[i] === owner), ...readLoops(numbers, places)]);
}

// A layer from its row, without contours.
const layerOf = ([z, bottom, top, loops, holes, vertices, area, perimeter]) =>
  ({z, bottom, top, loops, holes, vertices, area, perimeter, marks: []});

// The part from its facts and the bytes of its contours, as
// slicer/picture/viewer_part.h makes them: {title, estimate, low, size, volume,
// minFeature, layers: [{z, bottom, top, loops, holes, vertices, area, perimeter,
// contours, marks}], partLayers, supports, colored, found}.
//
// contours are lists of loops. partLayers are the layers without supports; supports is
// null where there are none: {text, partVolume, layers: [{bottom, top, contours}]};
// colored is what of the part has a color: [{color, layers}]. found has what was looked
// for, else it is null: {places: [{kind, first, last, layer, place, reach, text,
// origin}], notes, hasPrint}.
function readPart(facts, bytes) {
  const numbers = new Numbers(bytes);
  const layers = facts.layers.map(layerOf);

  let places = new Places(numbers, facts.step);
  for (const layer of layers) {
    layer.contours = readLoops(numbers, places);
    if (facts.supports) {
      [layer.part, layer.supports] = readBodies(numbers, places, layer.contours, 2);
    }
    layer.colored = !facts.colors ? [] : readBodies(
        numbers, places, layer.part || layer.contours, facts.colors.length);
  }
  if (facts.minFeature) {
    places = new Places(numbers, facts.step);
    for (const layer of layers) {
      layer.marks = Array.from({length: numbers.count()}, () => ({
        kind: numbers.count() ? "gap" : "wall",
        from: places.next(),
        to: places.next(),
      }));
    }
  }
  const partLayers = !facts.supports ? layers : layers.map((layer, i) => {
    const [loops, holes, vertices, area, perimeter] = facts.supports.partLayers[i];
    return {...layer, loops, holes, vertices, area, perimeter, contours: layer.part};
  });
  const supports = facts.supports ? {
    text: facts.supports.text,
    partVolume: facts.supports.partVolume,
    layers: layers.map(({bottom, top, supports}) => ({bottom, top, contours: supports})),
  } : null;
  const [x, y] = facts.low;
  const found = facts.found && {
    ...facts.found,
    places: facts.found.places.map(
        ([kind, first, last, layer, px, py, reach, text, origin]) =>
          ({kind, first, last, layer, place: [px - x, py - y], reach, text,
            origin: facts.found.origins[origin] || ""})),
  };
  return {
    title: facts.title,
    estimate: facts.estimate,
    low: facts.low,
    size: [facts.high[0] - x, facts.high[1] - y,
      layers[layers.length - 1].top - layers[0].bottom],
    volume: facts.volume,
    minFeature: facts.minFeature,
    layers,
    partLayers,
    supports,
    colored: (facts.colors || []).map((color, i) => ({
      color,
      layers: layers.map(({bottom, top, colored}) => ({bottom, top, contours: colored[i]})),
    })),
    found,
  };
}

// A layer by itself, as the studio sends it before all others: {layer, index,
// count, low, size, bed}; bed is where heights are counted from.
function readLayer({row, index, count, low, high, bottom, step, contours}) {
  const numbers = new Numbers(bytesOf(contours));
  const layer = layerOf(row);
  layer.contours = readLoops(numbers, new Places(numbers, step));
  return {layer, index, count, low, size: [high[0] - low[0], high[1] - low[1]], bed: bottom};
}

// The layer whose middle is nearest to a height above the bed.
function layerAt(layers, height) {
  const away = (layer) => Math.abs(middleOf(layer, layers[0].bottom) - height);
  let nearest = 0;
  layers.forEach((layer, i) => { if (away(layer) < away(layers[nearest])) nearest = i; });
  return nearest;
}

const middleOf = ({bottom, top}, bed) => (bottom + top) / 2 - bed;

// The path of a layer's contours, made when it is first drawn.
function pathOf(layer) {
  if (!layer.path) {
    layer.path = new Path2D();
    for (const loop of layer.contours) {
      layer.path.moveTo(loop[0], loop[1]);
      for (let i = 2; i < loop.length; i += 2) layer.path.lineTo(loop[i], loop[i + 1]);
      layer.path.closePath();
    }
  }
  return layer.path;
}
