// What is drawn: the section with its rulers, and the plot of areas.

const kRuler = 24;  // width of a ruler [pixels]

// The largest of 1, 2, 5, 10, … that is no longer.
function roundLength(longest) {
  const power = 10 ** Math.floor(Math.log10(longest));
  return [5, 2, 1].map((digit) => digit * power)
      .find((length) => length <= longest * (1 + 1e-9));
}

// With so many digits; nothing is -0.
function fixed(value, digits) {
  const text = value.toFixed(digits);
  return /[1-9]/.test(text) ? text : text.replace("-", "");
}

// As few digits as a ruler of that step needs.
function rulerText(value, step) {
  return fixed(value, Math.max(0, -Math.floor(Math.log10(step) + 1e-9)));
}

function color(name) {
  return getComputedStyle(document.documentElement).getPropertyValue("--" + name);
}

// Of a kind of place: "loose part".
function colorOf(kind) {
  return color(kind.replace(" ", "-"));
}

// Gives a canvas the pixels of its place on the page; returns its context, in
// the page's pixels, and its size.
function prepare(canvas) {
  const ratio = window.devicePixelRatio || 1;
  const width = canvas.clientWidth;
  const height = canvas.clientHeight;
  if (canvas.width !== Math.round(width * ratio) ||
      canvas.height !== Math.round(height * ratio)) {
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
  }
  const context = canvas.getContext("2d");
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.clearRect(0, 0, width, height);
  return {context, width, height, ratio};
}

// Where millimetres of the part lie on the canvas; y up there, down here. Places
// are counted from `low`, the part's lower left corner.
class View {
  constructor() {
    this.low = [0, 0];
    this.scale = 1;  // pixels per mm
    this.x = 0;      // of the part's corner
    this.y = 0;
  }

  toPage([x, y]) {
    return [this.x + x * this.scale, this.y - y * this.scale];
  }

  toPart([x, y]) {
    return [(x - this.x) / this.scale, (this.y - y) / this.scale];
  }

  // Counts places from another corner; what is on the page stays there.
  countFrom(low) {
    this.x += (low[0] - this.low[0]) * this.scale;
    this.y -= (low[1] - this.low[1]) * this.scale;
    this.low = low;
  }

  // Whether all of a box from the origin is on the canvas.
  hasAll([width, height], [toRight, toFoot]) {
    return this.x >= 0 && this.y <= toFoot && this.x + width * this.scale <= toRight &&
      this.y - height * this.scale >= 0;
  }

  // Shows the box in the free area of the canvas.
  show([x0, y0], [x1, y1], width, height) {
    const margin = Math.min(60, width / 10, height / 10);
    this.scale = Math.min(
        Math.max(width - kRuler - 2 * margin, 1) / Math.max(x1 - x0, 1e-6),
        Math.max(height - kRuler - 2 * margin, 1) / Math.max(y1 - y0, 1e-6));
    this.x = (width + kRuler - (x0 + x1) * this.scale) / 2;
    this.y = (height + kRuler + (y0 + y1) * this.scale) / 2;
  }

  zoom(factor, [x, y]) {
    const scale = Math.min(1e6, Math.max(1e-3, this.scale * factor));
    this.x = x - (x - this.x) * scale / this.scale;
    this.y = y - (y - this.y) * scale / this.scale;
    this.scale = scale;
  }
}

// The layers as they are shown: of the part alone, or with its supports.
function shownLayers(part, state) {
  return state.supports ? part.layers : part.partLayers;
}

// What was found in the print: all places but thin ones, which have lines.
function findingsOf(part) {
  return part.found ? part.found.places.filter(({kind}) => kind !== "wall" && kind !== "gap") : [];
}

class Drawing {
  // measuring  draws what is measured; null: nothing is
  constructor(canvas, view, measuring) {
    this.canvas = canvas;
    this.view = view;
    this.measuring = measuring;
    this.part = null;
  }

  // state: {index, early, below, marks, supports, pointer}; early is a layer by
  // itself, shown instead of the part's.
  draw(state) {
    const sheet = prepare(this.canvas);
    sheet.context.fillStyle = color("field");
    sheet.context.fillRect(0, 0, sheet.width, sheet.height);
    this.drawGrid(sheet);
    if (state.early) this.drawLayer(sheet, state.early.layer, "solid", "outline");
    else this.drawPart(sheet, state);
    if (this.measuring) this.measuring.draw(sheet);
    this.drawRulers(sheet, state.pointer);
    this.drawScale(sheet);
  }

  drawPart(sheet, state) {
    const {part} = this;
    if (state.below && state.index > 0) {
      this.strokePath(sheet, shownLayers(part, state)[state.index - 1], "faint", [4, 3]);
    }
    // The part hides the tips that are in it.
    if (part.supports && state.supports) {
      this.drawLayer(sheet, part.supports.layers[state.index], "support", "support-outline");
    }
    this.drawLayer(sheet, part.partLayers[state.index], "solid", "outline");
    if (state.marks) this.drawMarks(sheet, state.index);
  }

  inPart({context, ratio}) {
    const {scale, x, y} = this.view;
    context.setTransform(ratio * scale, 0, 0, -ratio * scale, ratio * x, ratio * y);
  }

  drawLayer(sheet, layer, solid, outline) {
    sheet.context.save();
    this.inPart(sheet);
    sheet.context.fillStyle = color(solid);
    sheet.context.fill(pathOf(layer));
    sheet.context.restore();
    this.strokePath(sheet, layer, outline, []);
  }

  strokePath(sheet, layer, name, dashes) {
    const {context} = sheet;
    context.save();
    this.inPart(sheet);
    context.lineWidth = 1.3 / this.view.scale;
    context.lineJoin = "round";
    context.setLineDash(dashes.map((length) => length / this.view.scale));
    context.strokeStyle = color(name);
    context.stroke(pathOf(layer));
    context.restore();
  }

  // Calls visit(page, mm) for the lines of a ruler along one axis (0: x, 1: y).
  forTicks(axis, step, length, visit) {
    const a = this.view.toPart([0, 0])[axis] + this.view.low[axis];
    const b = this.view.toPart([length, length])[axis] + this.view.low[axis];
    const first = Math.ceil(Math.min(a, b) / step);
    const last = Math.floor(Math.max(a, b) / step);
    for (let i = first; i <= last; ++i) {
      const place = i * step - this.view.low[axis];
      visit(this.view.toPage([place, place])[axis], i * step);
    }
  }

  // Adds lines across the ticks of both rulers, between two distances from the
  // canvas's left and upper side; none for ticks nearer to those than `least`.
  addTicks({context, width, height}, step, least, from, to) {
    this.forTicks(0, step, width, (x) => {
      if (x < least) return;
      context.moveTo(Math.round(x) + .5, from);
      context.lineTo(Math.round(x) + .5, to);
    });
    this.forTicks(1, step, height, (y) => {
      if (y < least) return;
      context.moveTo(from, Math.round(y) + .5);
      context.lineTo(to, Math.round(y) + .5);
    });
  }

  drawGrid(sheet) {
    const {context, width, height} = sheet;
    context.strokeStyle = color("line");
    context.lineWidth = 1;
    context.beginPath();
    this.addTicks(sheet, roundLength(110 / this.view.scale), 0, 0, Math.max(width, height));
    context.stroke();
  }

  // Thin places as lines; what was found in the print as rings, in the layer
  // where it begins as a disk.
  drawMarks({context}, index) {
    context.lineWidth = 4;
    context.lineCap = "round";
    for (const mark of this.part.layers[index].marks) {
      context.strokeStyle = color(mark.kind);
      context.beginPath();
      context.moveTo(...this.view.toPage(mark.from));
      context.lineTo(...this.view.toPage(mark.to));
      context.stroke();
    }
    context.lineCap = "butt";
    for (const {kind, first, last, layer, place} of findingsOf(this.part)) {
      if (index + 1 < first || index + 1 > last) continue;
      context.strokeStyle = context.fillStyle = colorOf(kind);
      context.lineWidth = 2.5;
      context.beginPath();
      context.arc(...this.view.toPage(place), 8, 0, 2 * Math.PI);
      context.stroke();
      if (index + 1 !== layer) continue;
      context.beginPath();
      context.arc(...this.view.toPage(place), 4, 0, 2 * Math.PI);
      context.fill();
    }
  }

  drawRulers(sheet, pointer) {
    const {context, width, height} = sheet;
    context.fillStyle = color("paper");
    context.fillRect(0, 0, width, kRuler);
    context.fillRect(0, 0, kRuler, height);
    const step = roundLength(110 / this.view.scale);
    context.strokeStyle = color("faint");
    context.fillStyle = color("faint");
    context.font = "11px system-ui, 'DejaVu Sans', sans-serif";
    context.lineWidth = 1;
    context.beginPath();
    for (const [part, length] of [[1, 9], [.1, 4]]) {
      this.addTicks(sheet, step * part, kRuler, kRuler - length, kRuler);
    }
    context.stroke();
    this.forTicks(0, step, width, (x, mm) => {
      if (x > kRuler) context.fillText(rulerText(mm, step), x + 4, 12);
    });
    this.forTicks(1, step, height, (y, mm) => {
      if (y < kRuler + 20) return;
      context.save();
      context.translate(12, y - 4);
      context.rotate(-Math.PI / 2);
      context.fillText(rulerText(mm, step), 0, 0);
      context.restore();
    });
    if (pointer) {
      context.fillStyle = color("accent");
      context.fillRect(pointer[0] - .5, 0, 1, kRuler);
      context.fillRect(0, pointer[1] - .5, kRuler, 1);
    }
    context.fillStyle = color("paper");
    context.fillRect(0, 0, kRuler, kRuler);
  }

  drawScale({context, height}) {
    const length = roundLength(150 / this.view.scale);
    const x = kRuler + 16.5;
    const y = height - 19.5;
    const end = x + length * this.view.scale;
    const words = length < .01 ? word("micrometres", +(length * 1000).toPrecision(1)) :
      word("mm", +length.toPrecision(1));
    context.font = "12px system-ui, 'DejaVu Sans', sans-serif";
    context.fillStyle = color("card");
    context.beginPath();
    context.roundRect(x - 8, y - 13, end - x + 26 + context.measureText(words).width, 26, 8);
    context.fill();
    context.strokeStyle = context.fillStyle = color("ink");
    context.lineWidth = 2;
    context.beginPath();
    for (const at of [x, end]) {
      context.moveTo(at, y - 5);
      context.lineTo(at, y + 5);
    }
    context.moveTo(x, y);
    context.lineTo(end, y);
    context.stroke();
    context.fillText(words, end + 9, y + 4);
  }
}

// Areas of all layers from the bottom (left) to the top, over the slider: the
// part's before those of part and supports; below, what was found from which
// layer to which, and the layers with thin places.
class Plot {
  constructor(canvas) {
    this.canvas = canvas;
    this.part = null;
  }

  draw(state) {
    const {context, width, height} = prepare(this.canvas);
    const {early} = state;
    const layers = shownLayers(this.part, state);
    const greatest = Math.max(...layers.map((layer) => layer.area), 1e-9);
    const foot = height - (this.part.found ? 13 : 3);
    const xOf = (i) => layers.length === 1 ? width / 2 :
      i / (layers.length - 1) * (width - 2) + 1;
    const yOf = (layer) => foot - layer.area / greatest * (foot - 4);
    const areas = (ofLayers, name) => {
      context.fillStyle = context.strokeStyle = color(name);
      context.lineWidth = 1.5;
      context.beginPath();
      ofLayers.forEach((layer, i) => context.lineTo(xOf(i), yOf(layer)));
      context.stroke();
      context.lineTo(xOf(layers.length - 1), foot);
      context.lineTo(xOf(0), foot);
      context.globalAlpha = .28;
      context.fill();
      context.globalAlpha = 1;
    };
    if (layers !== this.part.partLayers) areas(layers, "support");
    areas(this.part.partLayers, "solid");
    const bar = (kind, first, last, row) => {
      context.fillStyle = colorOf(kind);
      context.fillRect(xOf(first) - .8, foot + 2 + 5 * row,
          xOf(last) - xOf(first) + 1.6, 4);
    };
    for (const {kind, first, last} of findingsOf(this.part)) bar(kind, first - 1, last - 1, 0);
    layers.forEach((layer, i) => {
      for (const kind of ["gap", "wall"]) {
        if (layer.marks.some((mark) => mark.kind === kind)) bar(kind, i, i, 1);
      }
    });
    const x = xOf(early ? early.index * (layers.length - 1) / Math.max(1, early.count - 1) :
      state.index);
    const y = Math.max(4, yOf(early ? early.layer : layers[state.index]));
    context.fillStyle = color("accent");
    context.fillRect(x - 1, 0, 2, foot);
    context.beginPath();
    context.arc(x, y, 5.5, 0, 2 * Math.PI);
    context.fill();
    context.lineWidth = 2;
    context.strokeStyle = color("paper");
    context.stroke();
  }
}
