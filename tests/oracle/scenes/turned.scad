// Rotations about every axis, about a vector, one upon another.
rotate([30, 40, 50]) cube([4, 5, 6], center = true);
translate([10, 0, 0]) rotate(a = 70, v = [1, 2, 3])
  cylinder(r = 2, h = 7, center = true, $fn = 20);
translate([0, 10, 0]) rotate([0, 45, 0]) rotate([45, 0, 0])
  difference() {
    cube(5, center = true);
    cylinder(r = 1.5, h = 9, center = true, $fn = 18);
  }
translate([10, 10, 0]) rotate([90, 0, 0])
  linear_extrude(height = 4, center = true)
    polygon([[-3, -3], [3, -3], [0, 3]]);
