// What lies at a place of a layer: its corners, the middles of its edges, the
// circles that its corners lie on, and how thick its walls are. All of it is taken
// from the contours as they are printed, so it is exact but for the circles, which
// are fitted.

const kArcCorners = 6;       // at least, of a circle
const kArcError = .003;      // of corners from their circle [mm]
const kArcSweep = Math.PI / 3;  // at least, of a circle
const kArcChord = 1.01;      // at most, of its radius: hexagons count
const kArcUneven = 2.5;      // longest chord of a circle to the mean of all
const kDirections = 180;     // in which chords are looked for
const kRefined = 4;          // of the best of these
const kRefinements = 40;     // of each; halves what is left more than 25 times
const kGolden = (Math.sqrt(5) - 1) / 2;

// `count` corners of a loop from the corner `first` on, around its end where need be.
class Run {
  constructor(loop, first, count) {
    this.loop = loop;
    this.first = first;
    this.count = count;
  }

  // Calls visit(x, y) with places from the first one; returns whether all of them
  // did not return false.
  every(visit) {
    const {loop} = this;
    let i = 2 * this.first % loop.length;
    const [x0, y0] = [loop[i], loop[i + 1]];
    for (let k = 0; k < this.count; ++k) {
      if (visit(loop[i] - x0, loop[i + 1] - y0) === false) return false;
      i += 2;
      if (i === loop.length) i = 0;
    }
    return true;
  }

  // The nearest circle (Kåsa 1976), from the first corner: {x, y, radius}, or null for
  // corners on a line.
  fit() {
    const {count} = this;
    let [sx, sy, sxx, sxy, syy, sxr, syr, sr] = [0, 0, 0, 0, 0, 0, 0, 0];
    this.every((x, y) => {
      const square = x * x + y * y;
      sx += x; sy += y;
      sxx += x * x; sxy += x * y; syy += y * y;
      sxr += x * square; syr += y * square; sr += square;
    });
    const [a, b, c] = [sxx - sx * sx / count, sxy - sx * sy / count, syy - sy * sy / count];
    const [p, q] = [(sxr - sx * sr / count) / 2, (syr - sy * sr / count) / 2];
    const determinant = a * c - b * b;
    if (!(determinant > 1e-12 * (a + c) ** 2)) return null;
    const x = (p * c - q * b) / determinant;
    const y = (q * a - p * b) / determinant;
    return {x, y, radius: Math.sqrt(x * x + y * y + (sr - 2 * x * sx - 2 * y * sy) / count)};
  }

  // The circle that all corners lie on, in even steps one way around, or null.
  circle() {
    const circle = this.fit();
    if (!circle) return null;
    const {x: cx, y: cy, radius} = circle;
    let [bx, by, turn, longest, sum] = [0, 0, 0, 0, 0];
    const isOne = this.every((x, y) => {
      const [dx, dy] = [x - cx, y - cy];
      if (Math.abs(Math.sqrt(dx * dx + dy * dy) - radius) > kArcError) return false;
      if (bx === 0 && by === 0) {  // the first corner
        [bx, by] = [dx, dy];
        return true;
      }
      const cross = bx * dy - by * dx;
      if (!(cross * (turn ||= Math.sign(cross)) > 0)) return false;
      const chord = Math.sqrt((dx - bx) ** 2 + (dy - by) ** 2);
      longest = Math.max(longest, chord);
      sum += chord;
      [bx, by] = [dx, dy];
      return true;
    });
    const isEven = longest <= kArcUneven * sum / (this.count - 1);
    return isOne && isEven && longest <= kArcChord * radius ? circle : null;
  }

  // {center, radius, sweep, first, count}
  arcOn({x: cx, y: cy, radius}) {
    let [sweep, bx, by] = [0, -cx, -cy];
    this.every((x, y) => {
      const [dx, dy] = [x - cx, y - cy];
      sweep += Math.abs(Math.atan2(bx * dy - by * dx, bx * dx + by * dy));
      [bx, by] = [dx, dy];
    });
    const center = [this.loop[2 * this.first] + cx, this.loop[2 * this.first + 1] + cy];
    return {center, radius, sweep, first: this.first, count: this.count};
  }
}

// The circles of a loop, each of a run of its corners.
function arcsOf(loop) {
  const corners = loop.length / 2;
  if (corners < kArcCorners) return [];
  // The whole loop, with the step that closes it.
  const whole = new Run(loop, 0, corners + 1).circle();
  if (whole) return [new Run(loop, 0, corners).arcOn(whole)];
  const begin = afterLongestEdge(loop);
  const arcs = [];
  for (let i = 0; i + kArcCorners <= corners;) {
    const run = longestRun(loop, (begin + i) % corners, corners - i);
    const arc = run && run.arcOn(run.circle());
    if (arc && arc.sweep >= kArcSweep) {
      arcs.push(arc);
      i += arc.count - 1;
    } else {
      i += run ? Math.max(1, run.count >> 1) : 1;
    }
  }
  return arcs;
}

// The longest run from a corner on that lies on a circle, `most` corners at most; null
// where there is none. Its length is doubled while it does, and then grows by smaller
// and smaller powers of two.
function longestRun(loop, first, most) {
  const runOf = (count) => {
    const run = new Run(loop, first, count);
    return count <= most && run.circle() ? run : null;
  };
  let best = runOf(kArcCorners);
  if (!best) return null;
  for (let run = best; run; run = runOf(2 * best.count)) best = run;
  for (let step = 2 ** Math.ceil(Math.log2(best.count)); step >= 1; step /= 2) {
    best = runOf(best.count + step) || best;
  }
  return best;
}

function afterLongestEdge(loop) {
  let [longest, corner] = [0, 0];
  for (let i = 0; i < loop.length; i += 2) {
    const j = (i + 2) % loop.length;
    const length = (loop[j] - loop[i]) ** 2 + (loop[j + 1] - loop[i + 1]) ** 2;
    if (length > longest) [longest, corner] = [length, j / 2];
  }
  return corner;
}

class SnapGrid extends EdgeGrid {
  constructor(contours) {
    super(contours, (width, height, count) => Math.max(
        Math.sqrt(width * height / count) || 0, Math.max(width, height) / 1000, 1e-6));
    this.findArcs(contours);
  }

  // arcOf[k] is the circle that edge k is a chord of, or null.
  findArcs(contours) {
    this.arcs = [];
    this.arcOf = new Array(this.edges.length / 4).fill(null);
    let begin = 0;
    for (const loop of contours) {
      const corners = loop.length / 2;
      for (const arc of arcsOf(loop)) {
        this.arcs.push(arc);
        const chords = arc.count === corners ? corners : arc.count - 1;
        for (let i = 0; i < chords; ++i) this.arcOf[begin + (arc.first + i) % corners] = arc;
      }
      begin += corners;
    }
  }

  // What a place snaps to within `reach`: the nearest end, or else centre, middle or
  // point of an edge; null where nothing is near. {kind, place, circle}; the circle is
  // that which it is of, or null.
  snap(x, y, reach) {
    const square = reach * reach;
    const best = {end: square, centre: square, middle: square, edge: square};
    const found = {};
    const offer = (kind, px, py, circle) => {
      const away = (px - x) ** 2 + (py - y) ** 2;
      if (away >= best[kind]) return;
      best[kind] = away;
      found[kind] = {kind, place: [px, py], circle};
    };
    this.forEdgesNear(x, y, reach, (edge) => {
      const {edges} = this;
      const [ax, ay, bx, by] = [edges[edge], edges[edge + 1], edges[edge + 2], edges[edge + 3]];
      const arc = this.arcOf[edge / 4];
      offer("end", ax, ay, arc);
      offer("end", bx, by, arc);
      const length = (bx - ax) ** 2 + (by - ay) ** 2;
      if (length === 0) return;
      if (!arc && length > 16 * square) offer("middle", (ax + bx) / 2, (ay + by) / 2, null);
      const t = Math.min(1, Math.max(0, ((x - ax) * (bx - ax) + (y - ay) * (by - ay)) / length));
      offer("edge", ax + t * (bx - ax), ay + t * (by - ay), arc);
    });
    for (const arc of this.arcs) offer("centre", ...arc.center, arc);
    return found.end || found.centre || found.middle || found.edge || null;
  }

  // Calls visit(edge) for all edges that come nearer than `reach`, and for others.
  forEdgesNear(x, y, reach, visit) {
    const {cell, columns, rows, begins, listed} = this;
    const cellAt = (value, count) => Math.min(count, Math.max(-1, Math.floor(value / cell)));
    const last = Math.min(columns - 1, cellAt(x + reach - this.left, columns));
    const top = Math.min(rows - 1, cellAt(y + reach - this.low, rows));
    for (let row = Math.max(0, cellAt(y - reach - this.low, rows)); row <= top; ++row) {
      for (let column = Math.max(0, cellAt(x - reach - this.left, columns)); column <= last; ++column) {
        const at = row * columns + column;
        for (let i = begins[at]; i < begins[at + 1]; ++i) visit(listed[i]);
      }
    }
  }

  // The shortest chord through a place, from edge to edge: {from, to, length,
  // isInside}; null where the place is beside the layer, or on an edge. Chords are
  // looked for in many directions, and the shortest ones turned until they are
  // shortest; each is a true one, however narrow the one that was missed.
  chordAt(x, y) {
    const lengthAt = (angle) => {
      const [dx, dy] = [Math.cos(angle), Math.sin(angle)];
      const ahead = this.cast(x, y, dx, dy);
      return ahead === Infinity ? Infinity : ahead + this.cast(x, y, -dx, -dy);
    };
    const step = Math.PI / kDirections;
    const lengths = Array.from({length: kDirections}, (_, i) => lengthAt(i * step));
    const lengthOf = (i) => lengths[(i + kDirections) % kDirections];
    const seeds = lengths.map((_, i) => i)
        .filter((i) => lengths[i] < Infinity &&
          lengths[i] <= lengthOf(i - 1) && lengths[i] <= lengthOf(i + 1))
        .sort((a, b) => lengths[a] - lengths[b]).slice(0, kRefined);
    let best = {length: Infinity, angle: 0};
    for (const seed of seeds) {
      const turned = leastOf(lengthAt, (seed - 1) * step, (seed + 1) * step);
      for (const angle of [turned, seed * step]) {
        const length = lengthAt(angle);
        if (length < best.length) best = {length, angle};
      }
    }
    if (best.length === Infinity) return null;
    const [dx, dy] = [Math.cos(best.angle), Math.sin(best.angle)];
    const back = this.cast(x, y, -dx, -dy);
    const ahead = this.cast(x, y, dx, dy);
    return {from: [x - back * dx, y - back * dy], to: [x + ahead * dx, y + ahead * dy],
      length: best.length, isInside: this.isInside};
  }

  // How far the first edge is from a place in a direction of length 1; Infinity where
  // none is. isInside says whether material is before that edge.
  cast(x, y, dx, dy) {
    const {cell, columns, rows, left, low} = this;
    // Where the ray is in the grid's box.
    let [enter, leave] = [0, Infinity];
    const cut = (from, way, least, greatest) => {
      if (way === 0) {
        if (from < least || from > greatest) leave = -1;
        return;
      }
      const [a, b] = [(least - from) / way, (greatest - from) / way];
      enter = Math.max(enter, Math.min(a, b));
      leave = Math.min(leave, Math.max(a, b));
    };
    cut(x, dx, left, left + columns * cell);
    cut(y, dy, low, low + rows * cell);
    if (rows === 0 || enter > leave) return Infinity;
    // Go from cell to cell.
    const begin = (from, way, least, count) =>
      Math.min(count - 1, Math.max(0, Math.floor((from + way * enter - least) / cell)));
    let column = begin(x, dx, left, columns);
    let row = begin(y, dy, low, rows);
    const exit = (from, way, least, at) =>
      way === 0 ? Infinity : (least + (at + (way > 0 ? 1 : 0)) * cell - from) / way;
    this.first = Infinity;
    while (column >= 0 && column < columns && row >= 0 && row < rows) {
      this.castAtCell(row * columns + column, x, y, dx, dy);
      const [toX, toY] = [exit(x, dx, left, column), exit(y, dy, low, row)];
      if (this.first <= Math.min(toX, toY)) break;
      if (toX < toY) column += dx > 0 ? 1 : -1;
      else row += dy > 0 ? 1 : -1;
    }
    return this.first;
  }

  // Keeps the first edge of a cell that a ray meets. A corner belongs to the edge on
  // one side of the ray, so that no ray goes through between two edges.
  castAtCell(at, x, y, dx, dy) {
    const {edges, listed} = this;
    const end = this.begins[at + 1];
    for (let i = this.begins[at]; i < end; ++i) {
      const edge = listed[i];
      const ax = edges[edge] - x;
      const ay = edges[edge + 1] - y;
      const bx = edges[edge + 2] - x;
      const by = edges[edge + 3] - y;
      const a = dx * ay - dy * ax;
      const b = dx * by - dy * bx;
      if (a > 0 === b > 0) continue;
      const u = a / (a - b);
      const away = dx * (ax + u * (bx - ax)) + dy * (ay + u * (by - ay));
      if (away <= 0 || away >= this.first) continue;
      this.first = away;
      this.isInside = b > a;
    }
  }
}

// Where a function of one valley is least, by golden sections.
function leastOf(valueAt, low, high) {
  let [a, b] = [high - kGolden * (high - low), low + kGolden * (high - low)];
  let [atA, atB] = [valueAt(a), valueAt(b)];
  for (let i = 0; i < kRefinements; ++i) {
    if (atA < atB) {
      [high, b, atB] = [b, a, atA];
      a = high - kGolden * (high - low);
      atA = valueAt(a);
    } else {
      [low, a, atA] = [a, b, atB];
      b = low + kGolden * (high - low);
      atB = valueAt(b);
    }
  }
  return (low + high) / 2;
}

// Of a layer, made when it is first asked for.
function snapGridOf(layer) {
  layer.grid ||= new SnapGrid(layer.contours);
  return layer.grid;
}
