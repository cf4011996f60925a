// Solids that touch in a line, in a point, or from inside.
cylinder(r = 2, h = 5, $fn = 24);
translate([4, 0, 0]) cylinder(r = 2, h = 4, $fn = 24);
translate([0, 4, 2]) sphere(r = 2, $fn = 24);
translate([10, 0, 0]) difference() {
  cylinder(r = 3, h = 5, $fn = 24);
  translate([1, 0, -1]) cylinder(r = 2, h = 7, $fn = 24);
}
translate([10, 8, 0]) difference() {
  cylinder(r = 3, h = 5, $fn = 24);
  translate([0, 0, 2.5]) cube([6, 2, 6], center = true);
}
