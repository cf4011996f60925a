echo(let (a = 1, b = a + 1) [a, b]);
echo(let (a = 1) let (a = a + 1) a);
echo(let (a = 1, a = 2) a);
echo(let (5) 6);
let (a = 3, b = a) { echo(a, b); cube(b); }
assign (a = 1) echo(a);
a = 10;
assign (a = 1, b = a) echo(a, b);

// expect: ECHO: [1, 2]
// expect: ECHO: 2
// expect: WARNING: Ignoring duplicate variable assignment a = 2 in file let.scad, line 3
// expect: ECHO: 1
// expect: WARNING: Assignment without variable name 5 in file let.scad, line 4
// expect: ECHO: 6
// expect: ECHO: 3, 3
// expect: DEPRECATED: The assign() module will be removed in future releases. Use a regular assignment instead. in file let.scad, line 6
// expect: ECHO: 1
// expect: DEPRECATED: The assign() module will be removed in future releases. Use a regular assignment instead. in file let.scad, line 8
// expect: ECHO: 1, 10
// expect csg: group() {
// expect csg: \tcube(size = [3, 3, 3], center = false);
// expect csg: }
// expect csg: group();
// expect csg: group();
