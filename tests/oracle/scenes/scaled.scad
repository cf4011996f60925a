// Unequal and negative scales, one within another.
scale([2, 0.5, 1.3]) sphere(r = 2.5, $fn = 30);
translate([10, 0, 0]) scale([1, -2, 1]) rotate([20, 30, 0])
  difference() {
    cube(3, center = true);
    cylinder(r = 1, h = 5, center = true, $fn = 16);
  }
translate([0, 9, 0]) rotate(30) scale([3, 1, 0.7]) rotate(45)
  cube(2, center = true);
