// A named argument that is no parameter is a variable of the call: nearer than
// what a function literal has around it, seen by the literals inside, and kept
// by the calls of itself that it ends with.
q = 10;
g = function(x) [x, q];
echo(g(1, q = 2), g(1), g(1, 2, 3, q = 4, r = 5));
h = function(x) function(y) [x, y, q];
echo(h(1, q = 3)(4), h(1)(4, q = 5), h(1)(4, x = 7), h(1, y = 6)(4));
echo([for (i = [1, 2]) (function(x) [x, i])(1, i = 9)]);
echo(let(a = function() b, b = 2, r = a(b = 7)) [a(), r, a(b = 8)]);
k = let(u = 1) function(x) let(w = x + u) function(y) [x, y, u, w, v];
echo(k(2, v = 1)(3), k(2)(3, v = 4, u = 5), k(2, u = 10, v = 0)(1, w = 9));
c = function(x) f(x);
echo(c(1, f = function(y) y * 10));
d = function(x = e) x;
e = 6;
echo(d(e = 4));
module m(p) {
  l = function(z) z + p + n;
  n = 100;
  echo(l(1), l(1, p = 2), l(1, n = 2));
}
m(3);

last = function(n) n == 0 ? s : last(n - 1);
echo(last(3, s = 5), last(300000, s = 1));
up = function(n) n == 0 ? s : up(n - 1, s = s + 1);
echo(up(3, s = 7));
down = function(n) n == 0 ? s : down(n - 1, s = n);
echo(down(3), down(3));
function named_last(n) = n == 0 ? s : named_last(n - 1);
echo(named_last(3, s = 7));
function named_down(n) = n == 0 ? s : named_down(n - 1, s = n);
echo(named_down(3), named_down(3));
function many(n) = n == 0 ? "end" : many(n - 1, 5);
echo(many(3), many(3));

// expect: WARNING: variable q not specified as parameter in file extra_arguments.scad, line 6
// expect: WARNING: Too many unnamed arguments supplied in file extra_arguments.scad, line 6
// expect: WARNING: variable q not specified as parameter in file extra_arguments.scad, line 6
// expect: WARNING: variable r not specified as parameter in file extra_arguments.scad, line 6
// expect: ECHO: [1, 2], [1, 10], [1, 4]
// expect: WARNING: variable q not specified as parameter in file extra_arguments.scad, line 8
// expect: WARNING: variable q not specified as parameter in file extra_arguments.scad, line 8
// expect: WARNING: variable x not specified as parameter in file extra_arguments.scad, line 8
// expect: WARNING: variable y not specified as parameter in file extra_arguments.scad, line 8
// expect: ECHO: [1, 4, 3], [1, 4, 5], [7, 4, 10], [1, 4, 10]
// expect: WARNING: variable i not specified as parameter in file extra_arguments.scad, line 9
// expect: WARNING: variable i not specified as parameter in file extra_arguments.scad, line 9
// expect: ECHO: [[1, 9], [1, 9]]
// expect: WARNING: variable b not specified as parameter in file extra_arguments.scad, line 10
// expect: WARNING: variable b not specified as parameter in file extra_arguments.scad, line 10
// expect: ECHO: [2, 7, 8]
// expect: WARNING: variable v not specified as parameter in file extra_arguments.scad, line 12
// expect: WARNING: variable v not specified as parameter in file extra_arguments.scad, line 12
// expect: WARNING: variable u not specified as parameter in file extra_arguments.scad, line 12
// expect: WARNING: variable u not specified as parameter in file extra_arguments.scad, line 12
// expect: WARNING: variable v not specified as parameter in file extra_arguments.scad, line 12
// expect: WARNING: variable w not specified as parameter in file extra_arguments.scad, line 12
// expect: ECHO: [2, 3, 1, 3, 1], [2, 3, 5, 3, 4], [2, 1, 10, 9, 0]
// expect: WARNING: variable f not specified as parameter in file extra_arguments.scad, line 14
// expect: ECHO: 10
// expect: WARNING: variable e not specified as parameter in file extra_arguments.scad, line 17
// expect: ECHO: 6
// expect: WARNING: variable p not specified as parameter in file extra_arguments.scad, line 21
// expect: WARNING: variable n not specified as parameter in file extra_arguments.scad, line 21
// expect: ECHO: 104, 103, 6
// expect: WARNING: variable s not specified as parameter in file extra_arguments.scad, line 26
// expect: WARNING: variable s not specified as parameter in file extra_arguments.scad, line 26
// expect: ECHO: 5, 1
// expect: WARNING: variable s not specified as parameter in file extra_arguments.scad, line 28
// expect: WARNING: variable s not specified as parameter in file extra_arguments.scad, line 27
// expect: ECHO: 10
// expect: WARNING: variable s not specified as parameter in file extra_arguments.scad, line 29
// expect: ECHO: 1, 1
// expect: WARNING: variable s not specified as parameter in file extra_arguments.scad, line 32
// expect: ECHO: 7
// expect: WARNING: variable s not specified as parameter in file extra_arguments.scad, line 33
// expect: ECHO: 1, 1
// expect: WARNING: Too many unnamed arguments supplied in file extra_arguments.scad, line 35
// expect: ECHO: "end", "end"
