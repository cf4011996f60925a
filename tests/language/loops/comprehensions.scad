echo([for (i = [0 : 3]) i * i]);
echo([for (i = [0 : 2], j = [0 : i]) [i, j]]);
echo([for (i = [0 : 5]) if (i % 2 == 0) i else -i]);
echo([for (i = [0 : 5]) if (i > 3) i]);
echo([for (i = 0, s = 0; i < 5; s = s + i, i = i + 1) s]);
echo([for (i = 0; i < 3; i = i + 1, late = i) late]);
echo([each [1, 2], each "ab", each [3 : 5], each 6, each undef]);
echo([each for (i = [1, 2]) [i, [i]]]);
echo([let (a = 1) for (i = [a : 3]) let (b = i + a) [a, b]]);
echo([for (x = [[3, 4], [1, 2]]) each x]);
fs = [for (i = [1 : 3]) function() i];
echo([for (f = fs) f()]);

// expect: ECHO: [0, 1, 4, 9]
// expect: ECHO: [[0, 0], [1, 0], [1, 1], [2, 0], [2, 1], [2, 2]]
// expect: ECHO: [0, -1, 2, -3, 4, -5]
// expect: ECHO: [4, 5]
// expect: ECHO: [0, 0, 1, 3, 6]
// expect: WARNING: Ignoring unknown variable 'late' in file comprehensions.scad, line 6
// expect: ECHO: [undef, 1, 2]
// expect: ECHO: [1, 2, "a", "b", 3, 4, 5, 6]
// expect: ECHO: [1, [1], 2, [2]]
// expect: ECHO: [[1, 2], [1, 3], [1, 4]]
// expect: ECHO: [3, 4, 1, 2]
// expect: ECHO: [3, 3, 3]
