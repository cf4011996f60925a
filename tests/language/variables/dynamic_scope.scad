$x = 1;
function f() = $x;
module show() { echo($x, f()); }
module wrap() { $x = 3; children(); }
show();
show($x = 2);
wrap() show();
echo(let ($x = 4) f());
echo([for ($x = [5, 6]) f()]);
for ($x = [7, 8]) show();
function g(n) = n == 0 ? $x : let ($x = n) g(n - 1);
echo(g(3), $x);
echo($unknown);

// expect: ECHO: 1, 1
// expect: ECHO: 2, 2
// expect: ECHO: 3, 3
// expect: ECHO: 4
// expect: ECHO: [5, 6]
// expect: ECHO: 7, 7
// expect: ECHO: 8, 8
// expect: ECHO: 1, 1
// expect: WARNING: Ignoring unknown variable '$unknown' in file dynamic_scope.scad, line 13
// expect: ECHO: undef
// expect csg: group();
// expect csg: group();
// expect csg: group() {
// expect csg: \tgroup() {
// expect csg: \t\tgroup();
// expect csg: \t}
// expect csg: }
// expect csg: group() {
// expect csg: \tgroup();
// expect csg: \tgroup();
// expect csg: }
