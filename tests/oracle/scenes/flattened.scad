// Solids scaled to a plane, a line or a point: corners of hulls, and operands
// of sums.
module ell() {
  difference() {
    cube([4, 4, 3]);
    translate([1.5, 1.25, 1]) cube(5);
  }
}

hull() {
  scale([1, 1, 0]) cylinder(r = 3, h = 1, $fn = 9);
  translate([1, 0, 4]) rotate([20, 30, 0]) scale([1, 1, 0]) cube([3, 2, 1]);
}
translate([10, 0, 0]) minkowski() {
  ell();
  rotate([0, 30, 0]) scale([1, 1, 0]) cube([1, 0.75, 2]);
}
translate([20, 0, 0]) minkowski() {
  scale([0.5, 0, 0]) cube(1);
  ell();
}
translate([30, 0, 0]) minkowski() {
  scale([1, 1, 0]) sphere(2, $fn = 8);
  scale([0, 1, 1]) cube([1, 2, 3]);
}
// Of no volume, and no part of anything.
translate([40, 0, 0]) scale([1, 1, 0]) cube(3);
