// Solitaire: a round brilliant in a basket of prongs on a court shank whose
// shoulders rise to the head.
//
//   lamina examples/solitaire.scad -o solitaire.slc --layer 0.025
//   lamina examples/solitaire.scad -D carat=0.5 -D prongs=4 -o half_carat.slc
//
// Stands on the back of its shank, the stone on top, as it is printed with
// support under the shank and sprued there too. The bearing is cut: the stone
// clicks in under the prongs, which the setter then closes and trims.

use <lib/jewelry.scad>

/* [Size] */
// inner circumference in mm for ISO, a number for US, letters for UK
ring_size = 54;
size_system = "ISO"; // [ISO, EU, US, UK, CH, JP, mm]

/* [Stone] */
// weight of the diamond [carat]
carat = 1; // [0.2 : 0.05 : 3]
// show the stone (never printed)
show_stone = false;

/* [Head] */
prongs = 6; // [4, 6, 8]
// thickness of the prongs [mm]
prong_wire = 1; // [0.7 : 0.05 : 1.6]
// outward lean of the prongs [degrees]
lean = 15; // [0 : 25]

/* [Shank] */
// width at the back [mm]
width_back = 2.6; // [1.6 : 0.1 : 6]
// width at the head [mm]
width_head = 1.9; // [1.4 : 0.1 : 6]
// thickness [mm]
thickness = 1.7; // [1.2 : 0.1 : 3]
// how far the shoulders rise to the head [mm]
rise = 1.5; // [0 : 0.1 : 3]

/* [Facets] */
$fa = 6;
$fs = 0.3;

diameter = ring_diameter(ring_size, size_system);
stone = brilliant_diameter(carat);
// The culet stays 0.7 mm above the finger.
girdle = diameter / 2 + 0.7 + culet_depth(stone);
foot = girdle - diameter / 2 - 0.5;

assert(thickness >= 1.2, "a shank thinner than 1.2 mm wears through");

module shank() {
  n = 4 * ceil(facets(diameter / 2 + thickness) / 4);
  ring_sweep([for (i = [0 : n - 1])
    let (away = abs(wrapped(360 * i / n - 90)),  // from the head
         up = rise * smoothstep(62, 24, away) * smoothstep(4, 16, away),
         w = mix(width_head, width_back, smoothstep(25, 150, away)),
         p = shank_profile(w, thickness + up, 0.2, 0.5 * thickness,
                           dome_facets(width_back)))
    [for (q = p) [diameter / 2 + q[0], q[1]]]]);
}

module ring() {
  difference() {
    union() {
      shank();
      on_ring(girdle)
        prong_head(stone, prongs, prong_wire, depth = foot, lean = lean,
                   turn = 180 / prongs, $visible = true);
    }
    on_ring(girdle)
      seat_cutter(stone, bite = prong_bite(prong_wire), above = stone,
                  hole = 0.36 * stone, below = girdle, $rigid = true);
    // Keep the head's foot out of the finger's way.
    cylinder(d = diameter, h = 3 * width_back + stone, center = true);
  }
  if (show_stone) %on_ring(girdle) brilliant(stone);
}

translate([0, 0, diameter / 2 + thickness]) stand_up() ring();
