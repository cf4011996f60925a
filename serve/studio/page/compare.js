// Comparison: what was kept as A beside what is shown now.
//
// A has a pane of its own, which moves with the layer's. In the layer, what only one
// of both has is drawn over the part.

class ComparedDrawing extends Drawing {
  // drawing  what draws the part otherwise
  // canvas   of A's pane
  constructor(drawing, canvas) {
    super(drawing.canvas, drawing.view, {
      draw: (sheet) => {
        if (this.kept) this.drawDifference(sheet, this.state);
        drawing.measuring.draw(sheet);
      },
    });
    this.part = drawing.part;
    this.kept = null;  // A's part
    this.beside = new Drawing(canvas, new View(), {draw: () => {}});
  }

  draw(state) {
    this.state = state;
    super.draw(state);
    if (this.kept) this.drawKept(state);
  }

  // The layer of A as high above the bed as the one in view; where there is none, one
  // without contours.
  keptLayer(state) {
    const {layer, bed} = this.layerOf(state);
    const {layers} = this.kept;
    const height = middleOf(layer, bed);
    const index = layerAt(layers, height);
    const isThere = layers[0].bottom + height < layers[layers.length - 1].top;
    return {index, isThere,
      layer: isThere ? shownLayers(this.kept, state)[index] : {contours: []}};
  }

  layerOf({early, index, supports}) {
    return early || {layer: shownLayers(this.part, {supports})[index],
      bed: this.part.layers[0].bottom};
  }

  drawKept(state) {
    const {view, beside, kept} = this;
    const {index, isThere, layer} = this.keptLayer(state);
    Object.assign(beside.view, {scale: view.scale, x: view.x, y: view.y, low: view.low});
    beside.view.countFrom(kept.low);
    beside.part = kept;
    beside.draw({...state, index, early: isThere ? null : {layer}, pointer: null});
  }

  drawDifference(sheet, state) {
    const {layer} = this.layerOf(state);
    const now = pathOf(layer);
    const shift = this.kept.low.map((value, i) => value - this.view.low[i]);
    const kept = new Path2D();
    kept.addPath(pathOf(this.keptLayer(state).layer), new DOMMatrix().translate(...shift));
    this.fillOutside(sheet, kept, now, "only-a");
    this.fillOutside(sheet, now, kept, "only-b");
    this.strokePath(sheet, {path: kept}, "only-a", [5, 3]);
    this.strokePath(sheet, layer, "outline", []);
  }

  // Fills what of a path is outside of another.
  fillOutside(sheet, path, other, name) {
    const {context} = sheet;
    const outside = new Path2D();
    outside.rect(-1e5, -1e5, 2e5, 2e5);
    outside.addPath(other);
    context.save();
    this.inPart(sheet);
    context.clip(outside, "evenodd");
    context.fillStyle = color(name);
    context.fill(path);
    context.restore();
  }
}

class Comparison {
  // shown() returns {part, report, values, settings} of what is on the page, or null;
  // captions() those of parameters by name; apply(kept) takes A's values over.
  constructor({shown, captions, apply}) {
    Object.assign(this, {shown, captions});
    this.kept = null;
    byId("keep").onclick = () => this.keep();
    byId("apply-kept").onclick = () => apply(this.kept);
    byId("end-comparison").onclick = () => this.end();
  }

  // Takes over the layer's drawing of the viewer.
  open(viewer) {
    this.viewer = viewer;
    viewer.drawing = new ComparedDrawing(viewer.drawing, byId("kept-drawing"));
    viewer.bindCanvas(byId("kept-drawing"),
        (factor, at) => viewer.zoomDrawing(factor, at),
        (from, to, hold) => {
          viewer.drag(from, to, hold);
          viewer.draw();
        });
    byId("drawing-pane").append(byId("legend"));
    byId("keep").disabled = false;
  }

  keep() {
    const wasOpen = this.kept !== null;
    this.setKept(this.shown());
    // Two layers beside each other need the room of the solid.
    if (!wasOpen && !byId("solid-pane").hidden && !byId("drawing-pane").hidden) {
      this.viewer.togglePane("orbit");
    }
    if (byId("drawing-pane").hidden) this.viewer.togglePane("section");
  }

  end() {
    this.setKept(null);
  }

  setKept(kept) {
    this.kept = kept;
    this.viewer.drawing.kept = kept && kept.part;
    byId("kept-pane").hidden = byId("legend").hidden = byId("comparison").hidden = !kept;
    byId("keep").textContent = word(kept ? "keepAgain" : "keep");
    this.show();
    this.viewer.resize();
  }

  // Lists what differs.
  show() {
    if (!this.kept || !this.shown()) return;
    const rows = differencesOf(this.kept, this.shown(), this.captions());
    byId("no-differences").hidden = rows.length > 0;
    byId("differences").hidden = rows.length === 0;
    byId("difference-rows").replaceChildren(...rows.map(([name, a, b]) => build("tr", {},
        build("th", {scope: "row", textContent: name}),
        build("td", {textContent: a}), build("td", {textContent: b}))));
  }
}

// Rows of a name and two texts that differ.
//
// captions  of parameters, by name
function differencesOf(a, b, captions) {
  const rows = [];
  const add = (name, textA, textB) => textA !== textB && rows.push([name, textA, textB]);
  for (const name of new Set([...a.values.keys(), ...b.values.keys()])) {
    add(captions.get(name) || name, a.values.get(name) ?? "", b.values.get(name) ?? "");
  }
  for (const name of Object.keys(b.settings)) {
    add(word(`${name}Setting`), textOf(a.settings[name]), textOf(b.settings[name]));
  }
  if (!a.report || !b.report) return rows;
  add(word("sizeOf"), sizeText(a.report.size), sizeText(b.report.size));
  add(word("volume"), ...[a, b].map(({report}) => word("mm3", fixed(report.volume, 2))));
  for (const {name, title, grams} of b.report.metals) {
    const before = a.report.metals.find((metal) => metal.name === name);
    add(title, before ? word("grams", gramsText(before.grams)) : "", word("grams", gramsText(grams)));
  }
  add(word("print"), a.report.estimate, b.report.estimate);
  return rows;
}
