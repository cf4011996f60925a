translate([1, 2]) rotate(45) scale(2) mirror([1, 1, 0]) cube([1, 2, 3], center = true);
rotate([10, 20, 30]) rotate(30, [1, 1, 1]) multmatrix([[1, 0.5], [0, 2, 0, 4]]) sphere(d = 3);
cylinder(h = 2, d1 = 1, d2 = 3);
difference() { square(2); circle(d = 1); }
linear_extrude(3) square(1);
linear_extrude(height = 2, twist = 90, slices = 8, scale = [1, 2], center = true, convexity = 4) circle(1);
rotate_extrude(angle = 90, convexity = 3) translate([2, 0]) circle(1);
polyhedron([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 1, 2], [0, 3, 1], [1, 3, 2], [0, 2, 3]]);
polygon([[0, 0], [1, 0], [0, 1/3]], [[0, 1, 2]], 2);
polygon([[0, 0], [1, 0], [0, 1e6]]);
hull() { cube(1); sphere(1); }
minkowski(convexity = 2) { cube(1); sphere(1); }
resize([1, 2], auto = [true, false]) cube(1);
offset(r = 1) square(1);
offset(delta = -1, chamfer = true) square(1);
projection(cut = true) cube(1);
render(convexity = 2) color("Red", 0.5) cube(1);
color("#12345678") cube(1);
text("Hi \"there\"", size = 5, halign = "center");
group() { }
union() #cube(1);
%cube(2);
*cube(3);
if (false) cube(1); else sphere(1);

// expect csg: multmatrix([[1, 0, 0, 1], [0, 1, 0, 2], [0, 0, 1, 0], [0, 0, 0, 1]]) {
// expect csg: \tmultmatrix([[0.707107, -0.707107, 0, 0], [0.707107, 0.707107, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) {
// expect csg: \t\tmultmatrix([[2, 0, 0, 0], [0, 2, 0, 0], [0, 0, 2, 0], [0, 0, 0, 1]]) {
// expect csg: \t\t\tmultmatrix([[0, -1, 0, 0], [-1, 0, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) {
// expect csg: \t\t\t\tcube(size = [1, 2, 3], center = true);
// expect csg: \t\t\t}
// expect csg: \t\t}
// expect csg: \t}
// expect csg: }
// expect csg: multmatrix([[0.813798, -0.44097, 0.378522, 0], [0.469846, 0.882564, 0.0180283, 0], [-0.34202, 0.163176, 0.925417, 0], [0, 0, 0, 1]]) {
// expect csg: \tmultmatrix([[0.910684, -0.244017, 0.333333, 0], [0.333333, 0.910684, -0.244017, 0], [-0.244017, 0.333333, 0.910684, 0], [0, 0, 0, 1]]) {
// expect csg: \t\tmultmatrix([[1, 0.5, 0, 0], [0, 2, 0, 4], [0, 0, 1, 0], [0, 0, 0, 1]]) {
// expect csg: \t\t\tsphere($fn = 0, $fa = 12, $fs = 2, r = 1.5);
// expect csg: \t\t}
// expect csg: \t}
// expect csg: }
// expect csg: cylinder($fn = 0, $fa = 12, $fs = 2, h = 2, r1 = 0.5, r2 = 1.5, center = false);
// expect csg: difference() {
// expect csg: \tsquare(size = [2, 2], center = false);
// expect csg: \tcircle($fn = 0, $fa = 12, $fs = 2, r = 0.5);
// expect csg: }
// expect csg: linear_extrude(height = 3, center = false, convexity = 1, scale = [1, 1], $fn = 0, $fa = 12, $fs = 2) {
// expect csg: \tsquare(size = [1, 1], center = false);
// expect csg: }
// expect csg: linear_extrude(height = 2, center = true, convexity = 4, twist = 90, slices = 8, scale = [1, 2]) {
// expect csg: \tcircle($fn = 0, $fa = 12, $fs = 2, r = 1);
// expect csg: }
// expect csg: rotate_extrude(angle = 90, convexity = 3, $fn = 0, $fa = 12, $fs = 2) {
// expect csg: \tmultmatrix([[1, 0, 0, 2], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) {
// expect csg: \t\tcircle($fn = 0, $fa = 12, $fs = 2, r = 1);
// expect csg: \t}
// expect csg: }
// expect csg: polyhedron(points = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], faces = [[0, 1, 2], [0, 3, 1], [1, 3, 2], [0, 2, 3]], convexity = 1);
// expect csg: polygon(points = [[0, 0], [1, 0], [0, 0.333333]], paths = [[0, 1, 2]], convexity = 2);
// expect csg: polygon(points = [[0, 0], [1, 0], [0, 1e+6]], paths = undef, convexity = 1);
// expect csg: hull() {
// expect csg: \tcube(size = [1, 1, 1], center = false);
// expect csg: \tsphere($fn = 0, $fa = 12, $fs = 2, r = 1);
// expect csg: }
// expect csg: minkowski(convexity = 2) {
// expect csg: \tcube(size = [1, 1, 1], center = false);
// expect csg: \tsphere($fn = 0, $fa = 12, $fs = 2, r = 1);
// expect csg: }
// expect csg: resize(newsize = [1,2,0], auto = [1,0,0], convexity = 0) {
// expect csg: \tcube(size = [1, 1, 1], center = false);
// expect csg: }
// expect csg: offset(r = 1, $fn = 0, $fa = 12, $fs = 2) {
// expect csg: \tsquare(size = [1, 1], center = false);
// expect csg: }
// expect csg: offset(delta = -1, chamfer = true, $fn = 0, $fa = 12, $fs = 2) {
// expect csg: \tsquare(size = [1, 1], center = false);
// expect csg: }
// expect csg: projection(cut = true, convexity = 0) {
// expect csg: \tcube(size = [1, 1, 1], center = false);
// expect csg: }
// expect csg: render(convexity = 2) {
// expect csg: \tcolor([1, 0, 0, 0.5]) {
// expect csg: \t\tcube(size = [1, 1, 1], center = false);
// expect csg: \t}
// expect csg: }
// expect csg: color([0.0705882, 0.203922, 0.337255, 0.470588]) {
// expect csg: \tcube(size = [1, 1, 1], center = false);
// expect csg: }
// expect csg: text(text = "Hi "there"", size = 5, spacing = 1, font = "", direction = "ltr", language = "en", script = "Latn", halign = "center", valign = "baseline", $fn = 0, $fa = 12, $fs = 2);
// expect csg: group();
// expect csg: union() {
// expect csg: #\tcube(size = [1, 1, 1], center = false);
// expect csg: }
// expect csg: %cube(size = [2, 2, 2], center = false);
// expect csg: group() {
// expect csg: \tsphere($fn = 0, $fa = 12, $fs = 2, r = 1);
// expect csg: }
