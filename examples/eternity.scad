// Eternity band: round brilliants all the way round in scalloped cups, every
// two neighbours holding hands by a pair of shared prongs.
//
//   lamina examples/eternity.scad -o eternity.slc --layer 0.025
//   lamina examples/eternity.scad -D ring_size=6.5 -D 'size_system="US"' -D stone=1.7
//
// The number of stones follows from the ring size: as many as fit with at
// least `gap` between them; what is left over widens the gaps. Lies on its side.

use <lib/jewelry.scad>

/* [Size] */
ring_size = 54;
size_system = "ISO"; // [ISO, EU, US, UK, CH, JP, mm]

/* [Stones] */
// diameter of the stones [mm]
stone = 2.3; // [1.2 : 0.05 : 4]
// least distance between two stones [mm]
gap = 0.2; // [0.1 : 0.05 : 0.5]
// show the stones (never printed)
show_stones = false;

/* [Band] */
// thickness of the sleeve on the finger [mm]
sleeve = 1; // [0.8 : 0.05 : 2]
// metal beside the stones, on each side [mm]
edge = 0.35; // [0.1 : 0.05 : 1]

/* [Prongs] */
prong_wire = 0.8; // [0.7 : 0.05 : 1.2]

/* [Facets] */
$fa = 6;
$fs = 0.3;

diameter = ring_diameter(ring_size, size_system);
// The culet stays 0.5 mm above the finger.
girdle = diameter / 2 + 0.5 + culet_depth(stone);
width = stone + 2 * edge;
count = floor(180 / asin((stone + gap) / 2 / girdle));
pitch = 2 * girdle * sin(180 / count);
// A prong stands beside the gap, where it overlaps both girdles by 0.15 of
// its thickness.
prong_shift = sqrt(pow(stone / 2 + 0.35 * prong_wire, 2) - pow(pitch / 2, 2));

assert(sleeve >= 0.8, "the sleeve is at least 0.8 mm thick");
assert(prong_shift >= prong_wire / 2 + 0.1,
       "the prongs of a pair run into each other: take larger stones, less gap or thinner prongs");
echo(str(count, " stones of ", stone, " mm, ",
         round(100 * count * brilliant_carat(stone)) / 100, " ct in all"));

module cup() {
  foot = girdle - diameter / 2 - sleeve / 2;
  translate([0, 0, -foot])
    cylinder(r1 = 0.42 * stone, r2 = width / 2, h = foot - 0.12 * stone);
}

module prong_pair() {
  for (side = [-1, 1])
    on_ring(girdle, 0, side * prong_shift)
      grain(prong_wire, height = 0.1 * stone,
            sunk = girdle - diameter / 2 - sleeve / 2);
}

module ring() {
  difference() {
    union() {
      band(diameter, shank_profile(width, sleeve + 0.15, 0.15, 0.2));
      around(count) on_ring(girdle, 0) cup();
      around(count, 180 / count) prong_pair();
    }
    around(count)
      on_ring(girdle, 0)
        seat_cutter(stone, bite = 0.15 * prong_wire, above = stone,
                    hole = 0.5 * stone, below = girdle - diameter / 2 + 0.5,
                    $rigid = true);
  }
  if (show_stones) %around(count) on_ring(girdle, 0) brilliant(stone);
}

translate([0, 0, width / 2]) ring();
