// All that a reader of the page reads, but for what the program says of the part.
// To translate the page is to write this table anew.
//
// {0}, {1}, … are values; an entry with two forms takes that of its first value.

const kWords = {
  view: "View",
  fit: "Fit",
  fitTitle: "Show the whole part (F)",
  measure: "Measure",
  measureTitle: "Measure: click two points (M)",
  thickness: "Wall",
  thicknessTitle: "Thickness of the wall or gap under the pointer (W)",
  below: "Below",
  belowTitle: "Outline of the layer below (B)",
  section: "Layer",
  sectionTitle: "Show the layer (L)",
  orbit: "3D",
  orbitTitle: "Show the solid; drag to turn it (S)",
  supports: "Supports",
  supportsTitle: "Show supports (U)",
  marks: "Findings",
  marksTitle: "List and mark the findings (T)",
  theme: "Light or dark",
  themeTitle: "Light or dark (D)",
  help: "Keyboard shortcuts",
  helpTitle: "Keyboard shortcuts (?)",
  close: "Close",

  solid: "The part as a solid",
  working: "Drawing the solid …",
  noSolid: "The solid needs WebGL 2: this browser has no WebGL 2, or it is turned off.",
  grip: "Drag to raise or lower the section",
  drawing: "Section of the layer",
  findings: "Findings",
  play: "Play",
  playTitle: "Play (space)",

  layer: "Layer",
  height: "z above bed",
  area: "Area",
  loops: "Loops",
  perimeter: "Perimeter",
  numberOf: "{0} of {1}",
  mm: "{0} mm",
  mm2: "{0} mm²",
  mm3: "{0} mm³",
  micrometres: "{0} µm",
  loopsWithHoles: "{0}, {1} of them holes",
  loopsWithHole: "{0}, 1 of them a hole",
  layerInWords: "Layer {0} of {1}, z {2} mm above the bed, area {3} mm²",
  layerHint: "{0}: z {1}, {2} mm²",
  pointer: "x {0}  y {1} mm",
  layers: {one: "{0} layer", other: "{0} layers"},
  size: "{0} × {1} × {2} mm",

  noProblems: "No problems found",
  nothingThinner: "Nothing thinner than {0} mm",
  thinnerThan: "{0} thinner than {1} mm",
  places: {one: "{0} place", other: "{0} places"},
  placesOf: "{0}, {1}",
  ofLayer: "layer {0}",
  firstListed: "Only the first {0} are listed.",
  wall: {one: "{0} wall", other: "{0} walls"},
  gap: {one: "{0} gap", other: "{0} gaps"},
  island: {one: "{0} island", other: "{0} islands"},
  "loose part": {one: "{0} loose part", other: "{0} loose parts"},
  overhang: {one: "{0} overhang", other: "{0} overhangs"},
  "suction cup": {one: "{0} suction cup", other: "{0} suction cups"},
  "resin trap": {one: "{0} resin trap", other: "{0} resin traps"},

  clickTwo: "Click two points; clicks snap to ends, centres, middles and edges",
  clickSecond: "Click the second point, in this layer or another",
  clickWall: "Point at a wall or a gap; click to keep its thickness",
  noWall: "No wall and no gap here",
  snapEnd: "end",
  snapCentre: "centre",
  snapMiddle: "middle",
  snapEdge: "edge",
  wallIs: "wall {0} mm",
  gapIs: "gap {0} mm",
  radius: "R {0}",
  diameter: "⌀ {0}",
  angle: "∠ {0}°",
  toCopy: "C copies",
  copied: "Copied",
  notCopied: "The browser does not let the page copy",

  keyOne: "one layer up or down",
  keyTen: "ten layers up or down",
  keyEnds: "first or last layer",
  keyPlay: "play or pause",
  keyZoom: "zoom",
  keyMove: "turn the solid, or move the layer that has the focus",
  keyFit: "show the whole part",
  keyPanes: "show or hide the layer, the solid",
  keyMeasure: "measure between two clicks; Escape ends this",
  keyWall: "thickness of the wall under the pointer",
  keyCross: "in the layer, while measuring: move the cross, click there",
  keyCopy: "copy what is measured",
  keyBelow: "show or hide the outline of the layer below",
  keySupports: "show or hide supports",
  keyMarks: "show or hide the findings",
  keyTheme: "switch between light and dark",
  keyHelp: "show or hide this list; Escape hides it",
  keyWheel: "zoom; with Shift, change the layer",
  keyDrag: "move the layer or turn the solid; with Shift, raise or lower the section",

  space: "Space",
  pages: "Page Up, Page Down",
  homeEnd: "Home, End",
  shiftArrows: "Shift with ← → ↑ ↓",
  arrowsEnter: "← → ↑ ↓, Enter",
  wheel: "Wheel",
  drag: "Drag",

  tooOld: "This page needs a browser from 2023 or later.",
  damaged: "The page is damaged: {0}",
};

function word(key, ...values) {
  const entry = kWords[key];
  const text = typeof entry === "string" ? entry : entry[values[0] === 1 ? "one" : "other"];
  return text.replace(/\{(\d)\}/g, (_, i) => values[i]);
}

// "3 loose parts", of a kind of place.
const countOf = (count, kind) => kind in kWords ? word(kind, count) : `${count} ${kind}`;

// Puts the words where the page has a name for them: data-word for the text,
// data-word-title and data-word-label for those of an element.
function putWords(root) {
  for (const element of root.querySelectorAll("[data-word], [data-word-title], [data-word-label]")) {
    const {word: text, wordTitle: title, wordLabel: label} = element.dataset;
    if (text) element.textContent = word(text);
    if (title) element.title = word(title);
    if (label) element.setAttribute("aria-label", word(label));
  }
}
