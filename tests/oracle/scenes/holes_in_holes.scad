// Tubes in tubes, eccentric, with islands in the holes of islands.
module tube(r, w) {
  difference() {
    cylinder(r = r, h = 4, $fn = 60);
    translate([0, 0, -1]) cylinder(r = r - w, h = 6, $fn = 60);
  }
}
for (i = [1:6]) translate([0.15 * i, 0, 0]) tube(2 * i, 0.6 + 0.1 * i);
