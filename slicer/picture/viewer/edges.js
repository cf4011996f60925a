// The edges of loops, and which of them are where.

// Edges of loops, as ax, ay, bx, by, …
function edgesOf(contours) {
  const edges = new Float64Array(contours.reduce((sum, loop) => sum + 2 * loop.length, 0));
  let end = 0;
  for (const loop of contours) {
    for (let i = 0; i < loop.length; i += 2) {
      const j = i + 2 < loop.length ? i + 2 : 0;
      edges[end++] = loop[i];
      edges[end++] = loop[i + 1];
      edges[end++] = loop[j];
      edges[end++] = loop[j + 1];
    }
  }
  return edges;
}

// A grid of cells, which has the edges that touch each cell. An edge is known by
// the place of its numbers in `edges`.
class EdgeGrid {
  // cellFor(width, height, count) returns the side of a cell for that many edges
  // in a box.
  constructor(contours, cellFor) {
    this.edges = edgesOf(contours);
    const {edges} = this;
    const [low, high] = [[Infinity, Infinity], [-Infinity, -Infinity]];
    for (let i = 0; i < edges.length; ++i) {
      low[i % 2] = Math.min(low[i % 2], edges[i]);
      high[i % 2] = Math.max(high[i % 2], edges[i]);
    }
    [this.left, this.low] = low;
    const [width, height] = edges.length ? [high[0] - low[0], high[1] - low[1]] : [0, 0];
    this.cell = cellFor(width, height, edges.length / 4);
    this.columns = Math.floor(width / this.cell) + 1;
    this.rows = edges.length ? Math.floor(height / this.cell) + 1 : 0;
    this.fillCells();
  }

  // Calls visit(cell, edge) for the cells that edges touch.
  forCells(visit) {
    const {edges, cell, columns, rows} = this;
    const inRange = (value, count) => Math.min(count - 1, Math.max(0, Math.floor(value)));
    for (let i = 0; i < edges.length; i += 4) {
      const ax = (edges[i] - this.left) / cell;
      const ay = (edges[i + 1] - this.low) / cell;
      const bx = (edges[i + 2] - this.left) / cell;
      const by = (edges[i + 3] - this.low) / cell;
      const first = inRange(Math.min(ay, by), rows);
      const last = inRange(Math.max(ay, by), rows);
      for (let row = first; row <= last; ++row) {
        let [from, to] = [ax, bx];
        if (first < last) {
          const run = (bx - ax) / (by - ay);
          const at = (y) => ax + run * (Math.min(Math.max(ay, by), Math.max(Math.min(ay, by), y)) - ay);
          [from, to] = [at(row), at(row + 1)];
        }
        const end = inRange(Math.max(from, to), columns);
        for (let column = inRange(Math.min(from, to), columns); column <= end; ++column) {
          visit(row * columns + column, i);
        }
      }
    }
  }

  // The edges of cell c are listed from begins[c] to begins[c + 1].
  fillCells() {
    const begins = new Int32Array(this.rows * this.columns + 1);
    this.forCells((cell) => ++begins[cell]);
    for (let i = 1; i < begins.length; ++i) begins[i] += begins[i - 1];
    this.listed = new Int32Array(begins[begins.length - 1]);
    this.forCells((cell, edge) => { this.listed[--begins[cell]] = edge; });
    this.begins = begins;
  }
}
