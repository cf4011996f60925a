// agree
difference() {
  cylinder(r = 10, h = 5, $fn = 60);
  translate([0, 0, -1]) rotate([3, 0, 0]) cube([3, 3, 20]);
}
