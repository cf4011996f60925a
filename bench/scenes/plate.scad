// plate: a part with upright walls only, as most that are not jewelry: ribs, drilled
// holes, a pocket, and a rim of teeth. 80 x 50 x 20 mm.
teeth = 60;
difference() {
  union() {
    cube([80, 50, 12]);
    for (i = [0 : 7]) translate([5 + 10*i, 0, 0]) cube([2, 50, 16]);
    for (i = [0 : teeth - 1]) translate([40, 25, 0]) rotate(360*i/teeth)
      translate([10, -0.4, 0]) cube([3, 0.8, 20]);
    translate([40, 25, 0]) cylinder(r = 11, h = 20, $fn = 180);
  }
  for (i = [0 : 6], j = [0 : 3]) translate([11 + 10*i, 8 + 11*j, -1]) cylinder(d = 5, h = 30, $fn = 64);
  translate([4, 4, 3]) cube([20, 20, 30]);
}
