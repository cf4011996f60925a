for (i = [0 : 2], j = [i : 2]) echo(i, j);
for (i = [3 : -1 : 0]) echo(i);
for (i = [2 : 0]) echo(i);
for (c = "aé") echo(c);
for (i = 5) echo(i);
for (i = undef) echo(i);
for (i = [[1, 2], "a", undef]) echo(i);
for (i = [0 : 20000]) echo(i);
for (i = [0 : 1]) { k = i * 2; cube(k + 1); }
intersection_for (i = [1, 2]) cube(i);

// expect: ECHO: 0, 0
// expect: ECHO: 0, 1
// expect: ECHO: 0, 2
// expect: ECHO: 1, 1
// expect: ECHO: 1, 2
// expect: ECHO: 2, 2
// expect: ECHO: 3
// expect: ECHO: 2
// expect: ECHO: 1
// expect: ECHO: 0
// expect: DEPRECATED: Using ranges of the form [begin:end] with begin value greater than the end value is deprecated in file for.scad, line 3
// expect: ECHO: 0
// expect: ECHO: 1
// expect: ECHO: 2
// expect: ECHO: "a"
// expect: ECHO: "é"
// expect: ECHO: 5
// expect: ECHO: [1, 2]
// expect: ECHO: "a"
// expect: ECHO: undef
// expect: WARNING: Bad range parameter in for statement: too many elements (20001) in file for.scad, line 8
// expect csg: group();
// expect csg: group();
// expect csg: group();
// expect csg: group();
// expect csg: group();
// expect csg: group();
// expect csg: group();
// expect csg: group();
// expect csg: group() {
// expect csg: \tcube(size = [1, 1, 1], center = false);
// expect csg: \tcube(size = [3, 3, 3], center = false);
// expect csg: }
// expect csg: intersection() {
// expect csg: \tcube(size = [1, 1, 1], center = false);
// expect csg: \tcube(size = [2, 2, 2], center = false);
// expect csg: }
