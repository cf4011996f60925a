// The page: what its buttons, keys and pointers do.

const kPlaySpeed = 30;       // layers per second, at most 20 s for all
const kSnapReach = 9;        // of measuring [pixels]
const kClickReach = 5;       // what moves farther is no click [pixels]
const kListedPlaces = 200;   // of a kind
const kPhone = "(max-width: 760px)";  // as in style.css

// What takes all keys by itself while it has the focus.
const kKeyTakers = "input:not(#slider), select, textarea, [contenteditable], dialog:not(#keys)";

const kIcons = {
  play: '<svg viewBox="0 0 20 20" aria-hidden="true"><path d="M5 2.5v15l12-7.5z"/></svg>',
  pause: '<svg viewBox="0 0 20 20" aria-hidden="true"><path d="M4 3h4v14H4zm8 0h4v14h-4z"/></svg>',
  theme: '<svg viewBox="0 0 20 20" aria-hidden="true"><path d="M10 1a9 9 0 1 0 0 18 9 9 0 0 0 0-18zm0 16V3a7 7 0 0 1 0 14z"/></svg>',
};

const byId = (id) => document.getElementById(id);
const placeOf = (event) => [event.offsetX, event.offsetY];
const distance = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1]);

// "1 island", "3 loose parts".
const counted = (count, noun) => `${count} ${noun}${count === 1 ? "" : "s"}`;

const rangeText = ({first, last}) => first === last ? `${first}` : `${first}–${last}`;

// Items by what keyOf() says of them, in the order of the first ones.
function groupBy(items, keyOf) {
  const groups = new Map();
  for (const item of items) {
    const key = keyOf(item);
    if (!groups.has(key)) groups.set(key, []);
    groups.get(key).push(item);
  }
  return groups;
}

function make(name, text = "") {
  const element = document.createElement(name);
  element.textContent = text;
  return element;
}

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
    this.drawing = new Drawing(byId("drawing"), this.view);
    this.plot = new Plot(byId("plot"));
    this.solid = new Solid(byId("solid"));
    this.state = {
      index: 0, early: null, below: false, marks: true, supports: true, pointer: null, ends: [],
    };
    this.onChoose = () => {};
    this.isListing = !matchMedia(kPhone).matches;
    this.isFitted = true;
    this.isWhole = !asked.layer;
    this.height = asked.layer ? heightOf(part, asked.layer - 1) :
      heightOf(part, fullestLayer(part));
    byId("theme").innerHTML = kIcons.theme;
    byId("play").innerHTML = kIcons.play;
    this.bindSlider();
    this.bindButtons();
    this.bindKeys();
    this.bindPointers();
    this.bindOrbit();
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
    this.draw();
  }

  // Shows a layer of the part that comes, as readLayer() makes it.
  showLayer(early) {
    this.state.early = early;
    this.takePlace(early);
    byId("slider").max = early.count;
    this.describeLayer();
    this.draw();
  }

  // Keeps absolute places where they are on the page. A drawing that was fitted stays
  // so where the size has changed, or part of it would not be seen.
  takePlace({low, size}) {
    const [width, depth] = size;
    this.view.countFrom(low);
    const isSame = this.size && this.size[0] === width && this.size[1] === depth;
    this.size = [width, depth];
    if (this.isFitted && !(isSame && this.view.hasAll(this.size, this.room()))) this.resize();
  }

  // Makes the solid, which takes a while, or says why there is none.
  async openSolid() {
    byId("working").hidden = false;
    try {
      if (!await this.solid.show(this.part, () => this.draw())) return false;
    } catch (error) {
      byId("solid").hidden = true;
      byId("no-solid").hidden = false;
      byId("no-solid").textContent = error.message;
    }
    byId("working").hidden = true;
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
      counted(layers.length, "layer"), `${x} × ${y} × ${z} mm`, `${fixed(shown, 2)} mm³`,
      ...[supports && supports.text, estimate].filter((text) => text),
    ].join(" · ");
  }

  // Lists what was found by kind, and what one line of the design made as one.
  listPlaces() {
    const {found} = this.part;
    const list = byId("findings");
    const seen = list.scrollTop;
    list.replaceChildren();
    byId("marks").hidden = !found;
    list.hidden = !found || !this.isListing;
    if (!found) return;
    const kinds = groupBy(found.places, ({kind}) => kind);
    const heading = make("h2", found.places.length > 0 ? "Findings" :
      found.hasPrint ? "No problems found" : `Nothing thinner than ${this.part.minFeature} mm`);
    list.append(heading);
    for (const [kind, places] of kinds) list.append(...this.listKind(kind, places));
    list.append(...found.notes.map((note) => make("p", note)));
    list.scrollTop = seen;
    byId("marks").setAttribute("aria-pressed", this.isListing);
  }

  listKind(kind, places) {
    const isThin = kind === "wall" || kind === "gap";
    const heading = make("h3");
    const dot = make("i");
    dot.style.background = `var(--${kind.replace(" ", "-")})`;
    heading.append(dot, counted(places.length, kind) +
        (isThin ? ` thinner than ${this.part.minFeature} mm` : ""));
    const parts = [heading];
    const listed = places.slice(0, kListedPlaces);
    for (const [origin, ofOrigin] of groupBy(listed, (place) => place.origin)) {
      const rows = make("ol");
      rows.append(...ofOrigin.map((place) => this.listPlace(place)));
      if (origin && ofOrigin.length > 1) {
        const group = make("details");
        group.append(make("summary", `${counted(ofOrigin.length, "place")}, ` +
            (isThin ? ofOrigin[0].text : `layer ${rangeText(ofOrigin[0])}`)), rows);
        parts.push(group);
      } else {
        parts.push(rows);
      }
      if (origin) parts.push(make("em", origin));
    }
    if (listed.length < places.length) {
      parts.push(make("p", `Only the first ${kListedPlaces} are listed.`));
    }
    return parts;
  }

  listPlace(place) {
    const item = make("li");
    const button = make("button");
    button.append(make("span", place.text), make("small", `layer ${rangeText(place)}`));
    button.onclick = () => this.visit(place);
    item.append(button);
    return item;
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
    byId("number").textContent = `${number} of ${count}`;
    byId("height").textContent = `${height} mm`;
    byId("area").textContent = `${fixed(layer.area, 4)} mm²`;
    byId("loops").textContent = layer.holes === 0 ? `${layer.loops}` :
      `${layer.loops}, ${layer.holes} of them ${layer.holes === 1 ? "a hole" : "holes"}`;
    byId("perimeter").textContent = `${fixed(layer.perimeter, 3)} mm`;
    const words = `Layer ${number} of ${count}, z ${height} mm above the bed, ` +
      `area ${fixed(layer.area, 2)} mm²`;
    byId("slider").value = number;
    byId("slider").setAttribute("aria-valuetext", words);
    byId("drawing").setAttribute("aria-label", words);
  }

  // Draws once a frame, however much has changed.
  draw() {
    if (this.frame) return;
    this.frame = requestAnimationFrame(() => {
      this.frame = 0;
      if (!byId("drawing-pane").hidden) this.drawing.draw(this.state);
      if (!byId("solid-pane").hidden) {
        this.solid.draw(this.state, this.height, this.isWhole);
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

  resize() {
    if (this.isFitted) this.view.show([0, 0], this.size, ...this.room());
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
          `${index + 1}: z ${fixed(layers[index].z - this.bed, 3)}, ${fixed(layers[index].area, 2)} mm²`;
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

  toggleMeasure() {
    this.isMeasuring = !this.isMeasuring;
    byId("measure").setAttribute("aria-pressed", this.isMeasuring);
    byId("drawing").classList.toggle("measuring", this.isMeasuring);
    this.state.ends = [];
    this.tellDistance();
    this.draw();
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
    if (panes.section.hidden && this.isMeasuring) this.toggleMeasure();
    byId("measure").disabled = byId("below").disabled = panes.section.hidden;
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
    const speed = Math.max(kPlaySpeed, last / 20);
    const from = this.state.index === last ? 0 : this.state.index;
    const begin = performance.now();
    const step = (now) => {
      if (!this.isPlaying) return;
      this.choose(from + Math.max(0, now - begin) / 1000 * speed);
      if (this.inView.number < this.inView.count) requestAnimationFrame(step);
      else this.play();
    };
    requestAnimationFrame(step);
  }

  bindButtons() {
    byId("fit").onclick = () => this.fit();
    byId("measure").onclick = () => this.toggleMeasure();
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
      m: () => byId("drawing-pane").hidden || this.toggleMeasure(),
      b: () => this.toggle("below"),
      u: () => this.part.supports && this.toggleSupports(),
      t: () => this.part.found && this.toggleMarks(),
      l: () => this.togglePane("section"), s: () => this.togglePane("orbit"),
      d: () => this.toggleTheme(), "?": () => this.toggleKeys(), " ": () => this.play(),
      Escape: () => this.isMeasuring && this.toggleMeasure(),
    };
    document.addEventListener("keydown", (event) => {
      if (event.defaultPrevented || event.ctrlKey || event.metaKey || event.altKey) return;
      if (byId("keys").open && event.key !== "?") return;
      if (event.target.closest(kKeyTakers)) return;
      const act = keys[event.key.length === 1 ? event.key.toLowerCase() : event.key];
      // Space presses the button that has the focus.
      if (!act || (event.key === " " && event.target.closest("button, summary, a"))) return;
      event.preventDefault();
      act();
    });
  }

  // The wheel calls zoom(factor, place), or leafs with Shift. A pointer that moves
  // while it is down calls drag(from, to, hold); `hold` is where another one is
  // down, if any is. Returns the pointers that are down.
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
      drag(held.get(event.pointerId), placeOf(event), hold);
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
    canvas.onpointermove = (event) => {
      this.state.pointer = placeOf(event);
      const [x, y] = this.view.toPart(this.state.pointer);
      byId("pointer").textContent =
          `x ${fixed(x + this.view.low[0], 3)}  y ${fixed(y + this.view.low[1], 3)} mm`;
      this.draw();
    };
    canvas.onpointerup = canvas.onpointercancel = (event) => {
      canvas.classList.remove("panning");
      if (held.size === 0 && this.travel < kClickReach && event.type === "pointerup") {
        this.click(placeOf(event));
      }
    };
    canvas.onpointerleave = () => {
      this.state.pointer = null;
      byId("pointer").textContent = "";
      this.draw();
    };
  }

  zoomDrawing(factor, at) {
    this.isFitted = false;
    this.view.zoom(factor, at);
    this.draw();
  }

  zoomSolid(factor) {
    this.solid.zoomed = Math.min(50, Math.max(.2, this.solid.zoomed * factor));
    this.draw();
  }

  bindOrbit() {
    const {canvas} = this.solid;
    const stretch = (from, to, hold) =>
      this.zoomSolid(Math.max(1, distance(to, hold)) / Math.max(1, distance(from, hold)));
    this.bindCanvas(canvas, (factor) => this.zoomSolid(factor), (from, to, hold) => {
      if (hold) stretch(from, to, hold);
      else this.solid.turn(to[0] - from[0], to[1] - from[1]);
      this.draw();
    });
    canvas.ondblclick = () => this.fit();
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
    if (!this.isMeasuring) return;
    const {state} = this;
    if (state.ends.length === 2) state.ends = [];
    const {layer, bed} = this.inView;
    const [x, y] = snap(layer, this.view.toPart(at), kSnapReach / this.view.scale);
    state.ends.push([x + this.view.low[0], y + this.view.low[1], layer.z - bed]);
    this.tellDistance();
    this.draw();
  }

  tellDistance() {
    const {ends} = this.state;
    byId("distance").hidden = !this.isMeasuring;
    if (ends.length < 2) {
      byId("distance").innerHTML = ends.length === 0 ?
        "<small>Click two points; clicks snap to corners and edges</small>" :
        "<small>Click the second point, in this layer or another</small>";
      return;
    }
    const [dx, dy, dz] = ends[1].map((value, i) => value - ends[0][i]);
    const parts = [["Δx", dx], ["Δy", dy]].concat(Math.abs(dz) > 1e-9 ? [["Δz", dz]] : []);
    byId("distance").innerHTML = `${fixed(Math.hypot(dx, dy, dz), 3)} mm <small> ` +
      parts.map(([name, length]) => `${name} ${fixed(length, 3)}`).join("  ") +
      "</small>";
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
      "This page needs a browser from 2023 or later." : `The page is damaged: ${error}`;
    throw error;
  }
}
