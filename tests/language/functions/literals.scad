f = function(x, y = 2) x + y;
echo(f);
echo(f(1), f(1, 1), f(y = 5, x = 1));
compose = function(g, h) function(x) g(h(x));
echo(compose(function(x) x * 2, function(x) x + 1)(5));
fact = function(n) n < 2 ? 1 : n * fact(n - 1);
echo(fact(10));
echo(is_function(f), f == f, f == (function(x, y = 2) x + y));
sin = function(x) "mine";
echo(sin(0), cos(0));
echo((function(x) x)(3));
echo("text"(1));

// expect: ECHO: function(x, y = 2) (x + y)
// expect: ECHO: 3, 2, 6
// expect: ECHO: 12
// expect: ECHO: 3.6288e+6
// expect: ECHO: true, true, false
// expect: ECHO: "mine", 1
// expect: ECHO: 3
// expect: WARNING: Can't call function on string in file literals.scad, line 12
// expect: ECHO: undef
