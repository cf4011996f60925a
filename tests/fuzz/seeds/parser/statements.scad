use <none.scad>
include <none.scad>
/* [Size] */
// width
w = 10; // [1:20]
s = "a\n\x41\u00e9\U01F600\"";
function f(x, y = 2, $t = 1) = x > 0 ? f(x - 1) + y : let(a = 1, b = a) a * b;
module m(size = [1, 2, 3], center) { if (center) translate(size / 2) children(); else { cube(size); } }
!m(center = true) # %sphere(r = 2, $fn = 8);
*difference() { cube(w); for (i = [0 : 2 : 10], j = [1, 2]) translate([i, j, 0]) cylinder(); }
