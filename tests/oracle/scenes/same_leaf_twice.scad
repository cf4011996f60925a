// A solid with itself: united, intersected, taken away, turned by its symmetry.
module gem() { cylinder(r = 3, h = 4, $fn = 8); }
union() { gem(); gem(); }
translate([8, 0, 0]) intersection() { gem(); gem(); }
translate([16, 0, 0]) difference() { gem(); gem(); }
translate([16, 0, 0]) difference() { gem(); translate([0, 0, 2]) gem(); }
translate([0, 8, 0]) union() { gem(); rotate(45) gem(); }
