module all() { children(); }
module one(n) { children(n); }
module some(v) { children(v); }
module count() { echo($children); }
all() { cube(1); sphere(1); }
one(1) { cube(1); sphere(2); }
one(2) { cube(1); sphere(2); }
one(-1) cube(1);
some([0, 2]) { cube(1); cube(2); cube(3); }
some([1 : 2]) { cube(1); cube(2); cube(3); }
some("a") cube(1);
count() { cube(1); if (false) cube(2); *cube(3); }
count();
module outer() { all() children(); }
outer() cube(4);
children();

// expect: WARNING: Children index (2) out of bounds (2 children)
// expect: WARNING: Negative children index (-1) not allowed
// expect: WARNING: Bad parameter type ("a") for children, only accept: empty, number, vector, range in file children.scad, line 3
// expect: ECHO: 2
// expect: ECHO: 0
// expect csg: group() {
// expect csg: \tgroup() {
// expect csg: \t\tcube(size = [1, 1, 1], center = false);
// expect csg: \t\tsphere($fn = 0, $fa = 12, $fs = 2, r = 1);
// expect csg: \t}
// expect csg: }
// expect csg: group() {
// expect csg: \tsphere($fn = 0, $fa = 12, $fs = 2, r = 2);
// expect csg: }
// expect csg: group();
// expect csg: group();
// expect csg: group() {
// expect csg: \tgroup() {
// expect csg: \t\tcube(size = [1, 1, 1], center = false);
// expect csg: \t\tcube(size = [3, 3, 3], center = false);
// expect csg: \t}
// expect csg: }
// expect csg: group() {
// expect csg: \tgroup() {
// expect csg: \t\tcube(size = [2, 2, 2], center = false);
// expect csg: \t\tcube(size = [3, 3, 3], center = false);
// expect csg: \t}
// expect csg: }
// expect csg: group();
// expect csg: group();
// expect csg: group();
// expect csg: group() {
// expect csg: \tgroup() {
// expect csg: \t\tgroup() {
// expect csg: \t\t\tgroup() {
// expect csg: \t\t\t\tcube(size = [4, 4, 4], center = false);
// expect csg: \t\t\t}
// expect csg: \t\t}
// expect csg: \t}
// expect csg: }
