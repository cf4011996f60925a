// 2026: 3.75 mm³
rotate_extrude(a = 90) translate([2, 0]) square(1);
