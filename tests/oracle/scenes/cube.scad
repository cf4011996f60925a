// A box off the origin, and a centred one.
translate([1, 2, 3]) cube([4, 3, 2]);
translate([8, 0, 4]) cube(3, center = true);
