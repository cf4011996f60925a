// A part far from the origin.
translate([812.3, -655.7, 431.9]) difference() {
  rotate([12, 23, 34]) cube([6, 5, 4]);
  translate([3, 2, 1]) sphere(r = 1.5, $fn = 24);
}
