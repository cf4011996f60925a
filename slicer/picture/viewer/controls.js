// The page: what its buttons, keys and pointers do.

const kPlaySpeed = 30;       // layers per second, at most 20 s for all
const kCalmSteps = 12;       // of playing where motion is to be reduced,
const kCalmSpeed = 1;        // and how many a second
const kKeyStep = 40;         // of moving and turning by keys [pixels]
const kGripMargin = 24;      // of the grip's middle from what is beside it [pixels]
const kClickReach = 5;       // what moves farther is no click [pixels]
const kPhone = "(max-width: 760px)";  // as in style.css
const kCalm = "(prefers-reduced-motion: reduce)";

// What takes all keys by itself while it has the focus.
const kKeyTakers = "input:not(#slider), select, textarea, [contenteditable], dialog:not(#keys)";

const kArrows = {
  ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1],
};

const kIcons = {
  play: '<svg viewBox="0 0 20 20" aria-hidden="true"><path d="M5 2.5v15l12-7.5z"/></svg>',
  pause: '<svg viewBox="0 0 20 20" aria-hidden="true"><path d="M4 3h4v14H4zm8 0h4v14h-4z"/></svg>',
  grip: '<svg viewBox="0 0 20 20" aria-hidden="true"><path d="M10 1l5 6H5zm0 18l5-6H5zM3 9h14v2H3z"/></svg>',
  theme: '<svg viewBox="0 0 20 20" aria-hidden="true"><path d="M10 1a9 9 0 1 0 0 18 9 9 0 0 0 0-18zm0 16V3a7 7 0 0 1 0 14z"/></svg>',
};

const byId = (id) => document.getElementById(id);
const placeOf = (event) => [event.offsetX, event.offsetY];
const distance = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1]);

function fullestLayer({partLayers}) {
  const areas = partLayers.map((layer) => layer.area);
  return areas.indexOf(Math.max(...areas));
}

// Of the middle of a layer, above the bed.
function heightOf({layers}, index) {
  const layer = layers[Math.min(layers.length - 1, Math.max(0, index))];
  return middleOf(layer, layers[0].bottom);
}

// Shows a part, and another one after it.
//
// onChoose  called with the height above the bed of the middle of the layer that
//           the reader has chosen [mm]
class Viewer {
  // asked: {layer, view}: the number of the layer to open with, and "3d" or "layer"
  // where only one of both panes is to be open.
  constructor(part, asked = {}) {
    this.view = new View();
    this.measuring = new Measuring(this.view);
    this.drawing = new Drawing(byId("drawing"), this.view, this.measuring);
    this.plot = new Plot(byId("plot"));
    this.solid = new Solid(byId("solid"));
    this.findings = new FindingList(byId("findings"), (place) => this.visit(place));
    this.state = {
      index: 0, early: null, below: false, marks: true, supports: true, pointer: null,
    };
    this.onChoose = () => {};
    this.isListing = !matchMedia(kPhone).matches;
    this.isFitted = true;
    this.isWhole = !asked.layer;
    this.height = asked.layer ? heightOf(part, asked.layer - 1) :
      heightOf(part, fullestLayer(part));
    putWords(document);
    byId("theme").innerHTML = kIcons.theme;
    byId("play").innerHTML = kIcons.play;
    this.bindSlider();
    this.bindButtons();
    this.bindKeys();
    this.bindPointers();
    this.bindOrbit();
    this.bindGrip();
    const resizes = new ResizeObserver(() => this.resize());
    for (const pane of document.querySelectorAll(".pane")) resizes.observe(pane);
    this.setPart(part);
    if (asked.view) this.togglePane(asked.view === "3d" ? "section" : "orbit");
    this.fit();
    window.viewer = this;
  }

  // Shows another part instead. What the reader has chosen stays: the layer's height,
  // the places on the page, the solid's turn, the buttons, and the ends of a distance.
  // `opened` is fulfilled when the solid is made, with false where yet another part
  // came before.
  setPart(part) {
    this.part = this.drawing.part = this.plot.part = part;
    this.state.early = null;
    this.state.index = layerAt(part.layers, this.height);
    this.takePlace(part);
    this.describePart();
    this.listPlaces();
    this.describeLayer();
    this.opened = this.openSolid();
    this.drawLayer();
  }

  // Shows a layer of the part that comes, as readLayer() makes it.
  showLayer(early) {
    this.state.early = early;
    this.takePlace(early);
    byId("slider").max = early.count;
    this.describeLayer();
    this.drawLayer();
  }

  // Keeps absolute places where they are on the page. A drawing that was fitted stays
  // so where the size has changed, or part of it would not be seen.
  takePlace({low, size}) {
    const [width, depth] = size;
    this.view.countFrom(low);
    const isSame = this.size && this.size[0] === width && this.size[1] === depth;
    this.size = [width, depth];
    if (!(isSame && this.view.hasAll(this.size, this.room()))) this.fitView();
  }

  // Makes the solid, which takes a while, or says why there is none.
  async openSolid() {
    byId("working").hidden = false;
    let fault = "";
    try {
      if (!await this.solid.show(this.part, () => this.draw())) return false;
    } catch (error) {
      fault = error.message;
    }
    byId("working").hidden = true;
    byId("solid").hidden = fault !== "";
    byId("no-solid").hidden = fault === "";
    byId("no-solid").textContent = fault;
    return true;
  }

  // The layers as they are shown.
  get layers() {
    return shownLayers(this.part, this.state);
  }

  describePart() {
    const {title, layers, supports} = this.part;
    byId("title").textContent = title;
    byId("supports").hidden = !supports;
    for (const element of document.querySelectorAll(".of-supports")) element.hidden = !supports;
    byId("slider").max = layers.length;
    this.summarize();
  }

  summarize() {
    const {estimate, layers, size, volume, supports} = this.part;
    const [x, y, z] = size.map((length) => fixed(length, 2));
    const shown = supports && !this.state.supports ? supports.partVolume : volume;
    byId("summary").textContent = [
      word("layers", layers.length), word("size", x, y, z), word("mm3", fixed(shown, 2)),
      ...[supports && supports.text, estimate].filter((text) => text),
    ].join(" · ");
  }

  listPlaces() {
    const {found} = this.part;
    byId("marks").hidden = !found;
    byId("marks").setAttribute("aria-pressed", this.isListing);
    byId("findings").hidden = !found || !this.isListing;
    if (found) this.findings.show(this.part);
  }

  // The layer that is shown, as it is shown, its number, and how many there are.
  get inView() {
    const {early, index} = this.state;
    return early ? {layer: early.layer, number: early.index + 1, count: early.count, bed: early.bed} :
      {layer: this.layers[index], number: index + 1, count: this.layers.length, bed: this.bed};
  }

  get bed() {
    return this.part.layers[0].bottom;
  }

  // Goes to a place, and turns the solid so that it is seen.
  visit(place) {
    if (byId("drawing-pane").hidden) this.togglePane("section");
    if (matchMedia(kPhone).matches) this.toggleMarks();
    this.choose(place.layer - 1);
    const reach = Math.max(1, 6 * place.reach);
    const [x, y] = place.place;
    this.view.show([x - reach, y - reach], [x + reach, y + reach], ...this.room());
    this.isFitted = false;
    this.solid.turnTo(place.place, this.part.size);
    this.draw();
  }

  // Goes to a layer, counted from 0. The layers of a part that comes are not there
  // yet: of the part before, that at the same share of the height is shown.
  choose(index) {
    this.isWhole = false;
    const {number, count} = this.inView;
    const chosen = Math.min(count - 1, Math.max(0, Math.round(index)));
    if (chosen !== number - 1) {
      this.leaveEarly();
      const {length} = this.layers;
      this.state.index = Math.min(length - 1, Math.round(chosen * length / count));
      this.height = heightOf(this.part, this.state.index);
      this.onChoose(this.height);
    }
    this.describeLayer();
    this.draw();
  }

  leaveEarly() {
    if (!this.state.early) return;
    this.state.early = null;
    this.takePlace(this.part);
    byId("slider").max = this.part.layers.length;
  }

  describeLayer() {
    const {layer, number, count, bed} = this.inView;
    const height = fixed(layer.z - bed, 3);
    byId("number").textContent = word("numberOf", number, count);
    byId("height").textContent = word("mm", height);
    byId("area").textContent = word("mm2", fixed(layer.area, 4));
    byId("loops").textContent = layer.holes === 0 ? `${layer.loops}` :
      layer.holes === 1 ? word("loopsWithHole", layer.loops) :
        word("loopsWithHoles", layer.loops, layer.holes);
    byId("perimeter").textContent = word("mm", fixed(layer.perimeter, 3));
    const words = word("layerInWords", number, count, height, fixed(layer.area, 2));
    byId("slider").value = number;
    byId("slider").setAttribute("aria-valuetext", words);
    byId("drawing").setAttribute("aria-label", words);
  }

  // Draws all once a frame, however much has changed.
  draw() {
    this.isSolidStale = true;
    this.drawLayer();
  }

  // Draws all but the solid, which takes longest and shows none of what has changed.
  drawLayer() {
    if (this.frame) return;
    this.frame = requestAnimationFrame(() => {
      this.frame = 0;
      if (!byId("drawing-pane").hidden) {
        if (this.state.pointer) this.aim(this.state.pointer);
        this.drawing.draw(this.state);
      }
      if (this.isSolidStale && !byId("solid-pane").hidden) {
        this.isSolidStale = false;
        this.solid.draw(this.state, this.height, this.isWhole);
        this.placeGrip();
      }
      this.plot.draw(this.state);
    });
  }

  // Width and height of the layer's drawing.
  room() {
    const {clientWidth, clientHeight} = byId("drawing-pane");
    return [clientWidth, clientHeight];
  }

  fit() {
    this.solid.reset();
    this.isFitted = true;
    this.resize();
  }

  // Shows all of the layer, if that is what was asked for last.
  fitView() {
    if (this.isFitted) this.view.show([0, 0], this.size, ...this.room());
  }

  resize() {
    this.fitView();
    this.draw();
  }

  bindSlider() {
    const slider = byId("slider");
    slider.oninput = () => this.choose(slider.value - 1);
    slider.onpointermove = (event) => {
      const share = event.offsetX / slider.clientWidth;
      const {layers} = this;
      const index = Math.round(Math.min(1, Math.max(0, share)) * (layers.length - 1));
      byId("hint").hidden = false;
      byId("hint").style.left = `${Math.min(slider.clientWidth - 70,
          Math.max(70, event.offsetX))}px`;
      byId("hint").textContent =
          word("layerHint", index + 1, fixed(layers[index].z - this.bed, 3),
              fixed(layers[index].area, 2));
    };
    slider.onpointerleave = () => { byId("hint").hidden = true; };
    byId("profile").onwheel = (event) => {
      event.preventDefault();
      this.leaf(event);
    };
  }

  // Goes up or down by a layer, as the wheel turns.
  leaf(event) {
    this.move(-Math.sign(event.deltaY || event.deltaX));
  }

  move(layers) {
    this.choose(this.inView.number - 1 + layers);
  }

  toggle(name) {
    this.state[name] = !this.state[name];
    byId(name).setAttribute("aria-pressed", this.state[name]);
    this.draw();
  }

  // Without supports all is shown and measured as if there were none.
  toggleSupports() {
    this.toggle("supports");
    this.summarize();
    this.describeLayer();
  }

  // On a phone the list is a drawer over the part, which has its marks anyhow.
  toggleMarks() {
    this.isListing = !this.isListing;
    this.state.marks = matchMedia(kPhone).matches || this.isListing;
    byId("findings").hidden = !this.isListing;
    byId("marks").setAttribute("aria-pressed", this.isListing);
    this.draw();
  }

  // mode: "distance" or "wall"
  toggleMeasure(mode) {
    this.measuring.toggle(mode);
    this.showMode();
    this.draw();
  }

  showMode() {
    const {mode} = this.measuring;
    byId("measure").setAttribute("aria-pressed", mode === "distance");
    byId("thickness").setAttribute("aria-pressed", mode === "wall");
    byId("drawing").classList.toggle("measuring", mode !== null);
    this.showMeasure();
  }

  // What is measured, and what is to be said besides.
  showMeasure(...words) {
    const {mode} = this.measuring;
    byId("distance").hidden = !mode;
    if (!mode) {
      byId("distance").replaceChildren();
      return;
    }
    const {value, details} = this.measuring.describe();
    const more = [...details, ...words.length || !value ? words : [word("toCopy")]];
    byId("distance").replaceChildren(value, make("small", ` ${more.join(" · ")}`));
  }

  // Looks what a click at a place of the drawing would measure.
  aim(at) {
    if (!this.measuring.mode) return;
    const {layer, bed} = this.inView;
    this.measuring.aim(layer, layer.z - bed, at);
  }

  async copy() {
    const {text} = this.measuring;
    if (!this.measuring.mode || !text) return;
    try {
      await navigator.clipboard.writeText(text);
      this.showMeasure(word("copied"));
    } catch {
      this.showMeasure(word("notCopied"));
    }
  }

  // Shows the layer ("section") or the solid ("orbit"), or not; one of them stays.
  togglePane(name) {
    const panes = {section: byId("drawing-pane"), orbit: byId("solid-pane")};
    const other = name === "section" ? "orbit" : "section";
    panes[name].hidden = !panes[name].hidden;
    if (panes[name].hidden) panes[other].hidden = false;
    for (const [button, pane] of Object.entries(panes)) {
      byId(button).setAttribute("aria-pressed", !pane.hidden);
    }
    if (panes.section.hidden && this.measuring.mode) this.toggleMeasure(this.measuring.mode);
    for (const id of ["measure", "thickness", "below"]) byId(id).disabled = panes.section.hidden;
    this.resize();
  }

  toggleTheme() {
    const root = document.documentElement;
    root.dataset.theme = root.dataset.theme === "dark" ? "light" : "dark";
    this.draw();
  }

  play() {
    this.isPlaying = !this.isPlaying;
    byId("play").innerHTML = this.isPlaying ? kIcons.pause : kIcons.play;
    byId("play").setAttribute("aria-pressed", this.isPlaying);
    if (!this.isPlaying) return;
    this.leaveEarly();
    const last = this.part.layers.length - 1;
    const isCalm = matchMedia(kCalm).matches;
    const speed = isCalm ? last / kCalmSteps * kCalmSpeed : Math.max(kPlaySpeed, last / 20);
    const from = this.state.index === last ? 0 : this.state.index;
    const begin = performance.now();
    const step = (now) => {
      if (!this.isPlaying) return;
      const seconds = Math.max(0, now - begin) / 1000;
      this.choose(from + speed * (isCalm ? Math.floor(seconds * kCalmSpeed) / kCalmSpeed : seconds));
      if (this.inView.number < this.inView.count) requestAnimationFrame(step);
      else this.play();
    };
    requestAnimationFrame(step);
  }

  bindButtons() {
    byId("fit").onclick = () => this.fit();
    byId("measure").onclick = () => this.toggleMeasure("distance");
    byId("thickness").onclick = () => this.toggleMeasure("wall");
    byId("below").onclick = () => this.toggle("below");
    byId("supports").onclick = () => this.toggleSupports();
    byId("marks").onclick = () => this.toggleMarks();
    byId("section").onclick = () => this.togglePane("section");
    byId("orbit").onclick = () => this.togglePane("orbit");
    byId("theme").onclick = () => this.toggleTheme();
    byId("play").onclick = () => this.play();
    byId("help").onclick = () => this.toggleKeys();
    byId("keys").onclick = () => this.toggleKeys();
  }

  toggleKeys() {
    const sheet = byId("keys");
    if (sheet.open) sheet.close();
    else sheet.showModal();
  }

  bindKeys() {
    const zoom = (factor) => {
      if (byId("drawing-pane").hidden || document.activeElement === this.solid.canvas) {
        this.zoomSolid(factor);
      } else {
        this.zoomDrawing(factor, this.room().map((length) => length / 2));
      }
    };
    const keys = {
      ArrowUp: () => this.move(1), ArrowRight: () => this.move(1),
      ArrowDown: () => this.move(-1), ArrowLeft: () => this.move(-1),
      PageUp: () => this.move(10), PageDown: () => this.move(-10),
      Home: () => this.choose(0), End: () => this.choose(Infinity),
      "+": () => zoom(1.25), "=": () => zoom(1.25), "-": () => zoom(.8),
      f: () => this.fit(), 0: () => this.fit(),
      m: () => byId("drawing-pane").hidden || this.toggleMeasure("distance"),
      w: () => byId("drawing-pane").hidden || this.toggleMeasure("wall"),
      c: () => this.copy(),
      b: () => this.toggle("below"),
      u: () => this.part.supports && this.toggleSupports(),
      t: () => this.part.found && this.toggleMarks(),
      l: () => this.togglePane("section"), s: () => this.togglePane("orbit"),
      d: () => this.toggleTheme(), "?": () => this.toggleKeys(), " ": () => this.play(),
      Escape: () => this.measuring.mode && this.toggleMeasure(this.measuring.mode),
    };
    document.addEventListener("keydown", (event) => {
      if (event.defaultPrevented || event.ctrlKey || event.metaKey || event.altKey) return;
      if (byId("keys").open && event.key !== "?") return;
      if (event.target.closest(kKeyTakers)) return;
      if (this.takeArrow(event)) {
        event.preventDefault();
        return;
      }
      const act = keys[event.key.length === 1 ? event.key.toLowerCase() : event.key];
      // Space presses the button that has the focus.
      if (!act || (event.key === " " && event.target.closest("button, summary, a"))) return;
      event.preventDefault();
      act();
    });
  }

  // Moves the cross of measuring in the drawing, or with Shift the drawing or the
  // solid. Returns whether the key is one of these.
  takeArrow({key, shiftKey}) {
    const inDrawing = document.activeElement === this.drawing.canvas;
    const isMeasuring = inDrawing && this.measuring.mode;
    if (isMeasuring && key === "Enter") {
      this.click(this.cross());
      return true;
    }
    if (!(key in kArrows) || !(isMeasuring || shiftKey)) return false;
    const [dx, dy] = kArrows[key];
    if (isMeasuring) {
      const [x, y] = this.cross();
      const step = shiftKey ? 10 : 1;
      this.point([x + step * dx, y + step * dy]);
    } else if (inDrawing || byId("solid-pane").hidden) {
      this.isFitted = false;
      this.view.x -= kKeyStep * dx;
      this.view.y -= kKeyStep * dy;
    } else {
      this.solid.turn(kKeyStep * dx, kKeyStep * dy);
    }
    this.draw();
    return true;
  }

  // Where the pointer is, or the middle of the drawing.
  cross() {
    return this.state.pointer || this.room().map((length) => length / 2);
  }

  // The wheel calls zoom(factor, place), or leafs with Shift. A pointer that moves
  // while it is down calls drag(from, to, hold, event); `hold` is where another one
  // is down, if any is. Returns the pointers that are down.
  bindCanvas(canvas, zoom, drag) {
    const held = new Map();
    canvas.onwheel = (event) => {
      event.preventDefault();
      const lines = event.deltaMode === 1 ? 30 : 1;
      if (event.shiftKey) this.leaf(event);
      else zoom(Math.exp(-event.deltaY * lines * .0016), placeOf(event));
    };
    canvas.addEventListener("pointerdown", (event) => {
      canvas.setPointerCapture(event.pointerId);
      held.set(event.pointerId, placeOf(event));
    });
    canvas.addEventListener("pointermove", (event) => {
      if (!held.has(event.pointerId)) return;
      const [, hold] = [...held].find(([id]) => id !== event.pointerId) || [];
      drag(held.get(event.pointerId), placeOf(event), hold, event);
      held.set(event.pointerId, placeOf(event));
    });
    for (const end of ["pointerup", "pointercancel"]) {
      canvas.addEventListener(end, (event) => held.delete(event.pointerId));
    }
    return held;
  }

  bindPointers() {
    const {canvas} = this.drawing;
    const held = this.bindCanvas(canvas,
        (factor, at) => this.zoomDrawing(factor, at),
        (from, to, hold) => this.drag(from, to, hold));
    canvas.onpointerdown = () => {
      this.travel = 0;
      canvas.classList.add("panning");
    };
    canvas.onpointermove = (event) => this.point(placeOf(event));
    canvas.onpointerup = canvas.onpointercancel = (event) => {
      canvas.classList.remove("panning");
      if (held.size === 0 && this.travel < kClickReach && event.type === "pointerup") {
        this.click(placeOf(event));
      }
    };
    canvas.onpointerleave = () => {
      this.state.pointer = null;
      this.measuring.leave();
      byId("pointer").textContent = "";
      this.drawLayer();
    };
  }

  point(at) {
    this.state.pointer = at;
    const [x, y] = this.view.toPart(at);
    const [left, foot] = this.view.low;
    byId("pointer").textContent = word("pointer", fixed(x + left, 3), fixed(y + foot, 3));
    this.drawLayer();
  }

  zoomDrawing(factor, at) {
    this.isFitted = false;
    this.view.zoom(factor, at);
    this.drawLayer();
  }

  zoomSolid(factor) {
    this.solid.zoomed = Math.min(50, Math.max(.2, this.solid.zoomed * factor));
    this.draw();
  }

  bindOrbit() {
    const {canvas} = this.solid;
    const stretch = (from, to, hold) =>
      this.zoomSolid(Math.max(1, distance(to, hold)) / Math.max(1, distance(from, hold)));
    canvas.addEventListener("webglcontextlost", (event) => event.preventDefault());
    canvas.addEventListener("webglcontextrestored", () => {
      this.solid.forget();
      this.opened = this.openSolid();
    });
    this.bindCanvas(canvas, (factor) => this.zoomSolid(factor), (from, to, hold, event) => {
      if (hold) stretch(from, to, hold);
      else if (event.shiftKey) this.raise(from[1] - to[1]);
      else this.solid.turn(to[0] - from[0], to[1] - from[1]);
      this.draw();
    });
    canvas.ondblclick = () => this.fit();
  }

  // The grip at the edge of the section raises and lowers it.
  bindGrip() {
    const grip = byId("grip");
    grip.innerHTML = kIcons.grip;
    let from = 0;
    grip.onpointerdown = (event) => {
      grip.setPointerCapture(event.pointerId);
      from = event.clientY;
    };
    grip.onpointermove = (event) => {
      if (!grip.hasPointerCapture(event.pointerId)) return;
      this.raise(from - event.clientY);
      from = event.clientY;
    };
    grip.onpointerup = grip.onpointercancel = () => { this.raised = null; };
    this.solid.canvas.addEventListener("pointerdown", () => { this.raised = null; });
  }

  // Raises the section by so many pixels, in sum since the pointer went down.
  raise(pixels) {
    const {layers} = this.part;
    const top = layers[layers.length - 1].top - this.bed;
    this.raised ??= this.isWhole ? top : this.height;
    this.raised += pixels * this.solid.heightOfPixel();
    this.choose(layerAt(layers, Math.min(top, Math.max(0, this.raised))));
  }

  placeGrip() {
    const layer = this.part.layers[this.state.index];
    const last = this.part.layers[this.part.layers.length - 1];
    const at = this.solid.sectionEnd((this.isWhole ? last : layer).top - this.bed);
    const grip = byId("grip");
    grip.hidden = at === null;
    if (!at) return;
    const {clientWidth, clientHeight} = this.solid.canvas;
    const within = (value, length) => Math.min(length - kGripMargin, Math.max(kGripMargin, value));
    grip.style.left = `${within(at[0] + kGripMargin, clientWidth)}px`;
    grip.style.top = `${within(at[1], clientHeight)}px`;
  }

  // One pointer moves the part, two of them stretch it.
  drag(from, to, hold) {
    this.travel += distance(from, to);
    this.isFitted = this.isFitted && this.travel < kClickReach;
    if (hold) {
      this.view.zoom(distance(to, hold) / Math.max(1, distance(from, hold)), hold);
    } else {
      this.view.x += to[0] - from[0];
      this.view.y += to[1] - from[1];
    }
  }

  click(at) {
    if (!this.measuring.mode) return;
    this.aim(at);
    this.measuring.take();
    this.showMeasure(...this.measuring.target.length ? [] : [word("noWall")]);
    this.drawLayer();
  }
}

// Chooses light or dark: what is asked for, or else what the reader has.
function openTheme(asked) {
  document.documentElement.dataset.theme = asked ||
    (matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light");
}

// Opens the page that has its part within it.
async function startPage() {
  const asked = (pattern) => (pattern.exec(location.hash) || [])[1];
  const text = (id) => byId(id).textContent;
  openTheme(asked(/theme=(dark|light)/));
  try {
    const part = readPart(JSON.parse(text("facts")), await inflate(bytesOf(text("contours"))));
    const viewer = new Viewer(part,
        {layer: +asked(/layer=(\d+)/) || 0, view: asked(/view=(3d|layer)/)});
    await viewer.opened;
    document.documentElement.dataset.ready = "true";
  } catch (error) {
    byId("fault").hidden = false;
    byId("fault").textContent = typeof DecompressionStream === "undefined" ?
      word("tooOld") : word("damaged", error);
    throw error;
  }
}
