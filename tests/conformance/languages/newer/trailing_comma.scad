function f(a, b,) = a + b;
echo(f(1, 2,), let(x = 3,) x);
translate([1, 0, 0],) cube([1, 2, 3], center = true,);
