// Ring with a scan on it: Stanford's bunny, decimated and engraved, on a plate on
// a plain shank. The scan is a file of triangles with lengths of its own and y
// upwards.
//
//   scripts/fetch_bunny examples/bunny.ply
//   lamina examples/scan_ring.scad -o scan_ring.slc --layer 0.025
//   lamina examples/scan_ring.scad -D 'scan="dog.ply"' -D decimate=0.01 -o dog.slc
//
// lamina closes a scan where it is open, and says so. The ring stands on the back
// of its shank.

use <lib/jewelry.scad>
use <lib/letters.scad>

/* [Size] */
ring_size = 56;
size_system = "ISO"; // [ISO, EU, US, UK, CH, JP, mm]

/* [Scan] */
// a mesh: PLY, STL, OFF, OBJ, AMF or 3MF
scan = "bunny.ply";
// height of the scan on the ring [mm]
height = 9; // [4 : 0.5 : 20]
// how far decimation may move the scan's surface, in the scan's own lengths
decimate = 0.005; // [0 : 0.005 : 0.1]

/* [Engraving] */
// one to three letters, A to Z and &, in the scan's flank; none: ""
initials = "B";
// depth of the cut [mm]
depth = 0.5; // [0.3 : 0.05 : 1]
// width of the graver's line [mm]
line = 0.4; // [0.3 : 0.05 : 1]

/* [Shank] */
// width [mm]
width = 4; // [2 : 0.1 : 8]
// thickness [mm]
thickness = 1.8; // [1.2 : 0.1 : 3]

/* [Facets] */
$fa = 4;
$fs = 0.2;

diameter = ring_diameter(ring_size, size_system);
top = diameter + 2 * thickness;  // of the shank
plate = 0.9;                     // over the shank
letters_height = height / 4;
across = 4 * height;             // more than any scan is wide

assert(height >= 4, "the scan must be at least 4 mm high");

// Upright, on the plane z = 0.
module figure() {
  translate([0, 0, height / 2])
    resize([0, 0, height], auto = true)
      rotate([90, 0, 0]) import(scan, center = true, decimate = decimate);
}

// What the graver takes out of the figure's front: the letters, as deep
// everywhere, whatever the surface does.
module engraving() {
  difference() {
    translate([0, 0, height / 3]) rotate([90, 0, 0])
      linear_extrude(across) monogram(initials, letters_height, line);
    translate([0, depth, 0]) figure();
  }
}

translate([0, 0, diameter / 2 + thickness]) stand_up()
  band(diameter, court_profile(width, thickness));
difference() {
  translate([0, 0, top - thickness / 2])
    cylinder(d = 0.9 * height, h = thickness / 2 + plate);
  // Out of the finger's way.
  translate([0, 0, diameter / 2 + thickness]) rotate([90, 0, 0])
    cylinder(d = diameter, h = across, center = true);
}
translate([0, 0, top + plate - 0.2]) difference() {
  figure();
  if (initials != "") engraving();
}
