// The arguments of the module let() do not see what stood in its variables'
// places before.
let (a = 1) echo(a);
let (b = (function() b)()) echo(b);
for (i = [0, 1]) let (c = (function() c)()) echo(c);

// expect: ECHO: 1
// expect: WARNING: Ignoring unknown variable 'b' in file unset.scad, line 4
// expect: ECHO: undef
// expect: WARNING: Ignoring unknown variable 'c' in file unset.scad, line 5
// expect: ECHO: undef
// expect: WARNING: Ignoring unknown variable 'c' in file unset.scad, line 5
// expect: ECHO: undef
