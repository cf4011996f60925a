// Name medal: a drop of metal with a soft edge, a sunk field with the name in
// relief, a brilliant above it, and a date engraved in the back.
//
//   lamina examples/medal.scad -o medal.slc --layer 0.025
//   lamina examples/medal.scad -D 'name="Zoë"' -D 'date="1·1·2027"' -o zoe.slc
//
// Lies on its back. The letters are the font's, rounded as if cast: the sum of
// their outlines and a small ball.

use <lib/jewelry.scad>

/* [Text] */
name = "Clara";
date = "12·5·2024";
font = "Liberation Serif:style=Bold Italic";
// width of the name [mm]
name_width = 12.6; // [6 : 0.2 : 26]

/* [Medal] */
// width of the drop [mm]
width = 17; // [12 : 0.5 : 30]
// height of its round part [mm]
height = 19; // [12 : 0.5 : 34]
// thickness at the rim [mm]
thickness = 2; // [1.6 : 0.1 : 3]
// width of the rim [mm]
rim = 1.1; // [0.8 : 0.1 : 2]
// depth of the field [mm]
field = 0.7; // [0.4 : 0.05 : 1.2]
// roundness of the edge [mm]
edge = 0.45; // [0.2 : 0.05 : 0.7]

/* [Eye] */
// opening for the jump ring [mm]
opening = 2.2; // [1.6 : 0.1 : 4]

/* [Stone] */
// diameter of the brilliant [mm]; 0: none
stone = 2; // [0 : 0.1 : 3]

// show the stone (never printed)
show_stone = false;

/* [Facets] */
$fa = 9;
$fs = 0.3;

soft = 0.12;                               // roundness of the letters
eye = [0, height / 2 + opening / 2 + 0.4];  // middle of the opening
floor_height = thickness - field;
engraved = 0.4;
hairline = 0.08;
name_drop = -1.6;                          // below the middle of the oval

assert(floor_height - engraved >= 0.8,
       "less than 0.8 mm of metal would be left between field and engraving");
assert(rim >= 2 * edge, "the rim is too narrow for so round an edge");

// A ball with a point at either pole, so that sums grow by exactly r.
module ball(r) {
  rotate_extrude()
    polygon([for (a = [-90 : 30 : 90]) r * [cos(a), sin(a)]]);
}

// A flat shape as a plate from z = 0, its edges rounded by r.
module soft_plate(height, r) {
  translate([0, 0, r]) minkowski() {
    linear_extrude(height - 2 * r) offset(delta = -r) children();
    ball(r);
  }
}

// 2D, the drop: an oval that runs into the eye.
module outline() {
  hull() {
    scale([width / height, 1]) circle(d = height);
    translate(eye) circle(d = opening + 2.2);
  }
}

module field_outline() {
  difference() {
    offset(delta = -rim) outline();
    translate(eye) circle(d = opening + 2 * rim);
  }
}

// 2D, around the middle of the oval.
module line_of(words, width) {
  resize([width, 0], auto = true)
    text(words, font = font, halign = "center", valign = "center");
}

// From the field to the height of the rim. The hairlines are made wider by a
// little, the ball then takes nothing from the letter's own outline.
module letters() {
  translate([0, name_drop, floor_height - 0.2])
    soft_plate(field + 0.2, soft)
      offset(delta = hairline) line_of(name, name_width);
}

// The bezel stands on the field, its seat is cut with the stone's hole.
module at_stone() {
  translate([0, height / 2 - rim - stone / 2 - 1.2, floor_height + 0.45])
    children();
}

module medal() {
  difference() {
    union() {
      drop();
      letters();
      if (stone > 0) at_stone() bezel(stone, 0.8, depth = 0.7, taper = 3);
    }
    if (stone > 0)
      at_stone() seat_cutter(stone, bite = 0.12, above = 2, hole = 0.5 * stone,
                             below = thickness, $rigid = true);
    translate([0, name_drop, -1]) linear_extrude(1 + engraved)
      mirror([1, 0]) line_of(date, 0.9 * name_width);
  }
}

module drop() {
  difference() {
    soft_plate(thickness, edge) outline();
    translate([0, 0, floor_height]) soft_plate(thickness, 0.3) field_outline();
    translate(eye) cylinder(d = opening, h = 3 * thickness, center = true);
  }
}

medal();
if (show_stone && stone > 0) {
  %at_stone() brilliant(stone);
}
