// Overlapping solids of every kind, one inside another, one apart.
union() {
  cube([6, 6, 3]);
  translate([6, 3, 1.5]) sphere(r = 2.5, $fn = 30);
  translate([3, 6, 0]) cylinder(r = 2, h = 4, $fn = 24);
  translate([2, 2, 1]) cube(1);
  translate([12, 0, 0]) cylinder(r1 = 1, r2 = 0.2, h = 4);
}
