// Measuring in the drawing: between two places, or across a wall.
//
// All places are absolute, [x, y, z] with z from the bed, so that they stay where
// they are while layers and parts change.

const kSnapReach = 9;  // [pixels]
const kSign = 5.5;     // half a sign's width [pixels]

// Before "wall" and "gap", which measure by themselves.
const kSnapWords = {
  end: "snapEnd", centre: "snapCentre", middle: "snapMiddle", edge: "snapEdge",
};

const circleWords = (circle) =>
  [word("radius", fixed(circle.radius, 3)), word("diameter", fixed(2 * circle.radius, 3))];

class Measuring {
  constructor(view) {
    this.view = view;
    this.mode = null;    // or "distance" or "wall"
    this.ends = [];      // {kind, at, circle}: two at most
    this.target = null;  // what a click would take: one end, or two
  }

  // Ends measuring where the mode is already that.
  toggle(mode) {
    this.mode = this.mode === mode ? null : mode;
    this.ends = [];
    this.target = null;
  }

  // Looks what a click would take.
  //
  // z   of the layer, above the bed
  // at  on the drawing [pixels]
  aim(layer, z, at) {
    const [x, y] = this.view.toPart(at);
    const [left, foot] = this.view.low;
    const grid = snapGridOf(layer);
    const absolute = ([px, py]) => [px + left, py + foot, z];
    if (this.mode === "wall") {
      const chord = grid.chordAt(x, y);
      const kind = chord && chord.isInside ? "wall" : "gap";
      this.target = !chord ? [] : [chord.from, chord.to].map(
          (place) => ({kind, at: absolute(place), circle: null}));
      return;
    }
    const {kind, place, circle} = grid.snap(x, y, kSnapReach / this.view.scale) ||
      {kind: "free", place: [x, y], circle: null};
    this.target = [{kind, at: absolute(place), circle: circle &&
        {center: absolute(circle.center), radius: circle.radius}}];
  }

  leave() {
    this.target = null;
  }

  // Keeps what was aimed at.
  take() {
    if (this.mode === "wall") {
      this.ends = this.target;
    } else {
      if (this.ends.length === 2) this.ends = [];
      this.ends.push(...this.target);
    }
  }

  // {value, details}: what is measured, or else what to do.
  describe() {
    const {ends} = this;
    if (ends.length < 2) {
      const toDo = this.mode === "wall" ? "clickWall" : ends.length ? "clickSecond" : "clickTwo";
      return {value: "", details: [...this.circles(), word(toDo)]};
    }
    const [dx, dy, dz] = ends[1].at.map((value, i) => value - ends[0].at[i]);
    const isLevel = Math.abs(dz) < 1e-9;
    const {kind} = ends[0];
    const length = fixed(Math.hypot(dx, dy, dz), 3);
    const details = [["Δx", dx], ["Δy", dy], ...isLevel ? [] : [["Δz", dz]]]
        .map(([name, value]) => `${name} ${fixed(value, 3)}`);
    if (Math.hypot(dx, dy) > 1e-9) {
      details.push(word("angle", fixed(Math.atan2(dy, dx) * 180 / Math.PI, 2)));
    }
    return {
      value: kind === "wall" ? word("wallIs", length) : kind === "gap" ? word("gapIs", length) :
        word("mm", length),
      details: [...details, ...this.circles()],
    };
  }

  // Of the circles that ends are of, once each.
  circles() {
    return [...new Set(this.ends.filter(({circle}) => circle)
        .map(({circle}) => circleWords(circle).join(" ")))];
  }

  // What is measured, as one line; empty where nothing is.
  get text() {
    const {value, details} = this.describe();
    return value && [value, ...details].join(", ");
  }

  // ---- Drawing

  toPage([x, y]) {
    const [left, foot] = this.view.low;
    return this.view.toPage([x - left, y - foot]);
  }

  draw({context, width, height}) {
    if (!this.mode) return;
    context.save();
    context.fillStyle = color("measure");
    this.drawLine(context, this.ends);
    for (const {at} of this.ends) {
      context.beginPath();
      context.arc(...this.toPage(at), 4.5, 0, 2 * Math.PI);
      context.fill();
    }
    if (this.target) this.drawTarget(context, width, height);
    context.restore();
  }

  drawLine(context, ends) {
    context.beginPath();
    for (const {at} of ends) context.lineTo(...this.toPage(at));
    this.strokeOnAll(context);
  }

  // Strokes what is seen on the part as on the field around it.
  strokeOnAll(context) {
    for (const [name, width] of [["field", 5], ["measure", 2]]) {
      context.strokeStyle = color(name);
      context.lineWidth = width;
      context.stroke();
    }
  }

  // A sign for what a click takes, and its name.
  drawTarget(context, width, height) {
    const {target} = this;
    if (target.length === 0) return;
    if (this.mode === "wall") {
      this.drawLine(context, target);
      const [a, b] = target.map(({at}) => at);
      const key = target[0].kind === "wall" ? "wallIs" : "gapIs";
      const middle = [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];
      this.drawWords(context, this.toPage(middle), width, height,
          word(key, fixed(Math.hypot(b[0] - a[0], b[1] - a[1]), 3)));
      return;
    }
    const [{kind, at, circle}] = target;
    const place = this.toPage(at);
    if (circle) this.drawCircle(context, circle);
    this.drawSign(context, kind, place);
    if (!(kind in kSnapWords)) return;
    this.drawWords(context, place, width, height,
        [word(kSnapWords[kind]), ...circle ? circleWords(circle) : []].join("  "));
  }

  drawCircle(context, {center, radius}) {
    const [x, y] = this.toPage(center);
    context.save();
    context.strokeStyle = color("measure");
    context.lineWidth = 1;
    context.setLineDash([5, 4]);
    context.beginPath();
    context.arc(x, y, radius * this.view.scale, 0, 2 * Math.PI);
    context.stroke();
    context.restore();
    this.drawSign(context, "free", [x, y]);
  }

  drawSign(context, kind, [x, y]) {
    const s = kSign;
    const lines = {
      end: [[-s, -s, s, -s, s, s, -s, s, -s, -s]],
      centre: [[-s, 0, s, 0], [0, -s, 0, s]],
      middle: [[-s, s, 0, -s, s, s, -s, s]],
      edge: [[-s, -s, s, -s, -s, s, s, s, -s, -s]],
      free: [[-s, 0, s, 0], [0, -s, 0, s]],
    }[kind];
    context.beginPath();
    for (const line of lines) {
      line.forEach((dx, i) => {
        if (i % 2) return;
        const to = [x + dx, y + line[i + 1]];
        if (i) context.lineTo(...to);
        else context.moveTo(...to);
      });
    }
    if (kind === "centre") {
      context.moveTo(x + s, y);
      context.arc(x, y, s, 0, 2 * Math.PI);
    }
    this.strokeOnAll(context);
  }

  // On a card beside a place, on the canvas.
  drawWords(context, [x, y], width, height, words) {
    context.font = "12px system-ui, 'DejaVu Sans', sans-serif";
    const long = context.measureText(words).width + 14;
    const left = Math.max(kRuler + 2, x + 14 + long > width ? x - 14 - long : x + 14);
    const top = Math.max(kRuler + 2, Math.min(height - 24, y + 12));
    context.fillStyle = color("field");
    context.strokeStyle = color("line");
    context.lineWidth = 1;
    context.beginPath();
    context.roundRect(left, top, long, 21, 7);
    context.fill();
    context.stroke();
    context.fillStyle = color("measure");
    context.fillText(words, left + 7, top + 15);
  }
}
