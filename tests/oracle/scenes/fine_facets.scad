// Leaves of many facets.
difference() {
  sphere(r = 6, $fn = 160);
  cylinder(r = 2.5, h = 14, center = true, $fn = 200);
  rotate([90, 0, 0]) cylinder(r = 2, h = 14, center = true, $fn = 120);
}
