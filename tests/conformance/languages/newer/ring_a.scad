rotate_extrude(a = 90, $fn = 36) translate([2, 0]) square(1);
