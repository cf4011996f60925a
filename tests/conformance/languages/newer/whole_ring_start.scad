rotate_extrude(start = 10, $fn = 7) translate([2, 0]) square(1);
