// A function literal sees the variables of a loop as they are when it is
// called, those of the loop's update from the second round on.
x = 5;
echo([for (i = 0, f = function() i; i < 3; i = i + 1) f()]);
echo([for (i = 0, f = function() x; i < 3; i = i + 1, x = i * 10) f()]);
echo([for (i = 0, f = function() i; i < 3; i = i + 1, f = function() i + 9) f()]);
echo([for (i = 0, f = function(n) n <= 0 ? i : f(n - 1); i < 3; i = i + 1) f(2)]);
made = [for (i = 0; i < 3; i = i + 1) let(j = i) function() [i, j]];
echo([for (f = made) f()]);
echo([for (i = 0, f = function() [i, e]; i < 2; i = i + 1) f(e = 1)]);
again = [for (i = 0; i < 3; i = i + 1) let(j = i) function() [i, j, q]];
echo([for (f = again) f(q = 4)]);

// expect: ECHO: [0, 1, 2]
// expect: ECHO: [5, 10, 20]
// expect: ECHO: [0, 10, 11]
// expect: ECHO: [0, 1, 2]
// expect: ECHO: [[3, 0], [3, 1], [3, 2]]
// expect: WARNING: variable e not specified as parameter in file closures_of_loops.scad, line 10
// expect: WARNING: variable e not specified as parameter in file closures_of_loops.scad, line 10
// expect: ECHO: [[0, 1], [1, 1]]
// expect: WARNING: variable q not specified as parameter in file closures_of_loops.scad, line 12
// expect: WARNING: variable q not specified as parameter in file closures_of_loops.scad, line 12
// expect: WARNING: variable q not specified as parameter in file closures_of_loops.scad, line 12
// expect: ECHO: [[3, 0, 4], [3, 1, 4], [3, 2, 4]]
