// Hulls of leaves, of a hull, and of solids that only a Boolean gives.
hull() {
  sphere(5, $fn = 24);
  translate([20, 3, 1]) cube([4, 5, 6]);
  translate([5, 15, 0]) cylinder(h = 8, r1 = 3, r2 = 0, $fn = 17);
}
translate([40, 0, 0]) hull() {
  difference() {
    sphere(6, $fn = 20);
    translate([3, 1, 2]) sphere(6, $fn = 20);
  }
  translate([0, 9, 0]) intersection() {
    cube(4);
    rotate([20, 30, 0]) cube(4);
  }
}
translate([0, 30, 0]) difference() {
  hull() {
    cube([9, 9, 1]);
    hull() translate([3, 3, 6]) cylinder(h = 1, r = 2, $fn = 30);
  }
  translate([4, 4, -1]) cylinder(h = 9, r = 1, $fn = 12);
}
