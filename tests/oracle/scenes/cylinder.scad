// Cylinder, frustum both ways up, cones with either apex, a prism.
cylinder(r = 3, h = 5, $fn = 40);
translate([8, 0, 0]) cylinder(r1 = 3, r2 = 1, h = 5);
translate([16, 0, 2.5]) cylinder(r1 = 1, r2 = 3, h = 5, center = true);
translate([0, 8, 0]) cylinder(r1 = 3, r2 = 0, h = 5, $fn = 25);
translate([8, 8, 0]) cylinder(r1 = 0, r2 = 3, h = 5, $fn = 24);
translate([16, 8, 0]) cylinder(d = 5, h = 5, $fn = 3);
