// Angles of a degree and less, needles, and slits that narrow to nothing.
linear_extrude(height = 3) polygon([[0, 0], [10, 0.1], [10, 0]]);
translate([0, 2, 0]) difference() {
  cube([10, 3, 3]);
  translate([1, 1, -1]) linear_extrude(height = 5)
    polygon([[0, 0], [8, 0.07], [8, -0.05]]);
}
translate([0, 7, 0]) rotate([0, 0, 11]) cylinder(r1 = 0.5, r2 = 0, h = 3, $fn = 5);
translate([3, 7, 0]) cylinder(r1 = 0.02, r2 = 0.01, h = 3, $fn = 7);
