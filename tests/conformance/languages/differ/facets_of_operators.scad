// Operators without parameters take `$` arguments in 2026 only.
union($fn = 6) cylinder(h = 1, r = 5);
translate([20, 0, 0]) difference($fn = 5) { cylinder(h = 2, r = 5); cylinder(h = 9, r = 2); }
translate([40, 0, 0]) intersection($fn = 7) { cylinder(h = 3, r = 5); cube(8, center = true); }
translate([60, 0, 0]) group($fn = 4) cylinder(h = 1, r = 5);
