// 2026: 3.83 mm³
rotate_extrude(angle = 100, $fn = 7) translate([2, 0]) square(1);
