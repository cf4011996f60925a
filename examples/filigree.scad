// Filigree ring: a trellis of waving wires between two rails, a grain on every
// crossing.
//
//   lamina examples/filigree.scad -o filigree.slc --layer 0.025
//   lamina examples/filigree.scad -D waves=5 -D width=10 -o wide.slc
//
// Lies on its side. Openings stay above 0.4 mm, so that the investment flows.

use <lib/jewelry.scad>

/* [Size] */
ring_size = 54;
size_system = "ISO"; // [ISO, EU, US, UK, CH, JP, mm]

/* [Trellis] */
// width of the ring [mm]
width = 7; // [5 : 0.5 : 12]
// waves of each wire round the ring
waves = 7; // [3 : 9]
// number of wires
wires = 5; // [3 : 7]
// thickness of the wires [mm]
wire = 0.9; // [0.8 : 0.05 : 1.4]
// thickness of the rails [mm]
rail = 1.3; // [1 : 0.1 : 2]
// grains on the crossings
grains = true;

/* [Facets] */
$fa = 5;
$fs = 0.4;

diameter = ring_diameter(ring_size, size_system);
radius = diameter / 2 + rail / 2;    // of the middle of rails and wires
reach = width / 2 - rail / 2;        // rails at z = ±reach
steps = 12 * waves;                  // points of a wire

assert(reach > rail, "the ring is too narrow for its rails");
// At its crests the curve's radius must exceed that of the wire.
assert(pow(radius / waves, 2) / reach > 0.52 * wire,
       "the wires bend too tightly: fewer waves or a narrower ring");
assert(2 * PI * radius / waves / wires - wire >= 0.4,
       "openings under 0.4 mm fill up in casting: fewer waves or wires, or thinner ones");

function on_cylinder(angle, z) = [radius * cos(angle), radius * sin(angle), z];

module wave(phase) {
  wire_loop([for (i = [0 : steps - 1]) let (a = 360 * i / steps)
               on_cylinder(a, reach * sin(waves * a + phase))], wire);
}

// Waves i and j cross where the sines of their phases agree.
module crossings() {
  for (i = [0 : wires - 2], j = [i + 1 : wires - 1], k = [0 : 2 * waves - 1]) {
    mean = 180 * (i + j) / wires;      // of the phases 360 i / wires
    turn = 90 + 180 * k - mean;        // waves · angle at the crossing
    z = reach * sin(turn + 360 * i / wires);
    if (abs(z) < 0.75 * reach)
      translate(on_cylinder(turn / waves, z)) sphere(d = 1.45 * wire);
  }
}

translate([0, 0, width / 2]) {
  for (i = [0 : wires - 1]) wave(360 * i / wires);
  for (side = [-1, 1])
    translate([0, 0, side * reach])
      band(diameter, d_profile(rail, rail));
  if (grains) crossings();
}
