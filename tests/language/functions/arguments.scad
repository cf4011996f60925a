function f(a, b = 2, c) = [a, b, c];
echo(f());
echo(f(1));
echo(f(c = 3, 1));
echo(f(1, 2, 3, 4));
echo(f(1, a = 5));
echo(f(d = 4));
function g(a) = a + extra;
echo(g(1, extra = 2));
function h(x = n) = let (n = 7) x;
n = 3;
echo(h());

// expect: ECHO: [undef, 2, undef]
// expect: ECHO: [1, 2, undef]
// expect: ECHO: [1, 2, 3]
// expect: WARNING: Too many unnamed arguments supplied in file arguments.scad, line 5
// expect: ECHO: [1, 2, 3]
// expect: WARNING: argument a supplied more than once in file arguments.scad, line 6
// expect: ECHO: [5, 2, undef]
// expect: WARNING: variable d not specified as parameter in file arguments.scad, line 7
// expect: ECHO: [undef, 2, undef]
// expect: WARNING: variable extra not specified as parameter in file arguments.scad, line 9
// expect: ECHO: 3
// expect: ECHO: 3
