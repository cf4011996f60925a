include <library_part.scad>
offset = 20;
echo(shifted(1), hidden);
show();

// expect: ECHO: "not instantiated"
// expect: ECHO: 21, 1
// expect: ECHO: 20, 1
// expect csg: group();
