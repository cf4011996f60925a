// Bores, a pocket, a cut through an edge, a cavity that no face shows.
difference() {
  cube([12, 10, 6]);
  translate([3, 3, -1]) cylinder(r = 1.5, h = 8, $fn = 32);
  translate([9, 3, 2]) cylinder(r1 = 1, r2 = 2, h = 5, $fn = 20);
  translate([12, 10, 3]) sphere(r = 2.5, $fn = 24);
  translate([3, 7, 3]) sphere(r = 1.5, $fn = 20);
}
