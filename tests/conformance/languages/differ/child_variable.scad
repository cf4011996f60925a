// 2026: 36 mm³
// An assignment in a child block reads a variable of the module.
module row() for ($idx = [1 : 3]) translate([10 * $idx, 0, 0]) children();
row() { side = $idx == undef ? 5 : $idx; cube(side); }
