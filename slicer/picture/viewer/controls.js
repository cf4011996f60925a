// The page: what its buttons, keys and pointers do.

const kPlaySpeed = 30;       // layers per second, at most 20 s for all
const kSnapReach = 9;        // of measuring [pixels]
const kClickReach = 5;       // what moves farther is no click [pixels]
const kListedPlaces = 200;   // of a kind
const kPhone = "(max-width: 760px)";  // as in style.css

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

class Viewer {
  constructor(part) {
    this.part = part;
    this.view = new View();
    this.drawing = new Drawing(byId("drawing"), part, this.view);
    this.plot = new Plot(byId("plot"), part);
    this.solid = new Solid(byId("solid"), part);
    this.state = {
      index: 0, below: false, marks: part.found !== null, supports: part.supports !== null,
      pointer: null, ends: [],
    };
    this.describePart();
    this.listPlaces();
    this.bindSlider();
    this.bindButtons();
    this.bindKeys();
    this.bindPointers();
    this.bindOrbit();
    const resizes = new ResizeObserver(() => this.resize());
    for (const pane of document.querySelectorAll(".pane")) resizes.observe(pane);
    const asked = /layer=(\d+)/.exec(location.hash);
    this.choose(asked ? +asked[1] - 1 : this.fullestLayer());
    this.isWhole = !asked;
    const view = /view=(3d|layer)/.exec(location.hash);
    if (view) this.togglePane(view[1] === "3d" ? "section" : "orbit");
    this.fit();
  }

  // Makes the solid, which takes a while, or says why there is none.
  async openSolid() {
    try {
      await this.solid.open(() => this.draw());
      byId("working").hidden = true;
    } catch (error) {
      byId("solid").hidden = byId("working").hidden = true;
      byId("no-solid").hidden = false;
      byId("no-solid").textContent = error.message;
    }
  }

  fullestLayer() {
    const areas = this.part.partLayers.map((layer) => layer.area);
    return areas.indexOf(Math.max(...areas));
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
    byId("theme").innerHTML = kIcons.theme;
    byId("play").innerHTML = kIcons.play;
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
    if (!found) return;
    byId("marks").hidden = false;
    const list = byId("findings");
    const kinds = groupBy(found.places, ({kind}) => kind);
    const heading = make("h2", found.places.length > 0 ? "Findings" :
      found.hasPrint ? "No problems found" : `Nothing thinner than ${this.part.minFeature} mm`);
    list.append(heading);
    for (const [kind, places] of kinds) list.append(...this.listKind(kind, places));
    list.append(...found.notes.map((note) => make("p", note)));
    list.hidden = matchMedia(kPhone).matches;
    byId("marks").setAttribute("aria-pressed", !list.hidden);
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

  // In mm above the bed.
  heightText({z}) {
    return fixed(z - this.part.layers[0].bottom, 3);
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
    this.solid.turnTo(place.place);
    this.draw();
  }

  choose(index) {
    this.isWhole = false;
    this.state.index = Math.min(this.layers.length - 1, Math.max(0, Math.round(index)));
    this.describeLayer();
    this.draw();
  }

  describeLayer() {
    const {layers} = this;
    const layer = layers[this.state.index];
    const number = this.state.index + 1;
    byId("number").textContent = `${number} of ${layers.length}`;
    byId("height").textContent = `${this.heightText(layer)} mm`;
    byId("area").textContent = `${fixed(layer.area, 4)} mm²`;
    byId("loops").textContent = layer.holes === 0 ? `${layer.loops}` :
      `${layer.loops}, ${layer.holes} of them ${layer.holes === 1 ? "a hole" : "holes"}`;
    byId("perimeter").textContent = `${fixed(layer.perimeter, 3)} mm`;
    const words = `Layer ${number} of ${layers.length}, z ${this.heightText(layer)} mm above the bed, ` +
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
        this.solid.draw(this.state, this.isWhole);
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
    if (this.isFitted) this.view.show([0, 0], this.part.size, ...this.room());
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
          `${index + 1}: z ${this.heightText(layers[index])}, ${fixed(layers[index].area, 2)} mm²`;
    };
    slider.onpointerleave = () => { byId("hint").hidden = true; };
    byId("profile").onwheel = (event) => {
      event.preventDefault();
      this.leaf(event);
    };
  }

  // Goes up or down by a layer, as the wheel turns.
  leaf(event) {
    this.choose(this.state.index - Math.sign(event.deltaY || event.deltaX));
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
    const list = byId("findings");
    list.hidden = !list.hidden;
    this.state.marks = matchMedia(kPhone).matches || !list.hidden;
    byId("marks").setAttribute("aria-pressed", !list.hidden);
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
    const last = this.part.layers.length - 1;
    const speed = Math.max(kPlaySpeed, last / 20);
    const from = this.state.index === last ? 0 : this.state.index;
    const begin = performance.now();
    const step = (now) => {
      if (!this.isPlaying) return;
      this.choose(from + Math.max(0, now - begin) / 1000 * speed);
      if (this.state.index < last) requestAnimationFrame(step);
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
    const move = (layers) => this.choose(this.state.index + layers);
    const keys = {
      ArrowUp: () => move(1), ArrowRight: () => move(1),
      ArrowDown: () => move(-1), ArrowLeft: () => move(-1),
      PageUp: () => move(10), PageDown: () => move(-10),
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
      if (event.ctrlKey || event.metaKey || event.altKey) return;
      if (byId("keys").open && event.key !== "?") return;
      const act = keys[event.key.length === 1 ? event.key.toLowerCase() : event.key];
      // Space and Enter press the button that has the focus.
      if (!act || (event.key === " " && event.target.tagName === "BUTTON")) return;
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
          `x ${fixed(x + this.part.low[0], 3)}  y ${fixed(y + this.part.low[1], 3)} mm`;
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
    state.ends.push({
      index: state.index,
      place: snap(this.layers[state.index], this.view.toPart(at),
          kSnapReach / this.view.scale),
    });
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
    const {layers} = this.part;
    const [a, b] = ends;
    const dx = b.place[0] - a.place[0];
    const dy = b.place[1] - a.place[1];
    const dz = layers[b.index].z - layers[a.index].z;
    const parts = [["Δx", dx], ["Δy", dy]].concat(dz ? [["Δz", dz]] : []);
    byId("distance").innerHTML = `${fixed(Math.hypot(dx, dy, dz), 3)} mm <small> ` +
      parts.map(([name, length]) => `${name} ${fixed(length, 3)}`).join("  ") +
      "</small>";
  }
}

async function start() {
  const dark = /theme=(dark|light)/.exec(location.hash);
  document.documentElement.dataset.theme = dark ? dark[1] :
    matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light";
  try {
    window.viewer = new Viewer(await readPart());
    await window.viewer.openSolid();
    document.documentElement.dataset.ready = "true";
  } catch (error) {
    byId("fault").hidden = false;
    byId("fault").textContent = typeof DecompressionStream === "undefined" ?
      "This page needs a browser from 2023 or later." : `The page is damaged: ${error}`;
    throw error;
  }
}

start();
