echo("a", b = 1, [1, "c"]);
x = echo("in an expression", y = 2) 3;
echo(x);
echo("with children") cube(1);
function f(a) = echo(a = a) a * 2;
echo(f(2));

// expect: ECHO: "in an expression", y = 2
// expect: ECHO: "a", b = 1, [1, "c"]
// expect: ECHO: 3
// expect: ECHO: "with children"
// expect: ECHO: a = 2
// expect: ECHO: 4
// expect csg: group() {
// expect csg: \tcube(size = [1, 1, 1], center = false);
// expect csg: }
