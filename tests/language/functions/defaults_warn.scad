// Defaults are evaluated even where an argument is given.
function f(a = -"text", b = [3 : 1], c = [1, -[0 : 2]]) = a;
echo(f(1, 2, 3));
module m(a = -"text", b = -1, c = [-1, "x"]) echo(a);
m(1, 2, 3);

// expect: WARNING: undefined operation (-string) in file defaults_warn.scad, line 2
// expect: DEPRECATED: Using ranges of the form [begin:end] with begin value greater than the end value is deprecated in file defaults_warn.scad, line 2
// expect: WARNING: undefined operation (-range) in file defaults_warn.scad, line 2
// expect: ECHO: 1
// expect: WARNING: undefined operation (-string) in file defaults_warn.scad, line 4
// expect: ECHO: 1
