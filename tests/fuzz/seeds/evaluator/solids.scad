$fn = 6; w = 3;
module m(n) { if (n > 0) { cube(n); translate([n, 0, 0]) rotate([0, 10, n]) m(n - 1); } children(0); }
m(3) sphere(w);
linear_extrude(2, twist = 30, scale = [1, .5]) offset(r = 1) polygon([[0, 0], [4, 0], [0, 3]]);
rotate_extrude(angle = 90) translate([3, 0]) circle(1);
hull() { cylinder(h = 1, r1 = 2, r2 = 0); mirror([1, 0, 0]) cube(1, true); }
intersection_for (i = [0:2]) scale(i + 1) multmatrix([[1, 0, 0, i]]) resize([1, 2], auto = true) cube(1);
minkowski() { polyhedron([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]); cube(1); }
projection(cut = true) color("red", .5) render() square([1, 2]);
