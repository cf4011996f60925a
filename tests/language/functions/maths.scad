echo(sin(30), cos(60), tan(45), sin(360), cos(90), sin(-30), tan(90), tan(135));
echo(asin(0.5), acos(0.5), atan(1), atan2(1, -1), atan2(0, 0), asin(2));
echo(abs(-2), sign(-3), sign(0), floor(-1.5), ceil(-1.5), round(2.5), round(-2.5));
echo(pow(2, 0.5), sqrt(2), exp(1), ln(10), log(1000), log(2, 8));
echo(min(3, 1, 2), max([3, 1, 2]), min(["b", "a"]), max(1, "a"), min());
echo(norm([3, 4]), cross([1, 2, 3], [4, 5, 6]), cross([1, 2], [3, 4]), norm("a"));
echo(sin(), sin("a"), sqrt(1, 2));
echo(lookup(1.5, [[0, 0], [1, 10], [2, 30]]), lookup(-1, [[0, 5], [1, 10]]));

// expect: ECHO: 0.5, 0.5, 1, 0, 0, -0.5, inf, -1
// expect: ECHO: 30, 60, 45, 135, 0, nan
// expect: ECHO: 2, -1, 0, -2, -1, 3, -3
// expect: ECHO: 1.41421, 1.41421, 2.71828, 2.30259, 3, 3
// expect: WARNING: max() parameter could not be converted in file maths.scad, line 5
// expect: WARNING: min() number of parameters does not match in file maths.scad, line 5
// expect: ECHO: 1, 3, "a", undef, undef
// expect: ECHO: 5, [-3, 6, -3], -2, undef
// expect: WARNING: sin() number of parameters does not match in file maths.scad, line 7
// expect: WARNING: sin() parameter could not be converted in file maths.scad, line 7
// expect: WARNING: sqrt() number of parameters does not match in file maths.scad, line 7
// expect: ECHO: undef, undef, undef
// expect: ECHO: 20, 5
