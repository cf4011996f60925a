// Hoop earring: a hinged hoop of D-section in two parts, a row of bead-set
// brilliants on the front, the ear post on the front half, its catch in the
// back half. A pin of 0.8 mm wire joins the halves.
//
//   lamina examples/hoop.scad -o hoop.slc --layer 0.025
//   lamina examples/hoop.scad -D assembled=true -D inner=16 -o closed.slc
//
// The halves lie side by side on their flat edges. Print two of each.

use <lib/jewelry.scad>

/* [Hoop] */
// inner diameter [mm]
inner = 13; // [10 : 0.5 : 40]
// width, along the hinge [mm]
width = 3.6; // [3.4 : 0.1 : 6]
// thickness [mm]
thickness = 2.8; // [2.6 : 0.1 : 5]
// opening for the ear lobe [degrees]
opening = 56; // [40 : 90]
// show the hoop closed instead of in parts to print
assembled = false;

/* [Stones] */
stones = 7; // [0 : 11]
// diameter of the stones [mm]
stone = 1.5; // [1 : 0.1 : 2]
// show the stones (never printed)
show_stones = false;

/* [Findings] */
// ear post [mm]: 0.8 is the usual 20 gauge
post = 0.8; // [0.7 : 0.05 : 1]
// hinge pin [mm]
pin = 0.8; // [0.7 : 0.05 : 1]

/* [Facets] */
$fa = 6;
$fs = 0.25;

middle = inner / 2 + thickness / 2;   // radius of post and hinge pin
outer = inner / 2 + thickness;
slot = post + 0.1;                    // the catch: a slot round the post
knuckle_radius = pin / 2 + 0.05 + 0.8;
play = 0.1;                           // between moving parts
third = width / 3;
bead = 0.7;
step = 2 * asin((stone + 0.3) / 2 / outer);  // between two stones
first = -step * (stones - 1) / 2;

assert(thickness >= slot + 0.3 + 1.6, "less than 0.8 mm beside the post's slot");
assert(width >= 3 * 1.1, "the three knuckles need a width of 3.3 mm");
assert(step * stones < 130, "these stones do not fit on the front half");
assert(width >= stone + 1.6, "less than 0.8 mm beside the stones");

module arc_of_hoop(from, to) {
  rotate([0, 0, from]) band(inner, d_profile(width, thickness), to - from);
}

// Cylinder round the hinge pin between two heights over the hoop's lower edge.
module at_hinge(radius, low, high) {
  translate([0, -middle, low - width / 2]) cylinder(r = radius, h = high - low);
}

// The outer knuckles belong to the front, the inner one to the back; each half
// makes room for the other's.
module outer_knuckles(radius, play) {
  at_hinge(radius, -play, third + play);
  at_hinge(radius, 2 * third - play, width + play);
}
module inner_knuckle(radius, play) {
  at_hinge(radius, third - play, 2 * third + play);
}
module pin_hole() { at_hinge(pin / 2 + 0.05, -1, width + 1); }

// Stones lie in a bright-cut channel, one pair of beads in every gap.
module channel() {
  depth = 0.35;
  rotate([0, 0, first - step * 0.6])
    rotate_extrude(angle = step * (stones + 0.2))
      polygon([[outer - depth, -stone / 2 - 0.05], [outer + 1, -stone / 2 - 0.4],
               [outer + 1, stone / 2 + 0.4], [outer - depth, stone / 2 + 0.05]]);
}
module at_stones() {
  for (i = [0 : 1 : stones - 1]) on_ring(outer - 0.3, first + i * step) children();
}
module beads() {
  for (i = [0 : 1 : stones], side = [-1, 1])
    on_ring(outer - 0.3, first + (i - 0.5) * step, side * 0.4 * stone)
      grain(bead, height = 0.1, sunk = 0.5);
}

module front() {
  difference() {
    union() {
      difference() {
        arc_of_hoop(-90, 90 - opening / 2);
        if (stones > 0) channel();
      }
      if (stones > 0) beads();
      outer_knuckles(knuckle_radius, 0);
      // Post: along the hoop, a round tip.
      rotate([0, 0, 90 - opening / 2 - 4])
        rotate_extrude(angle = opening + 16) translate([middle, 0]) circle(d = post);
      rotate([0, 0, 90 + opening / 2 + 12]) translate([middle, 0, 0]) sphere(d = post);
    }
    inner_knuckle(knuckle_radius + 2 * play, play);
    pin_hole();
    at_stones() seat_cutter(stone, bite = 0.1, above = 1.5, hole = 0.7, below = 1.2,
                            $rigid = true);
  }
  if (show_stones) %at_stones() brilliant(stone);
}

module back() {
  difference() {
    union() {
      arc_of_hoop(90 + opening / 2, 270);
      inner_knuckle(knuckle_radius, -play / 2);
    }
    outer_knuckles(knuckle_radius + 2 * play, play / 2);
    pin_hole();
    // The post comes in on a circle round the hinge: the slot is longer
    // across the hoop than along the hinge.
    rotate([0, 0, 90 + opening / 2 - 1])
      rotate_extrude(angle = 19) translate([middle, 0])
        scale([(slot + 0.3) / slot, 1]) circle(d = slot);
  }
}

translate([0, 0, width / 2]) {
  front();
  translate([assembled ? 0 : -4, 0, 0]) back();
}
