// Halo pendant: a round brilliant in a bezel, a halo of small brilliants round
// it, milgrain on the rim and a tapered bail for the chain.
//
//   lamina examples/pendant.scad -o pendant.slc --layer 0.025
//   lamina examples/pendant.scad -D carat=1 -D small=1.3 -o one_carat.slc
//
// Lies on its back, the stones up; bail and back share the plate z = 0.

use <lib/jewelry.scad>

/* [Centre stone] */
// weight of the diamond [carat]
carat = 0.6; // [0.2 : 0.05 : 3]
// bezel wall [mm]
wall = 0.8; // [0.8 : 0.05 : 1.5]

/* [Halo] */
// diameter of the small stones [mm]
small = 1.5; // [1.1 : 0.05 : 2.5]
// thickness of the beads that hold them [mm]
bead = 0.7; // [0.7 : 0.05 : 1]

/* [Bail] */
// opening for the chain [mm]
opening = 2.4; // [2 : 0.1 : 6]

// show the stones (never printed)
show_stones = false;

/* [Facets] */
$fa = 6;
$fs = 0.3;

stone = brilliant_diameter(carat);
girdle = culet_depth(stone) + 0.2;            // of the centre stone
plate = max(culet_depth(small) + 0.6, girdle - 0.6);  // top of the halo
// As many stones as go round the bezel; the ring of stones then takes the
// radius at which they stand 0.2 mm apart.
count = ceil(180 / asin((small + 0.2) / 2 / (stone / 2 + wall + small / 2 + 0.1)));
halo = (small + 0.2) / 2 / sin(180 / count);
rim = halo + small / 2 + 0.5;
// A bead stands beside the gap and overlaps both girdles by 0.15 of its
// thickness.
bead_shift = sqrt(pow(small / 2 + 0.35 * bead, 2) - pow(small / 2 + 0.1, 2));
bail_wall = 0.9;
bail_half = opening / 2 + bail_wall;          // half of the bail's height

assert(bead_shift >= bead / 2 + 0.05,
       "the beads of a pair run into each other: take larger stones or thinner beads");

module at_halo() {
  around(count, 90 + 180 / count) translate([halo, 0, plate]) children();
}

// Plate with a rounded rim; the halo's stones sit level with it.
module body() {
  cylinder(r1 = rim - 0.5, r2 = rim, h = plate);
  translate([0, 0, plate]) milgrain(rim - 0.25, 0.7);
  translate([0, 0, girdle]) bezel(stone, wall, depth = girdle, taper = 3);
  around(count, 90) for (side = [-1, 1])
    translate([halo * cos(180 / count) + side * bead_shift, 0, plate])
      grain(bead, height = 0.1 * small, sunk = 0.6);
}

// The back is opened: light for the stones, less metal to pay for.
module openings() {
  translate([0, 0, girdle])
    seat_cutter(stone, bite = 0.15, above = 2, hole = 0.55 * stone,
                below = girdle + 1, $rigid = true);
  at_halo() seat_cutter(small, bite = 0.15 * bead, above = 2, hole = 0.55 * small,
                        below = plate + 1, $rigid = true);
}

difference() {
  union() {
    body();
    // A bead joins the bail's foot to the rim.
    translate([0, rim + 0.5, 1.4]) sphere(d = 2.8);
    translate([0, rim + 0.7, bail_half]) bail(opening, 3.4, 1.8, bail_wall);
  }
  openings();
}
if (show_stones) {
  %translate([0, 0, girdle]) brilliant(stone);
  %at_halo() brilliant(small);
}
