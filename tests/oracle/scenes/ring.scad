// A solitaire: shank, head with prongs, seat cut for a stone.
$fn = 48;
rotate([90, 0, 0]) difference() {
  cylinder(r = 10.2, h = 3, center = true);
  cylinder(r = 8.5, h = 4, center = true);
  for (s = [-1, 1]) translate([0, 0, s * 3.4]) rotate([0, 0, 0])
    cylinder(r1 = 12 + s * 2, r2 = 12 - s * 2, h = 3, center = true);
}
difference() {
  union() {
    translate([0, 0, 9.6]) cylinder(r1 = 1.2, r2 = 2.6, h = 2.2);
    for (a = [45:90:315]) rotate(a) translate([2.4, 0, 11])
      rotate([0, 8, 0]) cylinder(r = 0.5, h = 3.2, $fn = 20);
  }
  translate([0, 0, 11]) cylinder(r1 = 0, r2 = 2.5, h = 2);
  translate([0, 0, 13]) cylinder(r = 2.5, h = 0.3);
  translate([0, 0, 13.3]) cylinder(r1 = 2.5, r2 = 1.5, h = 1);
}
