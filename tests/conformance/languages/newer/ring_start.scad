rotate_extrude(angle = 90, start = 30, $fn = 20) translate([2, 0]) square(1);
