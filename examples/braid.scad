// Braided band: three strands plaited over and under each other all the way
// round, on a thin sleeve that keeps the finger smooth.
//
//   lamina examples/braid.scad -o braid.slc --layer 0.025
//   lamina examples/braid.scad -D strand=2 -D swing=2 -D plaits=7 -o heavy.slc
//
// Lies on its side.

use <lib/jewelry.scad>

/* [Size] */
ring_size = 54;
size_system = "ISO"; // [ISO, EU, US, UK, CH, JP, mm]

/* [Braid] */
// thickness of a strand [mm]
strand = 1.7; // [1.2 : 0.1 : 2.2]
// plaits round the ring; not a multiple of 3 makes the strands one endless wire
plaits = 8; // [4 : 10]
// half width of the plait, middle to middle [mm]
swing = 1.7; // [1 : 0.1 : 2.5]
// thickness of the sleeve [mm]
sleeve = 0.9; // [0.8 : 0.1 : 2]

/* [Facets] */
$fa = 5;
$fs = 0.45;

diameter = ring_diameter(ring_size, size_system);
weave = 0.42 * strand;                          // rise over and under
// The strands sink into the sleeve as deep as it allows, so that no gap stays
// between them where they cross over.
sink = min(sleeve - 0.1, weave + 0.1);
radius = diameter / 2 + sleeve + weave + strand / 2 - sink;
width = 2 * swing + strand;
steps = plaits * max(24, ceil(5 / $fs));

assert(sleeve >= 0.8, "the sleeve is at least 0.8 mm thick");
// At its crests the curve's radius must exceed that of the wire.
assert(pow(radius / plaits, 2) / swing > 0.52 * strand,
       "the strands bend too tightly: fewer plaits, less swing or a thinner strand");

// The classic plait: across as sin t, over and under as sin 2t.
module plait(phase) {
  wire_loop([for (i = [0 : steps - 1])
    let (a = 360 * i / steps, t = plaits * a + phase, r = radius + weave * sin(2 * t))
    [r * cos(a), r * sin(a), swing * sin(t)]], strand);
}

translate([0, 0, width / 2]) {
  band(diameter, shank_profile(width - 0.3, sleeve, 0.1, 0.1));
  for (i = [0 : 2]) plait(120 * i);
}
