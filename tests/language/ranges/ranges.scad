r = [1 : 2 : 7];
echo(r, r.begin, r.step, r.end, r[0], [for (i = r) i]);
echo([0 : 3]);
echo([for (i = [0 : 0.1 : 0.3]) i]);
echo([for (i = [3 : 1]) i]);
echo([for (i = [0 : -1 : 3]) i]);
echo([for (i = [1 : 0 : 1]) i]);
echo([1 : "a"], [undef : 1]);

// expect: ECHO: [1 : 2 : 7], 1, 2, 7, 1, [1, 3, 5, 7]
// expect: ECHO: [0 : 1 : 3]
// expect: ECHO: [0, 0.1, 0.2, 0.3]
// expect: DEPRECATED: Using ranges of the form [begin:end] with begin value greater than the end value is deprecated in file ranges.scad, line 5
// expect: ECHO: [1, 2, 3]
// expect: WARNING: begin is smaller than the end, but step is negative in file ranges.scad, line 6
// expect: ECHO: []
// expect: ECHO: []
// expect: ECHO: undef, undef
