// Details of a few hundredths.
scale(0.01) {
  difference() {
    cube([10, 8, 6]);
    translate([5, 4, -1]) cylinder(r = 2, h = 9, $fn = 16);
  }
  translate([12, 0, 0]) sphere(r = 3, $fn = 12);
}
