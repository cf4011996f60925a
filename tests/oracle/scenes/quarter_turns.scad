// Right angles keep coordinates exact: faces of turned copies coincide.
module step() { cube([3, 2, 1]); translate([0, 0, 1]) cube([1, 2, 1.5]); }
for (a = [0:90:270]) rotate(a) step();
translate([10, 0, 0]) rotate([90, 0, 0]) step();
translate([10, 0, 0]) rotate([0, 0, 180]) rotate([90, 0, 0]) step();
translate([10, 6, 0]) rotate([0, 270, 0]) step();
