// Tubes with walls of 0.02 mm, upright and lying.
module tube(r) {
  difference() {
    cylinder(r = r, h = 4, center = true, $fn = 64);
    cylinder(r = r - 0.02, h = 5, center = true, $fn = 64);
  }
}
tube(2);
tube(1.9);
translate([6, 0, 0]) rotate([90, 0, 0]) tube(2);
translate([12, 0, 0]) rotate([0, 90, 0]) tube(2);
