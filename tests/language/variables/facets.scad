sphere();
sphere($fn = 7);
$fn = 5;
circle(2);
module m() { circle(3); }
m($fn = 9);
translate([1, 0, 0], $fa = 3) cylinder($fs = 0.001);

// expect: WARNING: $fs too small - clamping to 0.010000 in file facets.scad, line 7
// expect csg: sphere($fn = 5, $fa = 12, $fs = 2, r = 1);
// expect csg: sphere($fn = 7, $fa = 12, $fs = 2, r = 1);
// expect csg: circle($fn = 5, $fa = 12, $fs = 2, r = 2);
// expect csg: group() {
// expect csg: \tcircle($fn = 9, $fa = 12, $fs = 2, r = 3);
// expect csg: }
// expect csg: multmatrix([[1, 0, 0, 1], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) {
// expect csg: \tcylinder($fn = 5, $fa = 3, $fs = 0.01, h = 1, r1 = 1, r2 = 1, center = false);
// expect csg: }
