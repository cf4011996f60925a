rotate_extrude(angle = -130, $fn = 11) translate([2, 0]) square([1, 2]);
