// Pavé band: forty brilliants in three rows, each held by beads, between two
// ropes of twisted wire.
//
// For the tests of `check`: beads beside bearings make many small places, the
// ropes begin in mid-air in each of their turns.

use <../../examples/lib/jewelry.scad>

ring_size = 54;
stone = 1.3;    // diameter [mm]
gap = 0.25;     // between neighbours of a row
bead = 0.42;    // four for each stone, shared with its neighbours
wall = 1.5;     // of the band
wire = 0.7;     // of the ropes, two strands each
// "side" on the bed, or "up" on its shank
lies = "side";

$fa = 6;
$fs = 0.1;

diameter = ring_diameter(ring_size);
girdle = diameter / 2 + wall - 0.15;
step = 2 * asin((stone + gap) / 2 / girdle);  // between stones of a row
across = 0.88 * (stone + gap);                // between rows
stones = [for (row = [-1 : 1], i = [0 : row == 0 ? 13 : 12])
            [(i - (row == 0 ? 6.5 : 6)) * step, row * across]];
width = 2 * across + stone + 0.5;
rope = width / 2 + 0.25 * wire;

assert(len(stones) == 40);

module at(place, radius = girdle) {
  on_ring(radius, 90 + place[0], place[1]) children();
}

// Four beads round a stone: in the gaps to the neighbours of its row and
// of the next ones.
module beads(place) {
  r = (stone + bead) / 2 - 0.08;
  for (turn = [45 : 90 : 315])
    at([place[0] + atan(r * cos(turn) / girdle), place[1] + r * sin(turn)])
      grain(bead, height = 0.1, sunk = 0.5);
}

module strand(phase, z) {
  turns = 44;
  steps = turns * 12;
  r = diameter / 2 + wall - 0.45 * wire;
  wire_loop([for (i = [0 : steps - 1])
    let (a = 360 * i / steps, t = turns * a + phase, q = r + 0.3 * wire * cos(t))
    [q * cos(a), q * sin(a), z + 0.3 * wire * sin(t)]], 0.62 * wire);
}

module ring() {
  difference() {
    union() {
      band(diameter, shank_profile(width, wall, 0.15, 0.12));
      for (place = stones) beads(place);
    }
    for (place = stones)
      at(place)
        seat_cutter(stone, bite = 0.06, above = 1, hole = 0.5, below = 3);
  }
  for (side = [-1, 1], phase = [0, 180]) strand(phase, side * rope);
}

if (lies == "up") translate([0, 0, diameter / 2 + wall]) stand_up() ring();
else translate([0, 0, rope + 0.6 * wire]) ring();
