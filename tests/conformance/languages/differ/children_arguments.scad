// In 2026 only `index` chooses children, and `$` arguments reach them.
module all() { children($fn = 6); }
module second() { children(1, $fn = 5); }
module named() { children(index = 0, $fn = 4); }
module other() { children(foo = 0, 1); }
module pair() { cylinder(r = 5, h = 1); translate([20, 0, 0]) cylinder(r = 4, h = 2); }
all() { cylinder(r = 5, h = 1); translate([20, 0, 0]) cylinder(r = 5, h = 1, $fn = 4); }
translate([0, 20, 0]) second() { cube(1); translate([20, 0, 0]) cylinder(r = 5, h = 2); }
translate([0, 40, 0]) named() { cylinder(r = 3, h = 2); cube(3); }
translate([0, 60, 0]) other() { cube(3); translate([9, 0, 0]) cube([1, 2, 3]); }
